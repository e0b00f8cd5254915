// Judged window of a run, the statistics of every joint in this window, and the joints from the worst to the best, for
// terminal, figures, `swap` and `compare`.
#pragma once
#include <cstddef>
#include <vector>

#include "core/recording/limit_cycle.h"
#include "core/recording/motor_limit.h"
#include "core/recording/recording.h"

namespace gaitlab {

/// Statistics of one joint within the window; NaN if the run folder does not contain them. A peak is the largest
/// value since the previous row of Recording::ticks, and its time is the time of the row.
struct JudgedJoint {
  double torque_peak = 0, torque_peak_time = 0;     ///< largest magnitude of the motor torque, N m, and its time, s
  MotorLimit peak_limit = MotorLimit::none;         ///< limit that the motor reached at torque_peak
  double torque_rms = 0;                            ///< N m
  double voltage_limited = 0, current_limited = 0;  ///< share of the window
  double error_peak = 0, error_peak_time = 0;       ///< largest magnitude of set point minus angle, rad, and its time, s
  double envelope_peak = 0,
         envelope_peak_time = 0;               ///< largest share of the torque available at the present speed, and its time, s
  double speed_peak = 0, speed_peak_time = 0;  ///< largest magnitude, rad/s, and its time, s
  double current_rms = 0;                      ///< A
  double voltage_peak = 0, current_peak = 0;   ///< largest magnitudes, V and A
  /// First limit that the motor reached, for some time or at the largest torque of a tick, and the time of that tick minus the
  /// time at the limit, s.
  MotorLimit first_limit = MotorLimit::none;
  double first_limit_time = 0;
  [[nodiscard]] bool reaches_limit() const { return first_limit != MotorLimit::none; }
  [[nodiscard]] double limited() const { return voltage_limited + current_limited; }
};

struct Judged {
  double from = 0, to = 0;          ///< s
  std::size_t periods = 0;          ///< whole periods in the window; 0 without a limit cycle
  std::size_t first_row = 0;        ///< row of Recording::ticks after which the window begins
  std::vector<JudgedJoint> joints;  ///< statistics within the window
  std::vector<JudgedJoint> whole;   ///< statistics over the whole run
  /// Joints from the worst to the best, ordered by the share of time at a limit, then by the RMS of the torque, then by the
  /// peak of the torque. Equal joints are ordered by number.
  std::vector<std::size_t> order;

  /// Number of joints that reach a limit.
  [[nodiscard]] static std::size_t limited(const std::vector<JudgedJoint>& joints);
  /// Joint with the largest tracking error (farthest) or the largest torque (strongest). If several differ only by rounding,
  /// the first of them.
  [[nodiscard]] static std::size_t farthest(const std::vector<JudgedJoint>& joints);
  [[nodiscard]] static std::size_t strongest(const std::vector<JudgedJoint>& joints);
  /// Joint that is the first to reach a limit. Requires that at least one joint reaches a limit.
  [[nodiscard]] static std::size_t first(const std::vector<JudgedJoint>& joints);
};

/// Length of the start that is left out of a run without a limit cycle or without two periods, s: 2 s, or a fifth of a run
/// shorter than 10 s.
double left_out_start(double end);

/// Chooses the judged window and computes its statistics. The window consists of whole periods up to the end of the run,
/// without the first period after `start`, s, the start of the gait. The period is that of the limit cycle or, without one,
/// `period` of the set points, s. If fewer than two periods follow `start`, the window begins 2 s or a fifth of the remaining
/// time after `start`, whichever is earlier. If the set points do not repeat (`period` is 0), the window begins at 0. Its start
/// is rounded down to a row of Recording::ticks. These rows cover all steps, so that the result does not depend on
/// trace.period.
Judged judge(const Recording& recording, const MotionCycle& cycle, double period, double start = 0);
/// The same for the window from `from`, s, to the end of the recording, without a number of periods.
Judged judge_from(const Recording& recording, double from);

}  // namespace gaitlab
