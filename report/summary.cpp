#include "report/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/scenario/value.h"
#include "core/simulation/start.h"
#include "core/simulation/step_advice.h"
#include "report/build_id.h"
#include "report/trust.h"

namespace gaitlab {

namespace {

using Json = nlohmann::ordered_json;

/// Turn about world z from one tick to the next: the twist of the rotation between them. Defined however far the base is
/// pitched.
double twist(const std::vector<double>& poses, std::size_t tick) {
  const auto at = [&](std::size_t k) { return Quat(poses[7 * k + 3], poses[7 * k + 4], poses[7 * k + 5], poses[7 * k + 6]); };
  const Quat turn = at(tick) * at(tick - 1).conjugate();
  return std::remainder(2 * math::atan2(turn.z(), turn.w()), 2 * std::numbers::pi);
}

void travel(const RunRecord& r, Summary& s) {
  const std::size_t ticks = r.com_x.size();
  if (ticks == 0) return;
  s.displacement_x = r.com_x.back() - r.com_x.front();
  s.displacement_y = r.com_y.back() - r.com_y.front();
  s.distance = std::hypot(s.displacement_x, s.displacement_y);
  s.speed = s.simulated > 0 ? s.distance / s.simulated : 0;
  for (std::size_t k = 1; k < ticks; ++k) {
    s.path_length += std::hypot(r.com_x[k] - r.com_x[k - 1], r.com_y[k] - r.com_y[k - 1]);
    s.heading_change += twist(r.poses, k);
  }
}

void transport(const Scenario& scenario, const RunRecord& r, Summary& s) {
  double electrical = 0;
  double mechanical = 0;
  for (const JointFigures& joint : r.joints) {
    electrical += joint.electrical;
    mechanical += joint.shaft_positive;
  }
  const double work = scenario.robot->mass * scenario.physics.gravity.norm() * s.distance;
  if (!(work > 0)) return;
  s.cost_electrical = electrical / work;
  s.cost_mechanical = mechanical / work;
}

LimitCycle cycle(const Scenario& scenario, const RunRecord& r, const Summary& s) {
  const std::size_t n = scenario.robot->joints.size();
  if (n == 0) return {};
  // The last row may lie off the grid of trace periods.
  const auto ticks = static_cast<std::size_t>(std::floor(s.simulated / scenario.trace.period + 1e-9)) + 1;
  std::vector<double> both;
  both.reserve(r.angles.size() * 2);
  for (std::size_t at = 0; at < std::min(ticks * n, r.angles.size()); at += n) {
    both.insert(both.end(), r.angles.begin() + static_cast<std::ptrdiff_t>(at),
                r.angles.begin() + static_cast<std::ptrdiff_t>(at + n));
    both.insert(both.end(), r.setpoints.begin() + static_cast<std::ptrdiff_t>(at),
                r.setpoints.begin() + static_cast<std::ptrdiff_t>(at + n));
  }
  return find_limit_cycle(both, 2 * n, scenario.trace.period);
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

/// J: what the gears gave instead of losing it.
double created(const RunRecord& r) {
  double sum = 0;
  for (const JointFigures& joint : r.joints) sum += joint.created;
  return sum;
}

std::string ledger_text(const RunRecord& r) {
  const Ledger& l = r.ledger;
  std::string text = fmt::format("{:.4g} J drawn = {:.4g} copper", l.electrical, l.copper);
  const auto add = [&](double value, const char* what) {
    if (value != 0) text += fmt::format(" {} {:.3g} {}", value < 0 ? '-' : '+', std::abs(value), what);
  };
  add(l.gear, "gear");
  add(l.stored, "stored");
  add(l.contact, "contact");
  add(l.friction, "friction");
  add(l.stops, "stops");
  add(l.residual(), "residual");
  if (l.electrical > 0) text += fmt::format(" ({:.2g} %)", 100 * l.residual() / l.electrical);
  return text;
}

/// null: not estimated.
Json torque_error_json(const Robot& robot, const RunRecord& r) {
  const TorqueError worst = torque_error(r);
  if (!worst.estimated) return {};
  Json each = Json::object();
  for (std::size_t j = 0; j < robot.joints.size(); ++j) each[robot.joints[j].name] = r.tally.torque_error[j];
  return {{"worst", worst.share}, {"joint", robot.joints[worst.joint].name}, {"per_joint", each}};
}

constexpr double kVisible = 1e-3;  // share of what is drawn
constexpr double kNowhere = 1e-3;  // m: the work of a robot that stays is divided by noise

}  // namespace

Summary summarise(const Scenario& scenario, const RunRecord& r, double wall_time) {
  Summary s;
  s.wall_time = wall_time;
  s.build = build_id();
  s.simulated = r.simulated;
  travel(r, s);
  transport(scenario, r, s);
  s.limit_cycle = cycle(scenario, r, s);
  s.stability_max = scenario.physics.step * r.worst.rate;
  s.stability_share = r.ticks > 0 ? static_cast<double>(r.ticks_above_1) / static_cast<double>(r.ticks) : 0;
  const auto contacts = contact_elements(*scenario.robot, scenario.contact.on);
  if (r.worst.rate > 0) s.stability_source = source_of(r.worst, *scenario.robot, contacts);
  for (std::size_t j = 1; j < r.joints.size(); ++j) {
    if (r.joints[j].torque_peak > r.joints[s.most_loaded].torque_peak) s.most_loaded = j;
  }
  s.trace_hash = hash(r.trace);
  return s;
}

std::string to_json(const Summary& s, const Scenario& scenario, const RunRecord& r) {
  const Robot& robot = *scenario.robot;
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  nlohmann::ordered_json contacts = nlohmann::ordered_json::array();
  for (const ContactElement& c : contact_elements(robot, scenario.contact.on)) contacts.push_back(c.name);
  nlohmann::ordered_json per_joint = nlohmann::ordered_json::object();
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const JointFigures& f = r.joints[j];
    names.push_back(robot.joints[j].name);
    per_joint[robot.joints[j].name] = {
        {"torque", {{"peak", f.torque_peak}, {"rms", f.torque_rms}}},
        {"speed", {{"peak", f.speed_peak}}},
        {"current", {{"peak", f.current_peak}, {"rms", f.current_rms}}},
        {"tracking_error", {{"rms", f.error_rms}, {"peak", f.error_peak}}},
        {"saturated", {{"voltage", f.saturated_voltage}, {"current", f.saturated_current}}},
        {"range", {{"share", f.range_share}, {"worst", f.range_worst}, {"setpoint_share", f.setpoint_outside}}},
        {"energy",
         {{"electrical", f.electrical}, {"copper", f.copper}, {"gear", f.gear}, {"created", f.created}, {"shaft", f.shaft}}}};
  }
  nlohmann::ordered_json json = {
      {"name", scenario.name},
      {"engine", scenario.physics.engine->name},
      {"step", scenario.physics.step},
      {"step_setting", scenario.physics.adaptive_step ? Json("auto") : Json(scenario.physics.step)},
      {"integrator", scenario.physics.integrator->name},
      {"accuracy", scenario.physics.adapts() ? Json(scenario.physics.accuracy) : Json()},
      {"solves", r.tally.solves},
      {"off_law", r.tally.off},
      {"coarse_time", r.tally.coarse},
      {"torque_error", torque_error_json(robot, r)},
      {"duration", scenario.duration},
      {"outcome", s.outcome},
      {"simulated", s.simulated},
      {"wall_time", s.wall_time},
      {"real_time_factor", s.wall_time > 0 ? s.simulated / s.wall_time : 0},
      {"seed", scenario.seed},
      {"build", s.build},
      {"modules", robot.modules.size()},
      {"bodies", robot.bodies.size()},
      {"dof", robot.dof(scenario.base)},
      {"mass", robot.mass},
      {"joints", names},
      {"contacts", contacts},
      {"displacement", {s.displacement_x, s.displacement_y}},
      {"distance", s.distance},
      {"speed", s.speed},
      {"path_length", s.path_length},
      {"heading_change", s.heading_change},
      {"cost_of_transport", {{"electrical", s.cost_electrical}, {"mechanical", s.cost_mechanical}}},
      {"per_joint", per_joint},
      {"energy",
       {{"electrical", r.ledger.electrical},
        {"copper", r.ledger.copper},
        {"gear", r.ledger.gear},
        {"created", created(r)},
        {"stored", r.ledger.stored},
        {"contact", r.ledger.contact},
        {"friction", r.ledger.friction},
        {"stops", r.ledger.stops},
        {"residual", r.ledger.residual()}}},
      {"limit_cycle",
       {{"found", s.limit_cycle.found},
        {"from", s.limit_cycle.from},
        {"period", s.limit_cycle.period},
        {"error", s.limit_cycle.error}}},
      {"stability", {{"max", s.stability_max}, {"share_above_1", s.stability_share}, {"source", s.stability_source}}},
      {"trace_hash", s.trace_hash}};
  return json.dump(2) + "\n";
}

std::string to_text(const Summary& s, const Scenario& scenario, const RunRecord& r) {
  const Robot& robot = *scenario.robot;
  const auto line = [](const char* what, const std::string& text) { return fmt::format("  {:<13} {}\n", what, text); };
  std::string text = fmt::format("{}: {:.6g} s simulated in {:.2f} s ({:.2g} times real time)\n", scenario.name, s.simulated,
                                 s.wall_time, s.wall_time > 0 ? s.simulated / s.wall_time : 0);
  text += line("engine", fmt::format("{} ({})", scenario.physics.engine->name, scenario.physics.integrator->name));
  text += line("steps", steps_text(scenario, r));
  text += line("robot", fmt::format("{} modules, {} bodies, {} joints, {} degrees of freedom, {:.3f} kg", robot.modules.size(),
                                    robot.bodies.size(), robot.joints.size(), robot.dof(scenario.base), robot.mass));
  text += line("distance", fmt::format("{:.4f} m (x {:+.4f}, y {:+.4f}), heading change {:+.3f} rad", s.distance,
                                       s.displacement_x, s.displacement_y, s.heading_change));
  text += line("speed", fmt::format("{:.4f} m/s over a path of {:.4f} m", s.speed, s.path_length));
  text += line("limit cycle", s.limit_cycle.found
                                  ? fmt::format("from t = {:.2f} s, period {:.4f} s, repeats to {}", s.limit_cycle.from,
                                                s.limit_cycle.period, percent(s.limit_cycle.error))
                                  : std::string("none found"));
  if (scenario.actuator.entry != nullptr && !r.joints.empty()) {
    text += line("transport", s.distance < kNowhere
                                  ? std::string("no cost: it went nowhere")
                                  : fmt::format("cost {:.3g} electrical, {:.3g} mechanical (J per N of weight and m)",
                                                s.cost_electrical, s.cost_mechanical));
    const JointFigures& f = r.joints[s.most_loaded];
    text += line("most loaded",
                 fmt::format("joint {} ({}): torque peak {:.3f} N m, RMS {:.3f} N m; saturated {} voltage, {} current",
                             s.most_loaded, robot.joints[s.most_loaded].name, f.torque_peak, f.torque_rms,
                             percent(f.saturated_voltage), percent(f.saturated_current)));
  }
  if (scenario.actuator.entry != nullptr && !r.joints.empty()) {
    text += line("energy", ledger_text(r));
    if (created(r) > kVisible * r.ledger.electrical) {
      text += line(
          "", fmt::format("the gears created {:.3g} J (eq. 2 on back-driven joints; actuator.efficiency_model: directional "
                          "does not)",
                          created(r)));
    }
  }
  for (std::size_t j = 0; j < r.joints.size(); ++j) {
    const JointFigures& f = r.joints[j];
    if (f.setpoint_outside > 0 || f.range_share > 0) {
      text +=
          line("range", fmt::format("joint {} ({}): outside its range {} of the time, worst by {:.3g} rad; its set point {}", j,
                                    robot.joints[j].name, percent(f.range_share), f.range_worst, percent(f.setpoint_outside)));
    }
  }
  if (!s.stability_source.empty()) {
    text += line("stability", fmt::format("h lambda at most {:.2f} at t = {:.2f} s ({}); above 1 in {} of the ticks",
                                          s.stability_max, r.worst_time, s.stability_source, percent(s.stability_share)));
  }
  return text;
}

namespace {

/// A field's height says nothing about how high the robot stands above it.
bool has_height(const Ground& ground) { return ground.kind == Ground::Kind::plane || ground.kind == Ground::Kind::boxes; }

}  // namespace

std::string start_warning(const Scenario& scenario) {
  if (!has_height(scenario.ground)) return "";
  const RobotState start = start_state(scenario);
  Kinematics k(*scenario.robot);
  k.update(*scenario.robot, start);
  constexpr double kSunk = 1e-3;  // m
  const double lowest = lowest_point(*scenario.robot, k, {});
  if (lowest >= -kSunk) return "";
  const std::string deep = fmt::format("the robot starts {:.3g} m deep in the ground: ", -lowest);
  if (!scenario.on_ground) {
    return deep + fmt::format(
                      "on_ground is off (a position of three numbers turns it off) and the base frame starts at z = {} m; "
                      "position: [{}, {}] lowers the robot onto the ground there",
                      number_text(start.position.z()), number_text(start.position.x()), number_text(start.position.y()));
  }
  return deep + fmt::format("only the elements of contact.on: {} touch it; is it upside down?",
                            scenario.contact.on == ContactSet::feet ? "feet" : "none");
}

std::string fall_warning(const Scenario& scenario, const RunRecord& r) {
  if (!has_height(scenario.ground) || r.poses.empty() || scenario.base != Base::floating) return "";
  const Robot& robot = *scenario.robot;
  Kinematics k(robot);
  k.update(robot, r.state(robot, 0));
  const double start = sums(robot, k, Vec3::Zero()).com.z();
  for (std::size_t tick = 0; start > 0 && tick < r.com_z.size(); ++tick) {
    if (r.com_z[tick] > 0.5 * start) continue;
    return fmt::format("it fell: at t = {:.2f} s the centre of mass is at {:.3f} m, from {:.3f} m at the start",
                       std::min(static_cast<double>(tick) * scenario.trace.period, r.simulated), r.com_z[tick], start);
  }
  return "";
}

std::string stability_warning(const Summary& s, const Scenario& scenario, const RunRecord& r) {
  if (!(s.stability_share > 0.01)) return "";
  const auto contacts = contact_elements(*scenario.robot, scenario.contact.on);
  return fmt::format("in {} of the control ticks {}", percent(s.stability_share),
                     step_advice(scenario, contacts, r.worst, fmt::format("at t = {:.2f} s", r.worst_time)));
}

}  // namespace gaitlab
