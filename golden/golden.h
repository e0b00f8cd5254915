// The golden of a scenario: the run that was approved, and how far another may stray from it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "golden/file.h"

namespace gaitlab::golden {

/// How far a column or number may stray, as a share of its scale (see bands.h), and why that far.
struct Band {
  double ensemble = 0;  ///< 10 x the spread of runs whose start differs by rounding
  double halving = 0;   ///< 3 x the change from halving the step
  double floor = 0;     ///< rounding of other builds, grown over the run, stays below
  [[nodiscard]] double width() const;
};

/// A figure of the summary.
struct Number {
  std::string name, unit;
  double value = 0;
  std::optional<double> at_start = {};  ///< s; when a peak was reached, if before the window by which its run is judged
};

struct Approval {
  std::int64_t number = 1;  ///< counts from 1; no clock
  std::string reason, build;
};

/// Which run it was.
struct GoldenProvenance {
  std::string name, engine, integrator;
  double step = 0;              ///< s
  std::string build, compiler;  ///< build id; its compiler
  std::string scenario;         ///< hash() of the resolved scenario's text
  std::string resolved = {};    ///< that text, whose last line ends, too; empty in a golden of before it was kept
};

struct Golden {
  GoldenProvenance origin;
  std::vector<Approval> history;  ///< the last is the one that holds
  RoundedTrace run;
  std::vector<double> rounding;  ///< one a column, in its unit squared: mean square of what rounding the trace took
  std::vector<Band> bands;       ///< one a column of the trace; that of `t` is empty
  std::vector<Number> numbers;
  std::vector<Band> number_bands;  ///< one a number
  std::string verdict = {};        ///< its word: `feasible`; empty in a golden of before it was kept
};

/// `scenarios/hexapod.golden` for `scenarios/hexapod.yaml`.
std::filesystem::path golden_folder(const std::filesystem::path& scenario);

/// Makes trace.golden (see file.h) and golden.json (all else) in `folder`, which is made if missing. A process that is
/// killed at any moment leaves the golden that was there or the new one, never a mixture. RunError: cannot be written.
/// InputError: another process is writing it.
void write_golden(const Golden& golden, const std::filesystem::path& folder);

/// What write_golden wrote. InputError, one message each, for either file: missing, truncated, corrupt (by checksum), foreign,
/// of another format version; and where the two files are not of one approval.
Golden read_golden(const std::filesystem::path& folder);

}  // namespace gaitlab::golden
