// The golden of a scenario, which contains the approved run and the allowed deviations from it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/recording/word.h"
#include "golden/file.h"

namespace gaitlab::golden {

/// Allowed deviation (band) of a column or number, as a share of its scale (bands.h), with the three parts from which it
/// results.
struct Band {
  /// 10 x the difference between runs whose start angles differ by up to 1e-7 rad. For means over starts (starts.h): 6 standard
  /// errors.
  double ensemble = 0;
  double halving = 0;   ///< 3 x the change caused by halving the step
  double floor = 0;     ///< lower limit, above the effect of rounding by other builds
  double constant = 0;  ///< natural scale of a constant column, in its unit: the parts are shares of it; else 0 (bands.h)
  [[nodiscard]] double width() const;
};

/// A number of the summary.
struct GoldenNumber {
  std::string name, unit;
  double value = 0;
  std::optional<double> at_start = {};   ///< time of a peak that precedes the judged window, s
  std::optional<double> deviation = {};  ///< standard deviation over the starts, if the value is a mean (starts.h)
};

struct Approval {
  std::int64_t number = 1;  ///< counted from 1, in place of a date
  std::string reason, build;
};

/// Settings and build of an approved run.
struct GoldenProvenance {
  std::string name, engine, integrator;
  double step = 0;              ///< s
  std::string build, compiler;  ///< id of the build, and its compiler
  std::string scenario;         ///< hash() of the text of the resolved scenario
  std::string resolved = {};    ///< text of the resolved scenario, including its last line end; empty if it is not UTF-8
};

struct Golden {
  GoldenProvenance origin;
  std::vector<Approval> history;  ///< all approvals in order; the last approval is valid
  RoundedTrace run;
  /// Mean square of the error of rounding each column of the trace, in the column's unit squared.
  std::vector<double> rounding;
  std::vector<Band> bands;  ///< one band per column of the trace; the band of `t` is empty
  std::vector<GoldenNumber> numbers;
  std::vector<Band> number_bands;  ///< one band per element of `numbers`
  Word verdict = Word::not_judged;
  std::vector<std::string> selected = {};  ///< patterns of the columns that the user has chosen; empty for the usual ones
  /// Number of runs whose mean the numbers are (starts.h); the trace then has the column `t` only.
  int starts = 1;
};

/// Folder of a scenario's golden: `scenarios/hexapod.golden` for `scenarios/hexapod.yaml`.
std::filesystem::path golden_folder(const std::filesystem::path& scenario);

/// Writes trace.golden (file.h) and golden.json (all other data) into `folder`, which is created if missing. A process that is
/// killed at any moment, or whose disk fails, leaves the old or the new golden, never a mixture. Throws RunError if the golden
/// cannot be written, and InputError if another process is writing it.
void write_golden(const Golden& golden, const std::filesystem::path& folder);

/// Reads a golden. Throws InputError with a separate message if either file is missing, truncated, corrupt (by checksum), from
/// another program, or in another format version, and if the two files come from different approvals.
Golden read_golden(const std::filesystem::path& folder);

}  // namespace gaitlab::golden
