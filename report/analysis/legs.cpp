#include "report/analysis/legs.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/scenario/sensor_section.h"

namespace gaitlab::report {

std::vector<Leg> legs_that_walk(const Scenario& scenario) {
  const bool stands = scenario.base != Base::fixed && scenario.ground.exists() && scenario.contact.on != ContactSet::none;
  if (!stands) return {};
  return plugin_info(scenario).legs;
}

std::string leg_name(const Leg& leg) {
  std::string text = leg.name;
  std::ranges::replace(text, '_', ' ');
  return text;
}

std::vector<std::size_t> own_modules(const RobotInfo& robot, const Leg& leg) {
  std::vector<std::size_t> own;
  for (std::size_t m = 0; m < robot.modules.size(); ++m) {
    const std::vector<std::int64_t>& joints = robot.modules[m].joints;
    const auto in_leg = [&](std::int64_t joint) { return std::ranges::find(leg.joints, joint) != leg.joints.end(); };
    if (!joints.empty() && std::ranges::all_of(joints, in_leg)) own.push_back(m);
  }
  return own;
}

std::vector<std::string> foot_names(const Scenario& scenario, std::span<const std::size_t> bodies) {
  const std::vector<Leg> legs = legs_that_walk(scenario);
  const auto leg_of = [&](std::size_t body) {
    return std::ranges::find_if(legs, [&](const Leg& leg) {
      return std::ranges::find(leg.bodies, static_cast<std::int64_t>(body)) != leg.bodies.end();
    });
  };
  std::vector<std::string> names;
  for (const std::size_t body : bodies) {
    const std::string& own = scenario.robot->bodies[body].name;
    const auto leg = leg_of(body);
    if (leg == legs.end()) {
      names.push_back(own);
      continue;
    }
    const auto feet = std::ranges::count_if(bodies, [&](std::size_t other) { return leg_of(other) == leg; });
    names.push_back(feet == 1 ? leg_name(*leg) : fmt::format("{}, {}", leg_name(*leg), own));
  }
  return names;
}

}  // namespace gaitlab::report
