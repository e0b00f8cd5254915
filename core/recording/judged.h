// The judged window of a run, the statistics of every joint in it, and the order of joints from the worst on: the same for the
// terminal, figures, `swap` and `compare`.
#pragma once
#include <cstddef>
#include <vector>

#include "core/recording/limit_cycle.h"
#include "core/recording/motor_limit.h"
#include "core/recording/recording.h"

namespace gaitlab {

/// Statistics of one joint within the window; NaN if the folder does not contain them. A time is the end of the row of
/// Recording::ticks in which the peak was reached.
struct JudgedJoint {
  double torque_peak = 0, torque_peak_time = 0;      ///< N m, largest magnitude of the motor torque; s
  MotorLimit peak_limit = MotorLimit::none;          ///< limit at which the motor was then
  double torque_rms = 0;                             ///< N m
  double voltage_limited = 0, current_limited = 0;   ///< share of the window
  double error_peak = 0, error_peak_time = 0;        ///< rad, largest magnitude of set point minus angle; s
  double envelope_peak = 0, envelope_peak_time = 0;  ///< largest share of the torque available at that speed; s
  double speed_peak = 0, speed_peak_time = 0;        ///< rad/s, largest magnitude; s
  double current_rms = 0;                            ///< A
  double voltage_peak = 0, current_peak = 0;         ///< V, A, largest magnitudes
  /// The first limit that it reached, for some time or at the moment of a tick's largest torque; s.
  MotorLimit first_limit = MotorLimit::none;
  double first_limit_time = 0;
  [[nodiscard]] bool reaches_limit() const { return first_limit != MotorLimit::none; }
  [[nodiscard]] double limited() const { return voltage_limited + current_limited; }
};

struct Judged {
  double from = 0, to = 0;          ///< s
  std::size_t periods = 0;          ///< whole periods in the window; 0: no limit cycle
  std::size_t first_row = 0;        ///< of Recording::ticks: the window begins behind it
  std::vector<JudgedJoint> joints;  ///< within the window
  std::vector<JudgedJoint> whole;   ///< the same over the whole run
  /// Joints from the worst on, by the share of time at a limit, then the RMS of the torque, then its peak; equal ones by
  /// number.
  std::vector<std::size_t> order;

  /// Number of joints that reach a limit.
  [[nodiscard]] static std::size_t limited(const std::vector<JudgedJoint>& joints);
  /// The joint with the largest tracking error, or the largest torque. The first of those that differ by rounding.
  [[nodiscard]] static std::size_t farthest(const std::vector<JudgedJoint>& joints);
  [[nodiscard]] static std::size_t strongest(const std::vector<JudgedJoint>& joints);
  /// The joint that reaches a limit first; some joint must.
  [[nodiscard]] static std::size_t first(const std::vector<JudgedJoint>& joints);
};

/// Length of the start that is left out of a run without a limit cycle, s: 2 s, or a fifth of a run that ends earlier than 10
/// s.
double left_out_start(double end);

/// Chooses the window: whole periods up to the end of the run, from the limit cycle on, or from earlier on if more than one
/// period would be left out. At most one period is left out, because otherwise the motors at their limits before a late limit
/// cycle would not count. Without a limit cycle the window begins at 2 s or a fifth of the run, whichever is earlier; for set
/// points that do not repeat, at 0. Computed from Recording::ticks, which cover all steps, so that the result does not depend
/// on trace.period. The window begins at the row of ticks before its start.
Judged judge(const Recording& recording, const MotionCycle& cycle, bool repeats);

}  // namespace gaitlab
