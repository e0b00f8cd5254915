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
#include "report/number_texts.h"

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

MotionCycle cycle(const Scenario& scenario, const RunRecord& r, const Summary& s) {
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

/// A group of which a number is not known is null.
void put(Json& json, const SummaryNumber& number, const std::string& joint, const Json& value) {
  const Json::json_pointer at(number.pointer(joint));
  const Json::json_pointer group = at.parent_pointer();
  json[value.is_null() && !group.empty() ? group : at] = value;
}

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
  const RunData run{scenario, r, s};
  Json json;
  for (const SummaryNumber& number : summary_numbers()) {
    if (number.of_joint == nullptr) {
      put(json, number, "", number.value(run));
      continue;
    }
    json.emplace("per_joint", Json::object());  // without joints, too
    for (std::size_t j = 0; j < r.joints.size(); ++j)
      put(json, number, scenario.robot->joints[j].name, r.joints[j].*number.of_joint);
  }
  return json.dump(2) + "\n";
}

std::string to_text(const Summary& s, const Scenario& scenario, const RunRecord& r) {
  std::string text;
  for (const SummaryNumber* number : placed(&SummaryNumber::line)) {
    const char* title = number->line.title;
    for (const std::string& line : number->line.text({scenario, r, s}))
      text += title == nullptr ? line + "\n" : fmt::format("  {:<13} {}\n", title, line);
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
  return fmt::format("in {} of the control ticks {}", texts::percent(s.stability_share),
                     step_advice(scenario, contacts, r.worst, fmt::format("at t = {:.2f} s", r.worst_time)));
}

}  // namespace gaitlab
