#include "report/verdict/numbers/summary_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/settings/wording.h"
#include "core/simulation/start.h"
#include "report/analysis/collisions.h"
#include "report/verdict/numbers/number_texts.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

/// Sets a number in the JSON object. If the number is not known, its group becomes null.
void put(Json& json, const SummaryNumber& number, const std::string& joint, const Json& value) {
  const Json::json_pointer at(number.pointer(joint));
  const Json::json_pointer group = at.parent_pointer();
  json[value.is_null() && !group.empty() ? group : at] = value;
}

}  // namespace

Json numbers_json(const RunData& run) {
  Json json;
  std::vector<Json> joints(run.record.joints.size(), Json::object({{"per_joint", Json::object()}}));
  for (const SummaryNumber& number : summary_numbers()) {
    if (number.of_joint == nullptr) {
      const Json value = number.value(run);
      if (!value.is_null() || !number.if_known) put(json, number, "", value);
      continue;
    }
    json.emplace("per_joint", Json::object());  // exists also in a robot without joints
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const double value = number.of_joint(run, j);
      if (!std::isnan(value) || !number.if_known) put(joints[j], number, run.scenario.robot->joints[j].name, value);
    }
  }
  // Appended to the group directly, because a search by path would compare all joint names for each number.
  auto& all = json["per_joint"].get_ref<Json::object_t&>();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    auto& [name, numbers] = *joints[j]["per_joint"].get_ref<Json::object_t&>().begin();
    all.Container::emplace_back(name, std::move(numbers));
  }
  return json;
}

std::string to_json(const Summary& s, const Scenario& scenario, const Recording& r) {
  return numbers_json({scenario, r, s}).dump(2) + "\n";
}

std::string to_text(const Summary& s, const Scenario& scenario, const Recording& r) {
  std::string text;
  for (const SummaryNumber* number : placed(&SummaryNumber::line)) {
    const char* title = number->line.title;
    for (const std::string& line : number->line.text({scenario, r, s})) {
      text += title == nullptr ? line + "\n" : fmt::format("  {:<13} {}\n", title, line);
      if (title != nullptr) title = "";
    }
  }
  return text;
}

std::string joint_table(const Summary& s, const Scenario& scenario) {
  if (!has_motors(scenario) || s.judged.joints.empty()) return "  no joint table: no joint has a motor\n";
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
  return text + "  order: the most loaded joint first, by time at a limit, then RMS, then peak\n" +
         (marked ? "  u, i: the peak is at the voltage limit (u) or the current limit (i)\n" : "");
}

std::string start_warning(const Scenario& scenario) {
  constexpr double kSunk = 1e-3;  // m
  const RobotState start = start_state(scenario);
  const double depth = depth_in_ground(scenario, start);
  if (depth <= kSunk) return "";
  const std::string deep = fmt::format("the robot starts {:.3g} m deep in the ground: ", depth);
  if (!scenario.on_ground) {
    return deep + fmt::format(
                      "on_ground is off (a position of three numbers turns it off) and the base frame starts at z = {} m; "
                      "position: [{}, {}] lowers the robot onto the ground there",
                      number_text(start.position.z()), number_text(start.position.x()), number_text(start.position.y()));
  }
  if (scenario.contact.on == ContactSet::all)
    return deep + "its shapes reach below their contact elements, of which a cylinder has 8 on each rim; turn or move it";
  return deep + fmt::format("only the elements of contact.on: {} touch it; is it upside down?",
                            scenario.contact.on == ContactSet::feet ? "feet" : "none");
}

}  // namespace gaitlab::report
