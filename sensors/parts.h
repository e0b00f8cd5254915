// Parts of a robot that a sensor measures, by their names.
#pragma once
#include <string>
#include <vector>

#include "core/model/pattern.h"
#include "core/plugin/robot_info.h"

namespace gaitlab::sensors {

/// Indices of the `names` that match one of the names and patterns in `wanted`, in ascending order.
inline std::vector<std::size_t> matching(const std::vector<std::string>& wanted, const std::vector<std::string>& names) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (const std::string& text : wanted) {
      if (!glob(text, names[i])) continue;
      found.push_back(i);
      break;
    }
  }
  return found;
}

inline std::vector<std::string> joint_names_of(const RobotInfo& robot) {
  std::vector<std::string> names;
  for (const JointInfo& joint : robot.joints) names.push_back(joint.name);
  return names;
}

inline std::vector<std::string> module_names_of(const RobotInfo& robot) {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < robot.modules.size(); ++m) names.push_back("m" + std::to_string(m));
  return names;
}

inline std::vector<std::string> body_names_of(const RobotInfo& robot) {
  std::vector<std::string> names;
  for (const BodyInfo& body : robot.bodies) names.push_back(body.name);
  return names;
}

/// Column of a joint's measured value: `joint.3.measured_torque`.
inline std::string joint_column(std::size_t joint, const char* quantity) {
  return "joint." + std::to_string(joint) + "." + quantity;
}

/// True if the list `wanted` contains the word.
inline bool measures(const std::vector<std::string>& wanted, const char* word) {
  for (const std::string& one : wanted) {
    if (one == word) return true;
  }
  return false;
}

}  // namespace gaitlab::sensors
