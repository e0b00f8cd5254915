#include "report/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/scenario/wording.h"
#include "core/simulation/start.h"
#include "core/simulation/step_advice.h"
#include "report/build_id.h"
#include "report/fall.h"
#include "report/number_texts.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

/// Turn about world z from one tick to the next: the twist of the rotation between them. Defined however far the base is
/// pitched.
double twist(const Quat& before, const Quat& now) {
  const Quat turn = now * before.conjugate();
  return std::remainder(2 * math::atan2(turn.z(), turn.w()), 2 * std::numbers::pi);
}

void travel(const Recording& r, Summary& s) {
  const Series x = r.series("com.x");
  const Series y = r.series("com.y");
  if (x.empty() || y.empty()) return;
  s.displacement_x = x.back() - x.front();
  s.displacement_y = y.back() - y.front();
  s.distance = std::hypot(s.displacement_x, s.displacement_y);
  s.speed = s.simulated > 0 ? s.distance / s.simulated : 0;
  for (std::size_t k = 1; k < x.size(); ++k) s.path_length += std::hypot(x[k] - x[k - 1], y[k] - y[k - 1]);
  const std::array turn{r.series("base.qw"), r.series("base.qx"), r.series("base.qy"), r.series("base.qz")};
  const auto at = [&](std::size_t k) { return Quat(turn[0][k], turn[1][k], turn[2][k], turn[3][k]); };
  for (std::size_t k = 1; k < turn[0].size(); ++k) s.heading_change += twist(at(k - 1), at(k));
}

void transport(const Scenario& scenario, const Recording& r, Summary& s) {
  double electrical = 0;
  double mechanical = 0;
  for (const JointStatistics& joint : r.joints) {
    electrical += joint.electrical;
    mechanical += joint.shaft_positive;
  }
  const double work = scenario.robot->mass * scenario.physics.gravity.norm() * s.distance;
  if (!(work > 0)) return;
  s.cost_electrical = electrical / work;
  s.cost_mechanical = mechanical / work;
}

MotionCycle cycle(const Scenario& scenario, const Recording& r, const Summary& s) {
  const std::size_t n = scenario.robot->joints.size();
  if (n == 0) return {};
  // The last row may lie off the grid of trace periods.
  const auto ticks = static_cast<std::size_t>(std::floor(s.simulated / scenario.trace.period + 1e-9)) + 1;
  std::vector<Series> columns;
  for (const char* quantity : {"angle", "setpoint"}) {
    for (std::size_t j = 0; j < n; ++j) {
      if (const Series one = r.joint(j, quantity); !one.empty()) columns.push_back(one);
    }
  }
  std::vector<double> all;
  all.reserve(r.rows() * columns.size());
  for (std::size_t k = 0; k < std::min(ticks, r.rows()); ++k) {
    for (const Series& column : columns) all.push_back(column[k]);
  }
  return find_limit_cycle(all, columns.size(), scenario.trace.period);
}

/// A group of which a number is not known is null.
void put(Json& json, const SummaryNumber& number, const std::string& joint, const Json& value) {
  const Json::json_pointer at(number.pointer(joint));
  const Json::json_pointer group = at.parent_pointer();
  json[value.is_null() && !group.empty() ? group : at] = value;
}

}  // namespace

Summary travelled(const Recording& r) {
  Summary s;
  s.simulated = r.simulated;
  travel(r, s);
  return s;
}

Summary summarise(const Scenario& scenario, const Recording& r, double wall_time) {
  Summary s;
  s.wall_time = wall_time;
  s.build = build_id();
  s.outcome = r.outcome;
  s.simulated = r.simulated;
  travel(r, s);
  transport(scenario, r, s);
  s.limit_cycle = cycle(scenario, r, s);
  s.stability_max = scenario.physics.step * r.worst.rate;
  s.stability_share =
      r.control_ticks > 0 ? static_cast<double>(r.control_ticks_above_1) / static_cast<double>(r.control_ticks) : 0;
  const auto contacts = contact_elements(*scenario.robot, scenario.contact.on);
  if (r.worst.rate > 0) s.stability_source = source_of(r.worst, *scenario.robot, contacts);
  s.judged = judge(r, s.limit_cycle);
  s.posture = posture(scenario, r, s.judged);
  return s;
}

Json numbers_json(const RunData& run) {
  Json json;
  for (const SummaryNumber& number : summary_numbers()) {
    if (number.of_joint == nullptr) {
      put(json, number, "", number.value(run));
      continue;
    }
    json.emplace("per_joint", Json::object());  // without joints, too
    for (std::size_t j = 0; j < run.record.joints.size(); ++j)
      put(json, number, run.scenario.robot->joints[j].name, number.of_joint(run, j));
  }
  return json;
}

std::string to_json(const Summary& s, const Scenario& scenario, const Recording& r) {
  return numbers_json({scenario, r, s}).dump(2) + "\n";
}

std::string to_text(const Summary& s, const Scenario& scenario, const Recording& r, bool verbose) {
  std::string text;
  for (const SummaryNumber* number : placed(&SummaryNumber::line)) {
    if (number->line.verbose && !verbose) continue;
    const char* title = number->line.title;
    for (const std::string& line : number->line.text({scenario, r, s})) {
      text += title == nullptr ? line + "\n" : fmt::format("  {:<13} {}\n", title, line);
      if (title != nullptr) title = "";
    }
  }
  return text;
}

std::string joint_table(const Summary& s, const Scenario& scenario) {
  if (!has_motors(scenario) || s.judged.joints.empty()) return "  no table of joints: nothing drives them\n";
  std::size_t width = 5;
  for (const Joint& joint : scenario.robot->joints) width = std::max(width, joint.name.size());
  std::string text = fmt::format("  {:<{}}  {:^15}  {:^24}  {}\n  {:<{}} {:>8} {:>8} {:>9} {:>8} {:>6}  {:>8} {:>8}\n", "",
                                 width, "at a limit", "torque, N m", " tracking error", "joint", width, "voltage", "current",
                                 "peak", "at s", "RMS", "rad", "at s");
  const auto share = [](double limited) {
    return limited > 0 && limited < 0.0005 ? "< 0.1 %" : fmt::format("{:.1f} %", 100 * limited);
  };
  for (const std::size_t j : s.judged.order) {
    const JudgedJoint& joint = s.judged.joints[j];
    if (!scenario.robot->joints[j].driven()) continue;
    text +=
        fmt::format("  {:<{}} {:>8} {:>8} {:>8.3f}{} {:>8.2f} {:>6.3f}  {:>8.3f} {:>8.2f}\n", scenario.robot->joints[j].name,
                    width, share(joint.voltage_limited), share(joint.current_limited), joint.torque_peak,
                    joint.peak_limit == MotorLimit::none      ? ' '
                    : joint.peak_limit == MotorLimit::voltage ? 'u'
                                                              : 'i',
                    joint.torque_peak_time, joint.torque_rms, joint.error_peak, joint.error_peak_time);
  }
  const bool marked =
      std::ranges::any_of(s.judged.joints, [](const JudgedJoint& j) { return j.peak_limit != MotorLimit::none; });
  return text + "  the most loaded first: by time at a limit, then RMS, then peak\n" +
         (marked ? "  u, i: the peak is at the limit of voltage, of current\n" : "");
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

std::string fall_warning(const Scenario& scenario, const Recording& r) {
  const std::optional<Fall> found = fall(scenario, r);
  if (!found || !(found->share() < scenario.limits.height)) return "";
  return fmt::format("it fell: from t = {:.2f} s on, the centre of mass comes down to {:.3f} m, from {:.3f} m at the start",
                     found->fallen_time, found->lowest, found->start);
}

std::string stability_warning(const Summary& s, const Scenario& scenario, const Recording& r) {
  if (!(s.stability_share > 0.01)) return "";
  const auto contacts = contact_elements(*scenario.robot, scenario.contact.on);
  return fmt::format("in {} of the control ticks {}", texts::percent(s.stability_share),
                     step_advice(scenario, contacts, r.worst, fmt::format("at t = {:.2f} s", r.worst_time)));
}

}  // namespace gaitlab::report
