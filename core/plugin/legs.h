// Search for the legs of an assembled robot. Standard library only.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/plugin/robot_info.h"

namespace gaitlab {

/// A leg: a chain of modules without branches that ends in feet. Its first module is docked sideways (normal within 45 degrees
/// of +-y) to a module of the spine. `hip` and `ankle` are numbers of joints that turn about y. Their signs are 1 if a positive
/// angle is a right-hand turn about +y, else -1.
struct Leg {
  std::vector<std::int64_t> modules;  ///< numbers of the modules, from the spine outwards
  std::int64_t hip = -1, ankle = -1;  ///< first and last joint that turns about y
  double hip_sign = 1, ankle_sign = 1;
  bool left = false;      ///< true on the +y side
  double x = 0;           ///< x of the hip in the base frame, m; a larger x is further to the front
  double length = 0;      ///< distance from hip to ankle along -z at zero angles, m
  double sole_depth = 0;  ///< distance from the ankle down to the lowest foot point, m
  double sole_reach = 0;  ///< largest distance along x from the ankle to a lowest foot point, m
};

namespace detail {

inline bool about_y(const JointInfo& joint) { return std::abs(joint.axis[1]) > 0.9; }

inline void measure(const RobotInfo& robot, Leg& leg) {
  for (const std::int64_t m : leg.modules) {
    for (const std::int64_t j : robot.modules[static_cast<std::size_t>(m)].joints) {
      const JointInfo& joint = robot.joints[static_cast<std::size_t>(j)];
      if (!about_y(joint) || !joint.driven) continue;
      if (leg.hip < 0) {
        leg.hip = j;
        leg.hip_sign = joint.axis[1] > 0 ? 1 : -1;
      }
      leg.ankle = j;
      leg.ankle_sign = joint.axis[1] > 0 ? 1 : -1;
    }
  }
  if (leg.hip < 0 || leg.ankle == leg.hip) return;
  const auto& hip = robot.joints[static_cast<std::size_t>(leg.hip)].origin;
  const auto& ankle = robot.joints[static_cast<std::size_t>(leg.ankle)].origin;
  leg.x = hip[0];
  leg.left = hip[1] > 0;
  leg.length = hip[2] - ankle[2];
  for (const auto& foot : robot.modules[static_cast<std::size_t>(leg.modules.back())].feet) {
    leg.sole_depth = std::max(leg.sole_depth, ankle[2] - foot[2]);
  }
  for (const auto& foot : robot.modules[static_cast<std::size_t>(leg.modules.back())].feet) {
    if (ankle[2] - foot[2] > leg.sole_depth - 1e-6) leg.sole_reach = std::max(leg.sole_reach, std::abs(foot[0] - ankle[0]));
  }
}

/// All modules in the order of their numbers, except that each parent precedes its children.
inline std::vector<std::size_t> parents_first(const RobotInfo& robot) {
  std::vector<std::size_t> order;
  std::vector<bool> listed(robot.modules.size(), false);
  for (std::size_t m = 0; m < robot.modules.size(); ++m) {
    const auto first = static_cast<std::ptrdiff_t>(order.size());
    for (auto at = static_cast<std::int64_t>(m); at >= 0 && !listed[static_cast<std::size_t>(at)];) {
      const auto one = static_cast<std::size_t>(at);
      listed[one] = true;
      order.push_back(one);
      at = robot.modules[one].parent;
    }
    std::reverse(order.begin() + first, order.end());
  }
  return order;
}

/// True if a side dock is on a chain that already belongs to a leg. The dock is then the knee of that leg, not another leg.
inline bool hangs_on_a_leg(const RobotInfo& robot, const std::vector<Leg>& legs, std::size_t module) {
  for (auto at = static_cast<std::int64_t>(module); at >= 0; at = robot.modules[static_cast<std::size_t>(at)].parent) {
    for (const Leg& leg : legs) {
      if (std::find(leg.modules.begin(), leg.modules.end(), at) != leg.modules.end()) return true;
    }
  }
  return false;
}

}  // namespace detail

/// All legs, from front to rear, with left before right. A leg needs a hip and an ankle that turn about y, and feet that are
/// below the ankle. Other side chains are not legs.
inline std::vector<Leg> find_legs(const RobotInfo& robot) {
  std::vector<Leg> legs;
  for (const std::size_t m : detail::parents_first(robot)) {
    const ModuleInfo& module = robot.modules[m];
    if (module.parent < 0 || std::abs(module.normal[1]) < 0.7 || detail::hangs_on_a_leg(robot, legs, m)) continue;
    Leg leg;
    auto at = static_cast<std::int64_t>(m);
    leg.modules.push_back(at);
    while (robot.modules[static_cast<std::size_t>(at)].children.size() == 1) {
      at = robot.modules[static_cast<std::size_t>(at)].children[0];
      leg.modules.push_back(at);
    }
    if (robot.modules[static_cast<std::size_t>(at)].feet.empty()) continue;
    detail::measure(robot, leg);
    if (leg.hip >= 0 && leg.ankle != leg.hip && leg.length > 0 && leg.sole_depth > 0) legs.push_back(leg);
  }
  // The x of a left leg and its right neighbour may differ by a millimetre.
  std::stable_sort(legs.begin(), legs.end(),
                   [](const Leg& a, const Leg& b) { return std::abs(a.x - b.x) > 1e-3 ? a.x > b.x : a.left && !b.left; });
  return legs;
}

}  // namespace gaitlab
