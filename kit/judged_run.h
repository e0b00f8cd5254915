// A run folder, read and judged, without simulating the run again.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "kit/stored_scenario.h"
#include "report/page/page_data.h"
#include "report/verdict/verdict.h"

namespace gaitlab::kit {

inline constexpr const char* kRemedyFile = "remedy.json";  ///< name of the remedy in a run folder

struct JudgedRun {
  std::string name;   ///< folder as the user typed it
  StoredRun read;     ///< run whose scenario has the trace period of the kept rows
  double period = 0;  ///< trace period of the run, s
  std::string scenario_hash = {};
  std::optional<AllRows> all = {};  ///< all rows, if thin_rows() removed some
  report::Summary summary = {};
  report::Overlaps overlaps = {};
  report::Verdict verdict = {};

  [[nodiscard]] const Recording& recording() const { return read.stored.recording; }
  [[nodiscard]] std::filesystem::path folder() const { return read.stored.file.parent_path(); }
  [[nodiscard]] report::PageData page_data(std::size_t most = report::kMostData) const;
  /// Adds the results of second runs to the verdict, from verdict.json, because recordings do not contain them: the word
  /// without chosen friction and, if `demand`, the results of an earlier --demand.
  void keep_second_runs(bool demand = true);
  /// Adds the remedy of an earlier search to the verdict, from remedy.json.
  void keep_remedy();
};

/// Reads and judges a run. `catalog` must outlive the result. Throws the InputErrors of read_run.
JudgedRun read_judged(const std::string& name, Catalog& catalog);

}  // namespace gaitlab::kit
