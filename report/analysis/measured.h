// Differences of a run from the log of the real robot.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Difference simulated - measured of one quantity, over the rows of the log that the run covers; in the unit of the quantity.
struct LogError {
  double mae = 0, rms = 0, peak = 0;  ///< mean and largest magnitude, and root of the mean square
  double peak_time = 0;               ///< s, of the row with the largest magnitude
  double span = 0;                    ///< largest minus least measured value
};

struct JointLogErrors {
  std::size_t joint = 0;
  std::array<std::optional<LogError>, kLoggedKinds> errors;  ///< none for a quantity that the log does not have
  /// Shares of the rows in which the motor gets its whole supply, whatever its current: simulated and measured. Both are
  /// known if the log has the duty.
  std::optional<double> at_limit, measured_at_limit;
  [[nodiscard]] const std::optional<LogError>& of(Logged kind) const { return errors[static_cast<std::size_t>(kind)]; }
};

struct LogErrors {
  std::size_t rows = 0;  ///< rows of the log that the run covers
  double from_log = 0;   ///< s, duration of the log
  double compared = 0;   ///< s, duration of these rows: the shorter of log and run
  std::vector<JointLogErrors> joints;
  /// Mean of a number of all joints that have it, or nothing.
  [[nodiscard]] std::optional<double> mean(Logged kind, double LogError::*number) const;
  [[nodiscard]] std::optional<double> mean(std::optional<double> JointLogErrors::*share) const;
  /// Errors of a joint, or null.
  [[nodiscard]] const JointLogErrors* of(std::size_t joint) const;
};

/// Values of the trace at the times of the log, by row: between rows of the trace the angle follows the cubic through angles
/// and speeds (Hermite), the duty is the one that was in force, and other quantities follow a line. The angle is the one that
/// an encoder of the joint reads, if it has any. The duty is the voltage that the controller commands over the voltage that the
/// motor can get, at most 1.
/// Only the rows of the log up to the end of the run count.
std::vector<double> at_log(const Scenario& scenario, const Recording& record, std::size_t joint, Logged kind);

/// Nothing without a log, or if fewer than two of its rows are covered, or if the trace lacks a column.
std::optional<LogErrors> log_errors(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
