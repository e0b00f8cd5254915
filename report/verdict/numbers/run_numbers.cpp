// Summary numbers of a run: settings and outcome, judged window, robot, and the path that it travelled.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/scenario/buses.h"
#include "report/analysis/bus.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/numbers/numbers.h"
#include "report/verdict/rolled.h"
#include "report/verdict/spread.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;
using R = const RunData&;

/// Number computed by `of` from the judged window, or null if no joint has a motor.
template <class Of>
Json of_motors(R run, Of of) {
  return has_motors(run) ? Json(of(run.summary.judged)) : Json();
}

/// Number computed by `of` from the torque error, or null if it was not estimated.
template <class Of>
Json estimated(R run, Of of) {
  const TorqueError error = torque_error(run.record);
  return error.estimated ? Json(of(error)) : Json();
}

Json joint_of(R run, const Parting& parting) {
  return parting.time < 0 ? Json() : Json(run.scenario.robot->joints[parting.joint].name);
}

const Parting& apart(R run) { return parting(run.scenario, run.record); }

/// Number computed by `of`, or null if no rollout with changed gravity was made.
template <class Of>
Json tried(R run, Of of) {
  return predictability(run.scenario, run.record) == Predictability::unknown ? Json() : Json(of());
}

Json spread_of(R run, const char* column) {
  const std::optional<Between> found = between(run.record.spread, column);
  return found ? Json::array({found->low, found->high}) : Json();
}

Json torque_errors(R run) {
  Json::object_t each;
  for (std::size_t j = 0; j < run.record.joints.size(); ++j)  // operator[] would search all previous names
    each.Container::emplace_back(run.scenario.robot->joints[j].name, run.record.tally.torque_error[j]);
  return each;
}

/// The largest of the numbers computed by `of` from each bus in the judged window, or null without a supply.
template <class Of>
Json of_buses(R run, Of of) {
  Json most;
  const std::vector<MotorBus> all = buses(run.scenario);
  for (std::size_t number = 0; number < run.record.buses(); ++number) {
    const std::optional<BusUse> use = bus_use(run.record, number, run.summary.judged.first_row);
    if (!use) return {};
    const double value = of(*use, number < all.size() ? all[number].supply : Supply());
    if (most.is_null() || value > most.get<double>()) most = value;
  }
  return most;
}

Json least(const Json& negative) { return negative.is_null() ? Json() : Json(-negative.get<double>()); }

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

Json forward_speed(R run) {
  constexpr double kLeast = 1e-6;  // least horizontal length of the unit vector `axis`; a smaller length is only rounding error
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
       .definition = "Engine of the simulation.",
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
       .definition = "`physics.step` of the scenario: a number, or `auto`.",
       .words = true,
       .value = [](R r) { return r.scenario.physics.adaptive_step ? Json("auto") : Json(r.scenario.physics.step); }},
      {.key = "integrator",
       .definition = "Integrator of the engine.",
       .words = true,
       .value = [](R r) { return r.scenario.physics.integrator->name; },
       .compare = {.place = 30, .if_different = true}},
      {.key = "accuracy",
       .definition = "`physics.accuracy`; null for an integrator with a fixed step.",
       .value = [](R r) { return r.scenario.physics.adapts() ? Json(r.scenario.physics.accuracy) : Json(); }},
      {.key = "solves",
       .definition = "Number of solutions of the equations of motion, repeated solutions of a step included; 0: "
                     "the engine does not count them.",
       .value = [](R r) { return r.record.tally.solves; }},
      {.key = "off_law",
       .definition = "Number of joint-steps that do not satisfy the law of their motor or end stop; if it is above 0, the "
                     "torques in these steps "
                     "are wrong.",
       .value = [](R r) { return r.record.tally.off; }},
      {.key = "coarse_time",
       .unit = "s",
       .definition = "Time in which even the shortest steps of integrator `adaptive` did not reach the accuracy.",
       .value = [](R r) { return r.record.tally.coarse; }},
      {.key = "torque_error.worst",
       .definition = "Estimate of the integration error of the torques: RMS over the joint's largest torque (at "
                     "least 2 % of the largest torque of all joints), for the worst joint ([equations](equations.md), 7); "
                     "`torque_error` is null without an estimate.",
       .value = [](R r) { return estimated(r, [](const TorqueError& e) { return e.share; }); }},
      {.key = "torque_error.joint",
       .definition = "The worst joint.",
       .words = true,
       .value = [](R r) { return estimated(r, [&](const TorqueError& e) { return r.scenario.robot->joints[e.joint].name; }); }},
      {.key = "torque_error.per_joint",
       .unit = "N m",
       .definition = "RMS of the estimated error, by joint.",
       .value = [](R r) { return estimated(r, [&](const TorqueError&) { return torque_errors(r); }); },
       .list = true},
      {.key = "torque_event.time",
       .unit = "s",
       .definition = "First time at which the estimated error of a torque exceeds the share `accuracy` (1 % if the step is "
                     "given) of the torque's peak; `torque_event` is null if no error exceeds it.",
       .value = [](R r) { return r.record.tally.event.time < 0 ? Json() : Json(r.record.tally.event.time); }},
      {.key = "torque_event.joint",
       .definition = "Joint of that torque.",
       .words = true,
       .value = [](R r) { return joint_of(r, r.record.tally.event); }},
      {.key = "predictable.until",
       .unit = "s",
       .definition = "First time at which a torque changes by more than `accuracy` under gravity times 1 + 1e-6 "
                     "(computed as 1000 times the change under 1 + 1e-9); if a torque as a whole (RMS over the peak) changes "
                     "by more than `accuracy` under 1 + 1e-9, the first such time under 1 + 1e-9; the duration if no torque "
                     "changes that much. `predictable` is null if this was not tested.",
       .value = [](R r) { return tried(r, [&] { return apart(r).time < 0 ? r.record.simulated : apart(r).time; }); }},
      {.key = "predictable.chaotic",
       .definition = "Change of the torques under gravity times 1 + 1e-9: RMS over the joint's peak, for the worst joint.",
       .value = [](R r) { return tried(r, [&] { return r.record.tally.chaotic.share; }); }},
      {.key = "predictable.ill",
       .definition = "`chaotic` times 1000: an estimate of the change under gravity times 1 + 1e-6, in proportion.",
       .value = [](R r) { return tried(r, [&] { return r.record.tally.ill.share; }); }},
      {.key = "spread.torque_peak",
       .unit = "N m",
       .definition = "Least and largest value of the largest motor torque, over four rollouts of a motion that "
                     "is not predictable: under gravity times 1 and 1 +- 1e-9 (1e-6 if it is ill-conditioned), "
                     "and with half the accuracy. `spread` is null for other motions.",
       .value = [](R r) { return spread_of(r, "torque_peak"); },
       .list = true},
      {.key = "spread.torque_rms",
       .unit = "N m",
       .definition = "Least and largest value of the largest RMS of a motor torque, over the same rollouts.",
       .value = [](R r) { return spread_of(r, "torque_rms"); },
       .list = true},
      {.key = "spread.distance",
       .unit = "m",
       .definition = "Least and largest value of `distance`, over the same rollouts.",
       .value = [](R r) { return spread_of(r, "distance"); },
       .list = true},
      {.key = "spread.margin",
       .definition = "Least and largest value of the least margin of the checks that can fail, over the same rollouts.",
       .value = [](R r) { return spread_of(r, kLeastMargin); },
       .list = true},
      {.key = "duration",
       .unit = "s",
       .definition = "`duration` of the scenario.",
       .value = [](R r) { return r.scenario.duration; },
       .compare = {.place = 50, .if_different = true}},
      {.key = "outcome",
       .definition = "`done`, or the reason for an early end of the run.",
       .words = true,
       .value = [](R r) { return r.summary.outcome.text(); },
       .compare = {.place = 70, .if_different = true}},
      {.key = "simulated",
       .unit = "s",
       .definition = "Simulated time; less than `duration` if the run ended early.",
       .value = [](R r) { return r.summary.simulated; },
       .compare = {.place = 60, .if_different = true}},
      {.key = "judged.from",
       .unit = "s",
       .definition = "Start of the judged window: whole periods up to the end, without the first after "
                     "the start of the gait. The gait starts when a ramp of the cpg has ended, after the last change of "
                     "the run, and when the ground carries half of the weight in the mean of each period from then on. "
                     "The period is that of the limit cycle or, without one, of the set points. If fewer than two periods are "
                     "left, the window starts 2 s after the start of the gait, or after a fifth of the rest, whichever is "
                     "earlier; if the set points do not repeat, it starts at 0.",
       .value = [](R r) { return r.summary.judged.from; },
       .line = {42, "judged", texts::window}},
      {.key = "judged.to",
       .unit = "s",
       .definition = "End of the judged window.",
       .value = [](R r) { return r.summary.judged.to; }},
      {.key = "judged.joint",
       .definition = "The most loaded joint in the window: longest at a limit, then largest torque RMS, then "
                     "largest peak. `judged.joint`, `judged.saturated` and `judged.joints_at_limit` are null if no joint has a "
                     "motor.",
       .words = true,
       .value = [](R r) { return of_motors(r, [&](const Judged& j) { return r.scenario.robot->joints[j.order[0]].name; }); },
       .compare = {.place = 215, .if_different = true}},
      {.key = "judged.saturated",
       .definition = "Share of the window in which that joint is at the voltage or current limit: the largest "
                     "of all joints.",
       .value = [](R r) { return of_motors(r, [](const Judged& j) { return j.joints[j.order[0]].limited(); }); },
       .line = {44, "motors", texts::limits},
       .compare = {216},
       .swap = {50, "at a limit", "share", 10, texts::saturated_cell}},
      {.key = "judged.joints_at_limit",
       .definition = "Number of joints that reach a limit in the window, however briefly.",
       .value = [](R r) { return of_motors(r, [](const Judged& j) { return Judged::limited(j.joints); }); },
       .compare = {217}},
      {.key = "robot_current.peak",
       .unit = "A",
       .definition = "Largest sum of the magnitudes of all motors' currents, over all steps; null if no joint has a motor.",
       .value = [](R r) { return of_motors(r, [&](const Judged&) { return or_null(r.record.current_peak); }); }},
      {.key = "robot_current.rms",
       .unit = "A",
       .definition = "RMS of the sum of the magnitudes of all motors' currents, over the whole run.",
       .value = [](R r) { return of_motors(r, [&](const Judged&) { return or_null(r.record.current_rms); }); }},
      {.key = "supply.voltage_least",
       .unit = "V",
       .definition =
           "Least voltage of a bus in the window, at control ticks; this number and the next two are those of the worst "
           "battery, and null without a supply.",
       .value = [](R r) { return least(of_buses(r, [](const BusUse& bus, const Supply&) { return -bus.voltage_least; })); }},
      {.key = "supply.current_rms",
       .unit = "A",
       .definition = "RMS current of the supply in the window, at control ticks.",
       .value = [](R r) { return of_buses(r, [](const BusUse& bus, const Supply&) { return bus.current_rms; }); }},
      {.key = "supply.current_peak",
       .unit = "A",
       .definition = "Largest current of the supply in the window, at control ticks.",
       .value = [](R r) { return of_buses(r, [](const BusUse& bus, const Supply&) { return bus.current_peak; }); }},
      {.key = "supply.endurance",
       .unit = "min",
       .definition =
           "Time until the mean current of the window has drawn the capacity of a supply or battery, the first of all; null "
           "if no capacity is stated.",
       .value = [](R r) { return or_null(endurance(r.scenario, r.record, r.summary.judged.first_row).minutes); }},
      {.key = "wall_time",
       .unit = "s",
       .definition = "Real time of the simulation.",
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
       .definition = "Degrees of freedom, including six of a floating base.",
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
       .definition = "x of the centre of mass at the end minus x at the start: the first element of an array.",
       .value = [](R r) { return r.summary.displacement_x; },
       .compare = {130},
       .golden = {20},
       .swap = {20, "travel x, y", "m", 19, texts::travel_cell}},
      {.key = "displacement.y",
       .unit = "m",
       .definition = "y of the centre of mass at the end minus y at the start: the second element of the array.",
       .value = [](R r) { return r.summary.displacement_y; },
       .compare = {140}},
      {.key = "distance",
       .unit = "m",
       .definition = "Norm of `displacement`: the horizontal distance travelled.",
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
       .definition = "distance / path_length: 1 for a straight path; null if the robot has not moved.",
       .value =
           [](R r) { return or_null(r.summary.path_length > 0 ? r.summary.distance / r.summary.path_length : kNoNumber); }},
      {.key = "forward_speed",
       .unit = "m/s",
       .definition = "Component of `displacement` along the horizontal direction of the base's x axis at the "
                     "start, over `simulated`: negative if the robot moves backwards; null if that axis is "
                     "vertical.",
       .value = [](R r) { return forward_speed(r); }},
      {.key = "cycle_speed",
       .unit = "m/s",
       .definition = "Horizontal displacement of the centre of mass in the judged window (whole periods), over "
                     "its length; null without a limit cycle.",
       .value = [](R r) { return or_null(cycle_speed(r.record, r.summary.judged)); }},
      {.key = "heading_change",
       .unit = "rad",
       .definition = "Rotation of the base about world z, summed over the control ticks (twist of the rotation "
                     "from tick to tick; a full turn counts 2 pi).",
       .value = [](R r) { return r.summary.heading_change; },
       .compare = {170}},
      {.key = "cost_of_transport.electrical",
       .unit = "J/(N m)",
       .definition = "sum(voltage * current * h) over all joints / (m g distance); 0 if the robot has not moved.",
       .value = [](R r) { return r.summary.cost_electrical; },
       .line = {80, "transport", texts::transport},
       .compare = {.place = 180, .label = "transport, electrical"},
       .golden = {.place = 50, .needs_motor = true, .needs_travel = true},
       .swap = {30, "cost of transport", "electr.      mech.", 22, texts::cost_cell}},
      {.key = "cost_of_transport.mechanical",
       .unit = "J/(N m)",
       .definition = "sum(max(T w, 0) h) over all joints / (m g distance); 0 if the robot has not moved.",
       .value = [](R r) { return r.summary.cost_mechanical; },
       .compare = {.place = 190, .label = "transport, mechanical"},
       .golden = {.place = 60, .needs_motor = true, .needs_travel = true}},
  };
}

}  // namespace gaitlab::report
