// The stretch of a run that its numbers are judged by, what every joint did in it, and the order of joints from the worst on:
// the same for the terminal, figures, `swap` and `compare`.
#pragma once
#include <cstddef>
#include <vector>

#include "core/recording/limit_cycle.h"
#include "core/recording/motor_limit.h"
#include "core/recording/recording.h"

namespace gaitlab {

/// Of one joint, within the window; NaN where the folder does not know it. A time is the end of the row of Recording::ticks in
/// which the peak was reached.
struct JudgedJoint {
  double torque_peak = 0, torque_peak_time = 0;      ///< N m, largest magnitude of the motor torque; s
  MotorLimit peak_limit = MotorLimit::none;          ///< at which the motor was then
  double torque_rms = 0;                             ///< N m
  double voltage_limited = 0, current_limited = 0;   ///< share of the window
  double error_peak = 0, error_peak_time = 0;        ///< rad, largest magnitude of set point minus angle; s
  double envelope_peak = 0, envelope_peak_time = 0;  ///< largest share of the torque that there is at that speed; s
  double speed_peak = 0, speed_peak_time = 0;        ///< rad/s, largest magnitude; s
  double current_rms = 0;                            ///< A
  double voltage_peak = 0, current_peak = 0;         ///< V, A, largest magnitudes
  /// The first limit that it was at, for some time or in the instant of the largest torque of a tick; s.
  MotorLimit first_limit = MotorLimit::none;
  double first_limit_time = 0;
  [[nodiscard]] bool reaches_limit() const { return first_limit != MotorLimit::none; }
  [[nodiscard]] double limited() const { return voltage_limited + current_limited; }
};

struct Judged {
  double from = 0, to = 0;          ///< s
  std::size_t periods = 0;          ///< whole periods in the window; 0: no limit cycle was found
  std::size_t first_row = 0;        ///< of Recording::ticks: the window holds what is behind it
  std::vector<JudgedJoint> joints;  ///< within the window
  std::vector<JudgedJoint> whole;   ///< the same of the whole run
  /// Worst first, by the share of time at a limit, then the RMS of the torque, then its peak; equal ones by their numbers.
  std::vector<std::size_t> order;

  /// How many joints reach a limit.
  [[nodiscard]] static std::size_t limited(const std::vector<JudgedJoint>& joints);
  /// The joint with the largest tracking error; of the largest torque. The first of those that differ by rounding.
  [[nodiscard]] static std::size_t farthest(const std::vector<JudgedJoint>& joints);
  [[nodiscard]] static std::size_t strongest(const std::vector<JudgedJoint>& joints);
  /// Of the joints that reach a limit, which there must be, the first to do so.
  [[nodiscard]] static std::size_t first(const std::vector<JudgedJoint>& joints);
};

/// s: length of the start that is left out of a run without a limit cycle: 2 s, or a fifth of a run that ends earlier than 10
/// s.
double left_out_start(double end);

/// The window holds whole periods up to the end of the run: from the limit cycle on, or from earlier on where more than one
/// period would be left out. At most one period of a start is forgiven, because motors that are at their limits until a late
/// limit cycle begins would count for nothing. Without a limit cycle it begins at 2 s or a fifth of the run, whichever is
/// earlier; where the set points do not repeat, at 0, because what is played once counts. From Recording::ticks, which are of
/// all steps: nothing depends on trace.period. The window begins at the row of ticks before its start.
Judged judge(const Recording& recording, const MotionCycle& cycle, bool repeats);

}  // namespace gaitlab
