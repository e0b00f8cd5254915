// The golden of a scenario: the approved run, and the allowed deviations from it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "golden/file.h"

namespace gaitlab::golden {

/// Allowed deviation of a column or number, as a share of its scale (see bands.h), with its parts.
struct Band {
  double ensemble = 0;  ///< 10 x the spread of runs whose start differs by rounding
  double halving = 0;   ///< 3 x the change from halving the step
  double floor = 0;     ///< above the rounding of other builds, grown over the run
  [[nodiscard]] double width() const;
};

/// A number of the summary.
struct Number {
  std::string name, unit;
  double value = 0;
  std::optional<double> at_start = {};  ///< s; time of a peak, if before the window by which its run is judged
};

struct Approval {
  std::int64_t number = 1;  ///< counts from 1, instead of a date
  std::string reason, build;
};

/// Origin of an approved run.
struct GoldenProvenance {
  std::string name, engine, integrator;
  double step = 0;              ///< s
  std::string build, compiler;  ///< build id; its compiler
  std::string scenario;         ///< hash() of the resolved scenario's text
  std::string resolved = {};    ///< that text, including its last line end; empty in an older golden
};

struct Golden {
  GoldenProvenance origin;
  std::vector<Approval> history;  ///< the last one is valid
  RoundedTrace run;
  std::vector<double> rounding;  ///< one per column, in its unit squared: mean square of the error of rounding the trace
  std::vector<Band> bands;       ///< one per column of the trace; that of `t` is empty
  std::vector<Number> numbers;
  std::vector<Band> number_bands;  ///< one per number
  std::string verdict = {};        ///< its word: `feasible`; empty in an older golden
};

/// `scenarios/hexapod.golden` for `scenarios/hexapod.yaml`.
std::filesystem::path golden_folder(const std::filesystem::path& scenario);

/// Writes trace.golden (see file.h) and golden.json (the rest) in `folder`, which is created if missing. A process that is
/// killed at any moment leaves the old or the new golden, never a mixture. Throws RunError if it cannot be written, InputError
/// if another process is writing it.
void write_golden(const Golden& golden, const std::filesystem::path& folder);

/// Reads a golden. Throws InputError, one message each, for either file: missing, truncated, corrupt (by checksum), foreign, of
/// another format version; and if the two files are not of one approval.
Golden read_golden(const std::filesystem::path& folder);

}  // namespace gaitlab::golden
