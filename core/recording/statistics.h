// Statistics of a run: sums and peaks over ALL steps, because rows of the trace cover only some of them.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace gaitlab {

/// Factor by which a value must exceed a peak to replace it. All motors at one limit have the same torque up to rounding; the
/// first of them must remain the peak.
inline constexpr double kLarger = 1 + 1e-9;

/// Statistics of one joint over the steps so far, in SI units.
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
  double electrical = 0, copper = 0, gear = 0, shaft = 0;  ///< J: drawn, lost in winding and gear, given to the joint
  double dry = 0;                                          ///< J: lost in dry and viscous friction
  double shaft_positive = 0;                               ///< J: positive part of the shaft power
  double created = 0;                                      ///< J: energy that the gear created (eq. 2, back-driven)
  /// Number of control ticks with a change of the command's sign minus those without, in the last stretch of the run in which
  /// most ticks have a change; 0 if there is no such stretch.
  double reversals = 0;
  double reversing_from = 0;  ///< s: first tick of that stretch
};

/// A member of JointStatistics, as a column of a table.
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
    {&JointStatistics::gear, "gear", "J", "loss in the gear, minus the energy that it created"},
    {&JointStatistics::shaft, "shaft", "J", "energy given to the joint"},
    {&JointStatistics::dry, "dry", "J", "energy lost in dry and viscous friction of the joint"},
    {&JointStatistics::shaft_positive, "shaft_positive", "J", "energy given to the joint while that power is positive"},
    {&JointStatistics::created, "created", "J", "energy that the gear created"},
    {&JointStatistics::reversals, "reversals", "",
     "control ticks from reversing_from on with a change of the command's sign, minus those without a change"},
    {&JointStatistics::reversing_from, "reversing_from", "s",
     "first tick of the last stretch of the run in which the command changes its sign in most ticks"},
}};

/// Difference between the motor torques of a run and of a companion rollout (core/simulation/step_error.h).
struct Parting {
  double time = -1;  ///< s: first time at which a torque differs by more than accuracy times peak; below 0 if there is none
  std::size_t joint = 0;  ///< joint with that torque
  double share = 0;       ///< RMS of the torque difference over the torque peak, for the worst joint
};

/// Counts and error estimates of the steps of a rollout since the start.
struct StepTally {
  double solves = 0;       ///< solutions of the equations of motion; 0 if not counted
  double off = 0;          ///< number of joints that ended a step off the law of motor or end stop, summed over the steps
  double coarse = 0;       ///< time in which the shortest steps of an integrator did not reach the accuracy, s
  bool estimated = false;  ///< true if a torque error has been estimated so far (core/simulation/step_error.h)
  Parting event;           ///< for the rollout with other steps that differs first; its `share` is the estimated error
  Parting chaotic, ill;    ///< chaotic: for gravity times 1 + 1e-9; ill: for 1000 times that difference
  std::vector<double> torque_error;  ///< RMS error per joint, N m
  std::vector<double> torque_peak;   ///< largest torque per joint at the times of comparison, N m
};

/// Largest damping rate lambda, 1/s, and its cause. lambda is the largest eigenvalue of M^-1 (B + sum J^T G J). A step h of an
/// explicit integrator is stable for h lambda <= 1.
struct Stability {
  double rate = 0;
  enum class Source { motor, stop, contact, hinge, play } source = Source::motor;
  std::size_t index = 0;  ///< joint (motor, stop, passive hinge, play) or contact element
};

}  // namespace gaitlab
