// Summary numbers of every joint, and of the joint with the largest tracking error.
#include <limits>
#include <nlohmann/json.hpp>

#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/numbers/numbers.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;
using R = const RunData&;
using F = JointStatistics;

/// Function for a statistic of a joint over the whole run.
auto of_whole_run(double F::*member) {
  return [member](R run, std::size_t joint) { return run.record.joints[joint].*member; };
}

/// Function for a statistic of a joint in the judged window; NaN (null) if no joint has a motor.
auto of_window(double JudgedJoint::*member) {
  return [member](R run, std::size_t joint) {
    return has_motors(run) ? run.summary.judged.joints[joint].*member : std::numeric_limits<double>::quiet_NaN();
  };
}

/// Statistic of the joint with the largest tracking error in the whole run; null if no joint has a motor.
Json tracked(R run, double F::*figure) {
  return has_motors(run) ? Json(run.record.joints[texts::worst(run.record, &F::error_peak)].*figure) : Json();
}

}  // namespace

std::vector<SummaryNumber> joint_numbers() {
  return {
      {.key = "per_joint.J.torque.peak",
       .unit = "N m",
       .definition = "Largest motor torque, without the torque of the stop.",
       .of_joint = of_whole_run(&F::torque_peak),
       .compare = {220},
       .golden = {.place = 70, .needs_motor = true}},
      {.key = "per_joint.J.torque.peak_time",
       .unit = "s",
       .definition = "Start of the step in which this peak was reached.",
       .of_joint = of_whole_run(&F::torque_peak_time)},
      {.key = "per_joint.J.torque.rms",
       .unit = "N m",
       .definition = "RMS of the motor torque.",
       .of_joint = of_whole_run(&F::torque_rms),
       .compare = {.place = 230, .label = "torque RMS, N m"},
       .golden = {.place = 80, .needs_motor = true}},
      {.key = "per_joint.J.speed.peak",
       .unit = "rad/s",
       .definition = "Largest joint speed.",
       .of_joint = of_whole_run(&F::speed_peak)},
      {.key = "per_joint.J.current.peak",
       .unit = "A",
       .definition = "Largest motor current.",
       .of_joint = of_whole_run(&F::current_peak)},
      {.key = "per_joint.J.current.rms",
       .unit = "A",
       .definition = "RMS of the motor current.",
       .of_joint = of_whole_run(&F::current_rms),
       .golden = {.place = 90, .needs_motor = true}},
      {.key = "per_joint.J.tracking_error.rms",
       .unit = "rad",
       .definition = "RMS of set point minus angle.",
       .of_joint = of_whole_run(&F::error_rms)},
      {.key = "per_joint.J.tracking_error.peak",
       .unit = "rad",
       .definition = "Largest magnitude of set point minus angle.",
       .of_joint = of_whole_run(&F::error_peak)},
      {.key = "per_joint.J.tracking_error.at_start",
       .unit = "rad",
       .definition = "Largest magnitude of set point minus angle in the first step: a jump of the set point at t = 0.",
       .of_joint = of_whole_run(&F::start_jump)},
      {.key = "per_joint.J.saturated.voltage",
       .definition = "Share of the time at the voltage limit (saturation 1).",
       .of_joint = of_whole_run(&F::saturated_voltage)},
      {.key = "per_joint.J.saturated.current",
       .definition = "Share of the time at the current limit (saturation 2).",
       .of_joint = of_whole_run(&F::saturated_current)},
      {.key = "per_joint.J.judged.torque.peak",
       .unit = "N m",
       .definition = "Largest motor torque in the judged window.",
       .of_joint = of_window(&JudgedJoint::torque_peak),
       .line = {46, "torque", texts::most_loaded},
       .compare = {218},
       .swap = {40, " peak torque", "         N m of joint", -29, texts::torque_cell}},
      {.key = "per_joint.J.judged.torque.peak_time",
       .unit = "s",
       .definition = "Time of this peak: the end of the control tick (or of the few ticks, in a long run) in which it was "
                     "reached.",
       .of_joint = of_window(&JudgedJoint::torque_peak_time)},
      {.key = "per_joint.J.judged.torque.rms",
       .unit = "N m",
       .definition = "RMS of the motor torque in the window.",
       .of_joint = of_window(&JudgedJoint::torque_rms),
       .compare = {219}},
      {.key = "per_joint.J.judged.tracking_error.peak",
       .unit = "rad",
       .definition = "Largest magnitude of set point minus angle in the window.",
       .of_joint = of_window(&JudgedJoint::error_peak)},
      {.key = "per_joint.J.judged.tracking_error.peak_time",
       .unit = "s",
       .definition = "Time of this peak, defined as `judged.torque.peak_time`.",
       .of_joint = of_window(&JudgedJoint::error_peak_time)},
      {.key = "per_joint.J.judged.saturated.voltage",
       .definition = "Share of the window at the voltage limit.",
       .of_joint = of_window(&JudgedJoint::voltage_limited)},
      {.key = "per_joint.J.judged.saturated.current",
       .definition = "Share of the window at the current limit.",
       .of_joint = of_window(&JudgedJoint::current_limited)},
      {.key = "per_joint.J.range.share",
       .definition = "Share of the time outside [lo, hi].",
       .of_joint = of_whole_run(&F::range_share),
       .line = {50, "range", texts::range}},
      {.key = "per_joint.J.range.worst",
       .unit = "rad",
       .definition = "Largest excess over [lo, hi].",
       .of_joint = of_whole_run(&F::range_worst)},
      {.key = "per_joint.J.range.setpoint_share",
       .definition = "Share of the time with the set point outside [lo, hi].",
       .of_joint = of_whole_run(&F::setpoint_outside)},
      {.key = "per_joint.J.energy.electrical",
       .unit = "J",
       .definition = "sum(voltage * current * h).",
       .of_joint = of_whole_run(&F::electrical)},
      {.key = "per_joint.J.energy.copper", .unit = "J", .definition = "sum(R i^2 h).", .of_joint = of_whole_run(&F::copper)},
      {.key = "per_joint.J.energy.gear",
       .unit = "J",
       .definition = "sum(voltage * current - R i^2 - T w) h, all evaluated at the same time.",
       .of_joint = of_whole_run(&F::gear)},
      {.key = "per_joint.J.energy.created",
       .unit = "J",
       .definition = "Energy that the gears create, as a positive number: -sum(min(gear power, 0) h). Eq. 2 "
                     "gives it to back-driven joints; `gear` is the loss minus this energy.",
       .of_joint = of_whole_run(&F::created)},
      {.key = "per_joint.J.energy.dry",
       .unit = "J",
       .definition = "Energy lost in dry and viscous friction of the joint.",
       .of_joint = of_whole_run(&F::dry)},
      {.key = "per_joint.J.energy.shaft", .unit = "J", .definition = "sum(T w h).", .of_joint = of_whole_run(&F::shaft)},
      {.key = "tracking_error.worst",
       .unit = "rad",
       .definition = "Largest `per_joint.J.tracking_error.peak`: over all steps, as other peaks; "
                     "`tracking_error` is null if no joint has a motor.",
       .value = [](R r) { return tracked(r, &F::error_peak); },
       .line = {48, "tracking", texts::tracking},
       .compare = {235},
       .golden = {.place = 65, .needs_motor = true},
       .swap = {60, "tracking", "error, rad", 10, texts::tracking_cell}},
      {.key = "tracking_error.joint",
       .definition = "Joint with this error.",
       .words = true,
       .value =
           [](R r) {
             return has_motors(r) ? Json(r.scenario.robot->joints[texts::worst(r.record, &F::error_peak)].name) : Json();
           }},
      {.key = "tracking_error.time",
       .unit = "s",
       .definition = "Start of the step in which this peak was reached.",
       .value = [](R r) { return tracked(r, &F::error_peak_time); }},
  };
}

}  // namespace gaitlab::report
