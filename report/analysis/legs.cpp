#include "report/analysis/legs.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/plugin/robot_info.h"

namespace gaitlab::report {

namespace {

std::string place_on_side(std::size_t rank, std::size_t count) {
  if (rank == 0) return "front";
  if (rank + 1 == count) return "rear";
  if (count == 3) return "middle";
  return fmt::format("{}{}", rank + 1, rank == 1 ? "nd" : rank == 2 ? "rd" : "th");
}

}  // namespace

std::vector<Leg> legs_that_walk(const Scenario& s) {
  if (!s.ground.exists() || s.contact.on == ContactSet::none) return {};
  std::vector<Leg> legs = find_legs(info(*s.robot));
  if (legs.size() < 4) legs.clear();
  return legs;
}

std::vector<std::string> leg_names(const std::vector<Leg>& legs) {
  const auto left = static_cast<std::size_t>(std::count_if(legs.begin(), legs.end(), [](const Leg& leg) { return leg.left; }));
  std::size_t rank_left = 0;
  std::size_t rank_right = 0;
  std::vector<std::string> names;
  for (const Leg& leg : legs) {
    const std::size_t rank = leg.left ? rank_left++ : rank_right++;
    const std::size_t count = leg.left ? left : legs.size() - left;
    names.push_back(fmt::format("m{} {} {}", leg.modules.front(), place_on_side(rank, count), leg.left ? "left" : "right"));
  }
  return names;
}

std::vector<std::string> foot_names(const Scenario& scenario, std::span<const std::size_t> bodies) {
  const Robot& robot = *scenario.robot;
  const std::vector<Leg> legs = legs_that_walk(scenario);
  const std::vector<std::string> of_legs = leg_names(legs);
  std::vector<std::size_t> leg_of(robot.modules.size(), legs.size());  // per module; legs.size() outside the legs
  for (std::size_t i = 0; i < legs.size(); ++i) {
    for (const std::int64_t module : legs[i].modules) leg_of[static_cast<std::size_t>(module)] = i;
  }
  const auto leg = [&](std::size_t body) { return leg_of[robot.bodies[body].module]; };
  std::vector<std::size_t> feet(legs.size() + 1, 0);
  for (const std::size_t body : bodies) ++feet[leg(body)];
  std::vector<std::string> names;
  for (const std::size_t body : bodies) {
    const std::string& own = robot.bodies[body].name;
    const std::size_t i = leg(body);
    names.push_back(i == legs.size() ? own : feet[i] == 1 ? of_legs[i] : fmt::format("{}, {}", of_legs[i], own));
  }
  return names;
}

}  // namespace gaitlab::report
