// Statistics of a run: sums and peaks over ALL steps; the trace has fewer rows.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace gaitlab {

/// Factor by which a value must exceed a peak to replace it: all motors at one limit have its torque, up to rounding, and the
/// first of these is the peak.
inline constexpr double kLarger = 1 + 1e-9;

/// Statistics of one joint over the steps so far. SI.
struct JointStatistics {
  double torque_peak = 0, torque_rms = 0;                  ///< N m, motor torque
  double torque_peak_time = 0;                             ///< s: start of the step in which torque_peak was reached
  double speed_peak = 0;                                   ///< rad/s
  double current_peak = 0, current_rms = 0;                ///< A
  double error_rms = 0, error_peak = 0;                    ///< rad, set point - angle
  double error_peak_time = 0;                              ///< s: start of the step in which error_peak was reached
  double start_jump = 0;                                   ///< rad: set point - angle at t = 0
  double saturated_voltage = 0, saturated_current = 0;     ///< share of time
  double range_share = 0, range_worst = 0;                 ///< share of time outside [lo, hi]; worst excess, rad
  double setpoint_outside = 0;                             ///< share of time with the set point outside [lo, hi]
  double electrical = 0, copper = 0, gear = 0, shaft = 0;  ///< J: drawn, lost, lost, given to the joint
  double shaft_positive = 0;                               ///< J: positive part of the shaft power
  double created = 0;  ///< J: energy that the gear gave instead of losing (eq. 2, back-driven)
};

/// A member of JointStatistics as a column of a table.
struct JointStatistic {
  double JointStatistics::*member;
  const char *name, *unit, *definition;
};

/// All members of JointStatistics.
inline constexpr std::array<JointStatistic, sizeof(JointStatistics) / sizeof(double)> kJointStatistics{{
    {&JointStatistics::torque_peak, "torque_peak", "N m", "largest magnitude of the motor torque"},
    {&JointStatistics::torque_peak_time, "torque_peak_time", "s", "start of the step in which torque_peak was reached"},
    {&JointStatistics::torque_rms, "torque_rms", "N m", "RMS of the motor torque"},
    {&JointStatistics::speed_peak, "speed_peak", "rad/s", "largest magnitude of the speed"},
    {&JointStatistics::current_peak, "current_peak", "A", "largest magnitude of the current"},
    {&JointStatistics::current_rms, "current_rms", "A", "RMS of the current"},
    {&JointStatistics::error_rms, "error_rms", "rad", "RMS of set point minus angle"},
    {&JointStatistics::error_peak, "error_peak", "rad", "largest magnitude of set point minus angle"},
    {&JointStatistics::error_peak_time, "error_peak_time", "s", "start of the step in which error_peak was reached"},
    {&JointStatistics::start_jump, "start_jump", "rad", "largest magnitude of set point minus angle in the first step"},
    {&JointStatistics::saturated_voltage, "saturated_voltage", "", "share of the time at the voltage limit"},
    {&JointStatistics::saturated_current, "saturated_current", "", "share of the time at the current limit"},
    {&JointStatistics::range_share, "range_share", "", "share of the time outside the range of the hinge"},
    {&JointStatistics::range_worst, "range_worst", "rad", "largest excess over the range of the hinge"},
    {&JointStatistics::setpoint_outside, "setpoint_outside", "", "share of the time with the set point outside that range"},
    {&JointStatistics::electrical, "electrical", "J", "energy drawn by the motor"},
    {&JointStatistics::copper, "copper", "J", "heat in the winding"},
    {&JointStatistics::gear, "gear", "J", "loss in the gear, less what it created"},
    {&JointStatistics::shaft, "shaft", "J", "energy given to the joint"},
    {&JointStatistics::shaft_positive, "shaft_positive", "J", "energy given to the joint where that power is positive"},
    {&JointStatistics::created, "created", "J", "what the gear gave instead of losing"},
}};

/// Difference between a run and a rollout beside it (core/simulation/step_error.h).
struct Parting {
  double time = -1;       ///< s: when a torque first differed by more than the accuracy, times its peak; below 0: never
  std::size_t joint = 0;  ///< its joint
  double share = 0;       ///< RMS of the difference of a joint's torque over its peak, for the worst joint
};

/// Numbers of a rollout's steps since the start.
struct StepTally {
  double solves = 0;                 ///< solutions of the equations of motion; 0: not counted
  double off = 0;                    ///< joint-steps that ended off the law of their motor or stop
  double coarse = 0;                 ///< s in which an integrator's shortest steps did not reach the accuracy
  bool estimated = false;            ///< whether a torque error has been estimated so far (core/simulation/step_error.h)
  Parting event;                     ///< of the rollout with other steps that differs more; share: of the estimated error
  Parting chaotic, ill;              ///< of the rollout under gravity times 1 + 1e-9, and of 1000 times that difference
  std::vector<double> torque_error;  ///< of each joint, RMS, N m
  std::vector<double> torque_peak;   ///< of each joint, largest torque at the moments of the estimate, N m
};

/// Largest rate lambda of M^-1 (B + sum J^T G J), 1/s, and its origin. A step h is stable for h lambda <= 1 (explicit).
struct Stability {
  double rate = 0;
  enum class Source { motor, stop, contact, hinge } source = Source::motor;
  std::size_t index = 0;  ///< joint, or contact element; hinge: of a passive hinge
};

}  // namespace gaitlab
