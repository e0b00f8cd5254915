#include "report/verdict/numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "report/analysis/fall.h"
#include "report/analysis/posture.h"
#include "report/verdict/number_texts.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;
using R = const RunData&;
using F = JointStatistics;

constexpr std::string_view kOfJoint = "per_joint.J.";

/// Of the whole run.
auto of_whole_run(double F::*member) {
  return [member](R run, std::size_t joint) { return run.record.joints[joint].*member; };
}

/// Within the judged window; NaN (null) where nothing drives the joints.
auto of_window(double JudgedJoint::*member) {
  return [member](R run, std::size_t joint) {
    return has_motors(run) ? run.summary.judged.joints[joint].*member : std::numeric_limits<double>::quiet_NaN();
  };
}

/// Null: nothing drives the joints.
template <class Of>
Json of_motors(R run, Of of) {
  return has_motors(run) ? Json(of(run.summary.judged)) : Json();
}

/// `of` null: not estimated.
template <class Of>
Json estimated(R run, Of of) {
  const TorqueError error = torque_error(run.record);
  return error.estimated ? Json(of(error)) : Json();
}

Json torque_errors(R run) {
  Json each = Json::object();
  for (std::size_t j = 0; j < run.record.joints.size(); ++j)
    each[run.scenario.robot->joints[j].name] = run.record.tally.torque_error[j];
  return each;
}

/// Of the joint that was farthest from its set point in the whole run; null: nothing drives the joints.
Json tracked(R run, double F::*figure) {
  return has_motors(run) ? Json(run.record.joints[texts::worst(run.record, &F::error_peak)].*figure) : Json();
}

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Null of what is not a number.
Json or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json forward_speed(R run) {
  constexpr double kLeast = 1e-6;  // of the axis: less is rounding
  const Vec3 axis = rpy(run.scenario.orientation) * Vec3::UnitX();
  const double level = std::sqrt(axis.x() * axis.x() + axis.y() * axis.y());
  const double way = axis.x() * run.summary.displacement_x + axis.y() * run.summary.displacement_y;
  return or_null(level > kLeast && run.summary.simulated > 0 ? way / level / run.summary.simulated : kNoNumber);
}

Json fallen(R run) {
  const std::optional<Fall> found = fall(run.scenario, run.record);
  return found ? Json(found->time.has_value()) : Json();
}

Json held(R run, double Posture::*figure) { return or_null(run.summary.posture.*figure); }

template <class Named>
Json names(const Named& all) {
  Json list = Json::array();
  for (const auto& one : all) list.push_back(one.name);
  return list;
}

std::vector<SummaryNumber> list() {
  return {
      {.key = "name",
       .definition = "Name of the scenario.",
       .words = true,
       .value = [](R r) { return r.scenario.name; },
       .compare = {.place = 10, .if_different = true}},
      {.key = "engine",
       .definition = "Engine that simulated it.",
       .words = true,
       .value = [](R r) { return r.scenario.physics.engine->name; },
       .line = {90, "engine", texts::engine},
       .compare = {.place = 20, .if_different = true}},
      {.key = "step",
       .unit = "s",
       .definition = "The step, or the longest step of integrator `adaptive`.",
       .value = [](R r) { return r.scenario.physics.step; },
       .line = {92, "steps", texts::steps},
       .compare = {.place = 40, .if_different = true}},
      {.key = "step_setting",
       .unit = "s",
       .definition = "What the scenario says of the step: a number, or `auto`.",
       .words = true,
       .value = [](R r) { return r.scenario.physics.adaptive_step ? Json("auto") : Json(r.scenario.physics.step); }},
      {.key = "integrator",
       .definition = "Integrator of the engine.",
       .words = true,
       .value = [](R r) { return r.scenario.physics.integrator->name; },
       .compare = {.place = 30, .if_different = true}},
      {.key = "accuracy",
       .definition = "`physics.accuracy`; null where the integrator does not choose its steps.",
       .value = [](R r) { return r.scenario.physics.adapts() ? Json(r.scenario.physics.accuracy) : Json(); }},
      {.key = "solves",
       .definition = "Solutions of the equations of motion, until every law was met; 0: the engine does not count them.",
       .value = [](R r) { return r.record.tally.solves; }},
      {.key = "off_law",
       .definition = "Joint-steps that ended off the law of their motor or stop; above 0 the torques there are wrong.",
       .value = [](R r) { return r.record.tally.off; }},
      {.key = "coarse_time",
       .unit = "s",
       .definition = "Time in which the shortest steps of integrator `adaptive` did not reach the accuracy.",
       .value = [](R r) { return r.record.tally.coarse; }},
      {.key = "torque_error.worst",
       .definition = "Estimate of the error that the steps leave in the torques: RMS over the joint's largest torque (at least "
                     "2 % of the largest of all), of the worst joint ([equations](equations.md), 7); `torque_error` is null "
                     "where nothing is estimated.",
       .value = [](R r) { return estimated(r, [](const TorqueError& e) { return e.share; }); }},
      {.key = "torque_error.joint",
       .definition = "The worst joint.",
       .words = true,
       .value = [](R r) { return estimated(r, [&](const TorqueError& e) { return r.scenario.robot->joints[e.joint].name; }); }},
      {.key = "torque_error.per_joint",
       .unit = "N m",
       .definition = "RMS of the estimate, by joint.",
       .value = [](R r) { return estimated(r, [&](const TorqueError&) { return torque_errors(r); }); },
       .list = true},
      {.key = "duration",
       .unit = "s",
       .definition = "`duration` of the scenario.",
       .value = [](R r) { return r.scenario.duration; },
       .compare = {.place = 50, .if_different = true}},
      {.key = "outcome",
       .definition = "`done`, or why the run ended early.",
       .words = true,
       .value = [](R r) { return r.summary.outcome.text(); },
       .compare = {.place = 70, .if_different = true}},
      {.key = "simulated",
       .unit = "s",
       .definition = "Simulated time: less than `duration` where the run ended early.",
       .value = [](R r) { return r.summary.simulated; },
       .compare = {.place = 60, .if_different = true}},
      {.key = "judged.from",
       .unit = "s",
       .definition =
           "Start of the window by which the run is judged: whole periods up to the end, from the limit cycle on, or from "
           "earlier on where more than one period would be left out; without a limit cycle 2 s or a fifth of the "
           "run, whichever is earlier.",
       .value = [](R r) { return r.summary.judged.from; },
       .line = {42, "judged", texts::window}},
      {.key = "judged.to", .unit = "s", .definition = "Its end.", .value = [](R r) { return r.summary.judged.to; }},
      {.key = "judged.joint",
       .definition = "The most loaded joint in the window: longest at a limit, then of the largest torque RMS, then peak; "
                     "`judged.joint` and the next two are null where nothing drives the joints.",
       .words = true,
       .value = [](R r) { return of_motors(r, [&](const Judged& j) { return r.scenario.robot->joints[j.order[0]].name; }); },
       .compare = {.place = 215, .if_different = true}},
      {.key = "judged.saturated",
       .definition = "Its share of the window at the voltage or current limit: the largest of all joints.",
       .value = [](R r) { return of_motors(r, [](const Judged& j) { return j.joints[j.order[0]].limited(); }); },
       .line = {44, "motors", texts::limits},
       .compare = {216},
       .swap = {50, "at a limit", "share", 10, texts::saturated_cell}},
      {.key = "judged.joints_at_limit",
       .definition = "Number of joints that reach a limit in the window, however shortly.",
       .value = [](R r) { return of_motors(r, [](const Judged& j) { return Judged::limited(j.joints); }); },
       .compare = {217}},
      {.key = "wall_time",
       .unit = "s",
       .definition = "Time that the simulation took.",
       .value = [](R r) { return r.summary.wall_time; },
       .clock = true},
      {.key = "real_time_factor",
       .definition = "simulated / wall_time.",
       .value = [](R r) { return r.summary.wall_time > 0 ? Json(r.summary.simulated / r.summary.wall_time) : Json(0.0); },
       .clock = true},
      {.key = "seed",
       .definition = "`seed` of the scenario.",
       .value = [](R r) { return r.scenario.seed; },
       .compare = {.place = 80, .if_different = true}},
      {.key = "build",
       .definition = "Version, compiler and libraries of the program.",
       .words = true,
       .value = [](R r) { return r.summary.build; },
       .compare = {.place = 90, .if_different = true}},
      {.key = "modules",
       .definition = "Number of modules.",
       .value = [](R r) { return r.scenario.robot->modules.size(); },
       .line = {20, "robot", texts::robot},
       .compare = {.place = 100, .if_different = true}},
      {.key = "bodies", .definition = "Number of bodies.", .value = [](R r) { return r.scenario.robot->bodies.size(); }},
      {.key = "dof",
       .definition = "Degrees of freedom, six of a floating base included.",
       .value = [](R r) { return r.scenario.robot->dof(r.scenario.base); }},
      {.key = "mass",
       .unit = "kg",
       .definition = "Mass of the robot.",
       .value = [](R r) { return r.scenario.robot->mass; },
       .compare = {.place = 110, .if_different = true}},
      {.key = "joints",
       .definition = "Names of the joints, in the order of their numbers in the trace's columns.",
       .value = [](R r) { return names(r.scenario.robot->joints); },
       .list = true},
      {.key = "contacts",
       .definition = "Names of the contact elements, in the order of their numbers in the trace's columns.",
       .value = [](R r) { return names(contact_elements(*r.scenario.robot, r.scenario.contact.on)); },
       .list = true},
      {.key = "displacement.x",
       .unit = "m",
       .definition = "x of the centre of mass at the end minus at the start: the first element of an array.",
       .value = [](R r) { return r.summary.displacement_x; },
       .compare = {130},
       .golden = {20},
       .swap = {20, "travel x, y", "m", 19, texts::travel_cell}},
      {.key = "displacement.y",
       .unit = "m",
       .definition = "The same of y: the second element.",
       .value = [](R r) { return r.summary.displacement_y; },
       .compare = {140}},
      {.key = "distance",
       .unit = "m",
       .definition = "Norm of `displacement`: how far it got, horizontally.",
       .value = [](R r) { return r.summary.distance; },
       .line = {60, "distance", texts::distance},
       .compare = {120},
       .golden = {10}},
      {.key = "speed",
       .unit = "m/s",
       .definition = "distance / simulated.",
       .value = [](R r) { return r.summary.speed; },
       .line = {62, "speed", texts::speed},
       .compare = {150},
       .golden = {30},
       .swap = {10, "speed", "m/s", 10, texts::speed_cell}},
      {.key = "path_length",
       .unit = "m",
       .definition = "Length of the horizontal path of the centre of mass, from control tick to control tick.",
       .value = [](R r) { return r.summary.path_length; },
       .compare = {160},
       .golden = {40}},
      {.key = "straightness",
       .definition = "distance / path_length: 1 of a straight way; null where the robot has not moved.",
       .value =
           [](R r) { return or_null(r.summary.path_length > 0 ? r.summary.distance / r.summary.path_length : kNoNumber); }},
      {.key = "forward_speed",
       .unit = "m/s",
       .definition =
           "Part of `displacement` along the base's x axis at the start, level, over `simulated`: negative of a robot "
           "that goes backwards; null where that axis is upright.",
       .value = [](R r) { return forward_speed(r); }},
      {.key = "cycle_speed",
       .unit = "m/s",
       .definition = "Horizontal way of the centre of mass in the judged window, which is whole periods, over its length; null "
                     "without a limit cycle.",
       .value = [](R r) { return or_null(cycle_speed(r.record, r.summary.judged)); }},
      {.key = "heading_change",
       .unit = "rad",
       .definition =
           "Sum over the control ticks of the base's turn about world z (the twist of the rotation from tick to tick; a "
           "full turn counts 2 pi).",
       .value = [](R r) { return r.summary.heading_change; },
       .compare = {170}},
      {.key = "cost_of_transport.electrical",
       .unit = "J/(N m)",
       .definition = "sum(voltage * current * h) over all joints / (m g distance); 0 where the robot has not moved.",
       .value = [](R r) { return r.summary.cost_electrical; },
       .line = {80, "transport", texts::transport},
       .compare = {.place = 180, .label = "transport, electrical"},
       .golden = {.place = 50, .needs_motor = true, .needs_travel = true},
       .swap = {30, "cost of transport", "electr.      mech.", 22, texts::cost_cell}},
      {.key = "cost_of_transport.mechanical",
       .unit = "J/(N m)",
       .definition = "sum(max(T w, 0) h) over all joints / (m g distance); 0 where the robot has not moved.",
       .value = [](R r) { return r.summary.cost_mechanical; },
       .compare = {.place = 190, .label = "transport, mechanical"},
       .golden = {.place = 60, .needs_motor = true, .needs_travel = true}},
      {.key = "per_joint.J.torque.peak",
       .unit = "N m",
       .definition = "Largest motor torque, without the stop's.",
       .of_joint = of_whole_run(&F::torque_peak),
       .compare = {220},
       .golden = {.place = 70, .needs_motor = true}},
      {.key = "per_joint.J.torque.peak_time",
       .unit = "s",
       .definition = "Start of the step in which it was reached.",
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
       .definition = "The same in the first step: a jump of the set point at t = 0.",
       .of_joint = of_whole_run(&F::start_jump)},
      {.key = "per_joint.J.saturated.voltage",
       .definition = "Share of the time in saturation 1.",
       .of_joint = of_whole_run(&F::saturated_voltage)},
      {.key = "per_joint.J.saturated.current",
       .definition = "Share of the time in saturation 2.",
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
       .definition = "When: the end of the control tick (or the few, where the run is long) in which it was reached.",
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
       .definition = "When, in the same way.",
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
       .definition = "Share of the time in which the set point is outside [lo, hi].",
       .of_joint = of_whole_run(&F::setpoint_outside)},
      {.key = "per_joint.J.energy.electrical",
       .unit = "J",
       .definition = "sum(voltage * current * h).",
       .of_joint = of_whole_run(&F::electrical)},
      {.key = "per_joint.J.energy.copper", .unit = "J", .definition = "sum(R i^2 h).", .of_joint = of_whole_run(&F::copper)},
      {.key = "per_joint.J.energy.gear",
       .unit = "J",
       .definition = "sum(voltage * current - R i^2 - T w) h, all at one moment.",
       .of_joint = of_whole_run(&F::gear)},
      {.key = "per_joint.J.energy.created",
       .unit = "J",
       .definition =
           "The part of `energy.gear` that is gained, not lost, without its sign: -sum(min(gear power, 0) h). What eq. "
           "2 gives to back-driven joints; `gear` is what is left of the losses after it.",
       .of_joint = of_whole_run(&F::created)},
      {.key = "per_joint.J.energy.shaft", .unit = "J", .definition = "sum(T w h).", .of_joint = of_whole_run(&F::shaft)},
      {.key = "tracking_error.worst",
       .unit = "rad",
       .definition =
           "Largest `per_joint.J.tracking_error.peak`: over all steps, as other peaks; `tracking_error` is null where "
           "nothing drives the joints.",
       .value = [](R r) { return tracked(r, &F::error_peak); },
       .line = {48, "tracking", texts::tracking},
       .compare = {235},
       .golden = {.place = 65, .needs_motor = true},
       .swap = {60, "tracking", "error, rad", 10, texts::tracking_cell}},
      {.key = "tracking_error.joint",
       .definition = "The joint that has it.",
       .words = true,
       .value =
           [](R r) {
             return has_motors(r) ? Json(r.scenario.robot->joints[texts::worst(r.record, &F::error_peak)].name) : Json();
           }},
      {.key = "tracking_error.time",
       .unit = "s",
       .definition = "Start of the step in which it was reached.",
       .value = [](R r) { return tracked(r, &F::error_peak_time); }},
      {.key = "energy.electrical",
       .unit = "J",
       .definition =
           "Energy of the whole robot drawn from the supply: the ledger ([equations](equations.md), 8) at the last row "
           "of the trace, as are all numbers of this group.",
       .value = [](R r) { return r.record.ledger.electrical; },
       .line = {100, "energy", texts::drawn}},
      {.key = "energy.copper",
       .unit = "J",
       .definition = "Heat in the windings.",
       .value = [](R r) { return r.record.ledger.copper; },
       .line = {102, "", texts::ledger}},
      {.key = "energy.gear",
       .unit = "J",
       .definition = "Loss in the gears, less `created`.",
       .value = [](R r) { return r.record.ledger.gear; }},
      {.key = "energy.created",
       .unit = "J",
       .definition = "Sum of `per_joint.J.energy.created`.",
       .value = [](R r) { return texts::created(r.record); },
       .line = {106, "", texts::created_energy}},
      {.key = "energy.stored",
       .unit = "J",
       .definition = "Kinetic and potential energy, springs of hinges without a motor included, less that at the start.",
       .value = [](R r) { return r.record.ledger.stored; }},
      {.key = "energy.contact",
       .unit = "J",
       .definition = "Work done on the ground along its normal.",
       .value = [](R r) { return r.record.ledger.contact; }},
      {.key = "energy.friction",
       .unit = "J",
       .definition = "Work done on the ground along its surface.",
       .value = [](R r) { return r.record.ledger.friction; }},
      {.key = "energy.stops",
       .unit = "J",
       .definition = "Work done on the hinge stops.",
       .value = [](R r) { return r.record.ledger.stops; }},
      {.key = "energy.hinges",
       .unit = "J",
       .definition = "Lost in dampers and friction of hinges without a motor.",
       .value = [](R r) { return r.record.ledger.hinges; }},
      {.key = "energy.residual",
       .unit = "J",
       .definition = "What the ledger does not account for: the error of the integration.",
       .value = [](R r) { return r.record.ledger.residual(); }},
      {.key = "energy.residual_share",
       .definition = "Magnitude of `residual` over what was drawn (or stored, or lifts the robot by 1 mm, if that is more).",
       .value = [](R r) { return or_null(std::abs(r.record.ledger.residual()) / energy_scale(r.scenario, r.record)); }},
      {.key = "energy.created_share",
       .definition = "`created` over the same.",
       .value = [](R r) { return or_null(texts::created(r.record) / energy_scale(r.scenario, r.record)); }},
      {.key = "fell",
       .definition =
           "Whether the centre of mass came below `limits.height` of its height above the ground at the start (the check "
           "`fall` of the verdict); null of a base that is not floating, and without a ground.",
       .value = [](R r) { return fallen(r); }},
      {.key = "airborne_share",
       .definition =
           "Share of the control ticks in the judged window at which the ground bears less than 5 % of the weight; null "
           "without gravity, of a base that does not float, or of a robot without contact elements.",
       .value = [](R r) { return held(r, &Posture::airborne_share); }},
      {.key = "height.min",
       .unit = "m",
       .definition = "Least height of the centre of mass at the control ticks in the judged window.",
       .value = [](R r) { return held(r, &Posture::height_min); }},
      {.key = "height.max",
       .unit = "m",
       .definition = "The largest.",
       .value = [](R r) { return held(r, &Posture::height_max); }},
      {.key = "tilt.max",
       .unit = "rad",
       .definition =
           "Largest angle between the base's z axis and the vertical at these ticks (the check `upright` of the verdict "
           "is of the turn since the start).",
       .value = [](R r) { return held(r, &Posture::tilt_max); }},
      {.key = "limit_cycle.found",
       .definition = "Whether the motion has become periodic: see below.",
       .value = [](R r) { return r.summary.limit_cycle.found; },
       .line = {70, "limit cycle", texts::limit_cycle},
       .compare = {.place = 200, .if_different = true},
       .swap = {70, "", " limit cycle", -1, texts::limit_cycle_cell}},
      {.key = "limit_cycle.from",
       .unit = "s",
       .definition = "Since when; 0 where it is not found.",
       .value = [](R r) { return r.summary.limit_cycle.from; }},
      {.key = "limit_cycle.period",
       .unit = "s",
       .definition = "Its period, or that of the best candidate; 0 without one.",
       .value = [](R r) { return r.summary.limit_cycle.period; },
       .compare = {210}},
      {.key = "limit_cycle.error",
       .definition = "How well it repeats; 1 without a candidate.",
       .value = [](R r) { return r.summary.limit_cycle.error; }},
      {.key = "stability.max",
       .definition = "Largest h lambda seen at the control ticks ([equations](equations.md)).",
       .value = [](R r) { return r.summary.stability_max; },
       .line = {130, "stability", texts::stability},
       .compare = {240}},
      {.key = "stability.share_above_1",
       .definition = "Share of the control ticks at which h lambda exceeds 1.",
       .value = [](R r) { return r.summary.stability_share; }},
      {.key = "stability.source",
       .definition = "What has the largest lambda.",
       .words = true,
       .value = [](R r) { return r.summary.stability_source; }},
      {.key = "trace_hash",
       .definition = "FNV-1a, 64 bit, over the names and the bytes of all columns.",
       .words = true,
       .value = [](R r) { return hash(r.record.trace); },
       .compare = {250}},
  };
}

}  // namespace

std::string SummaryNumber::pointer(const std::string& joint) const {
  nlohmann::json::json_pointer path;
  for (std::string_view rest = key; !rest.empty();) {
    const std::string_view part = rest.substr(0, rest.find('.'));
    path /= part == "J" ? joint : part == "x" ? "0" : part == "y" ? "1" : std::string(part);
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
  }
  return path.to_string();
}

std::string SummaryNumber::name(const std::string& joint) const {
  return of_joint == nullptr ? key : joint + "." + (key + kOfJoint.size());
}

std::string SummaryNumber::row(const std::string& joint) const {
  std::string words = of_joint == nullptr ? key : key + kOfJoint.size();
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == '_' || c == '.'; }, ' ');
  if (*unit != '\0') words += std::string(", ") + unit;
  if (compare.label != nullptr) words = compare.label;
  return of_joint == nullptr ? words : joint + " " + words;
}

const std::vector<SummaryNumber>& summary_numbers() {
  static const std::vector<SummaryNumber> kAll = list();
  return kAll;
}

bool has_motors(const RunData& run) { return run.scenario.actuator.entry != nullptr && !run.record.joints.empty(); }

bool has_motors(const Scenario& scenario) { return scenario.actuator.entry != nullptr && !scenario.robot->joints.empty(); }

}  // namespace gaitlab::report
