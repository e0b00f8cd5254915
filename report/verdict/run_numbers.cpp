// Summary numbers of a run: what it was, its judged window, the robot, and the way it went.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/verdict/number_list.h"
#include "report/verdict/number_texts.h"
#include "report/verdict/spread.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;
using R = const RunData&;

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

Json joint_of(R run, const Parting& parting) {
  return parting.time < 0 ? Json() : Json(run.scenario.robot->joints[parting.joint].name);
}

const Parting& apart(R run) { return parting(run.scenario, run.record); }

/// `of` null: rollouts under a disturbed gravity were not made.
template <class Of>
Json tried(R run, Of of) {
  return predictability(run.scenario, run.record) == Predictability::unknown ? Json() : Json(of());
}

Json spread_of(R run, const char* column) {
  const std::optional<Between> found = between(run.record.spread, column);
  return found ? Json::array({found->low, found->high}) : Json();
}

Json torque_errors(R run) {
  Json each = Json::object();
  for (std::size_t j = 0; j < run.record.joints.size(); ++j)
    each[run.scenario.robot->joints[j].name] = run.record.tally.torque_error[j];
  return each;
}

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

Json forward_speed(R run) {
  constexpr double kLeast = 1e-6;  // of the axis: less is rounding
  const Vec3 axis = rpy(run.scenario.orientation) * Vec3::UnitX();
  const double level = std::sqrt(axis.x() * axis.x() + axis.y() * axis.y());
  const double way = axis.x() * run.summary.displacement_x + axis.y() * run.summary.displacement_y;
  return or_null(level > kLeast && run.summary.simulated > 0 ? way / level / run.summary.simulated : kNoNumber);
}

template <class Named>
Json names(const Named& all) {
  Json list = Json::array();
  for (const auto& one : all) list.push_back(one.name);
  return list;
}

}  // namespace

std::vector<SummaryNumber> run_numbers() {
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
      {.key = "torque_event.time",
       .unit = "s",
       .definition = "When a torque was first off by more than `accuracy` (1 % where the step is given) of its peak, by the "
                     "estimate; `torque_event` is null where none was.",
       .value = [](R r) { return r.record.tally.event.time < 0 ? Json() : Json(r.record.tally.event.time); }},
      {.key = "torque_event.joint",
       .definition = "Its joint.",
       .words = true,
       .value = [](R r) { return joint_of(r, r.record.tally.event); }},
      {.key = "predictable.until",
       .unit = "s",
       .definition =
           "When a torque changed first by more than `accuracy` under gravity times 1 + 1e-6 (in proportion to the change by "
           "1 + 1e-9), or, where they change by more than that on the whole (RMS over the peak) by 1 + 1e-9, by that; the "
           "duration where none did. `predictable` is null where it was not tried.",
       .value = [](R r) { return tried(r, [&] { return apart(r).time < 0 ? r.record.simulated : apart(r).time; }); }},
      {.key = "predictable.chaotic",
       .definition = "Change of the torques under gravity times 1 + 1e-9: RMS over the joint's peak, of the worst joint.",
       .value = [](R r) { return tried(r, [&] { return r.record.tally.chaotic.share; }); }},
      {.key = "predictable.ill",
       .definition = "The same times 1000: by 1 + 1e-6, in proportion.",
       .value = [](R r) { return tried(r, [&] { return r.record.tally.ill.share; }); }},
      {.key = "spread.torque_peak",
       .unit = "N m",
       .definition = "Of a motion that is not predictable: least and largest of four rollouts, under gravity times 1 and 1 +- "
                     "1e-9 (1e-6 of an ill-conditioned one) and with half the accuracy: largest motor torque. `spread` is null "
                     "elsewhere.",
       .value = [](R r) { return spread_of(r, "torque_peak"); },
       .list = true},
      {.key = "spread.torque_rms",
       .unit = "N m",
       .definition = "The same of the largest RMS of a motor torque.",
       .value = [](R r) { return spread_of(r, "torque_rms"); },
       .list = true},
      {.key = "spread.distance",
       .unit = "m",
       .definition = "The same of `distance`.",
       .value = [](R r) { return spread_of(r, "distance"); },
       .list = true},
      {.key = "spread.margin",
       .definition = "The same of the least margin of the checks that can fail.",
       .value = [](R r) { return spread_of(r, kLeastMargin); },
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
           "run, whichever is earlier; where the set points do not repeat, 0.",
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
  };
}

}  // namespace gaitlab::report
