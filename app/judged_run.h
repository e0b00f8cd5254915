// A run folder, read and judged: for the commands that print, draw or search without simulating the run again.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/app.h"
#include "app/stored_scenario.h"
#include "report/page/page_data.h"

namespace gaitlab::app {

struct JudgedRun {
  std::string name;             ///< folder as the user typed it
  std::filesystem::path trace;  ///< path of the trace file
  StoredRun read;               ///< its scenario has the trace period of the kept rows
  double period = 0;            ///< trace period of the run, s
  report::Summary summary = {};
  report::Overlaps overlaps = {};
  report::Verdict verdict = {};

  [[nodiscard]] const Recording& recording() const { return read.stored.recording; }
  [[nodiscard]] report::PageData page_data(std::size_t most = report::kMostData) const;
};

/// Reads and judges a run. `joints` are the joints in the figure. `catalog` must outlive the result. Results of an earlier
/// --demand and of an earlier remedy are read from the folder. Throws InputError as read_run and draw_joints do.
JudgedRun judged_run(const std::string& name, Catalog& catalog, const std::vector<std::string>& joints,
                     const SummaryOptions& shown);

/// Prints notes and warnings on a run on stderr.
void warn(const JudgedRun& run);

}  // namespace gaitlab::app
