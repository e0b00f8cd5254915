// Description of the robot for plugins. Standard library only.
#pragma once
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace gaitlab {

struct JointInfo {
  std::string name;                   ///< `m3/passive`
  std::int64_t module = 0;            ///< its module
  std::int64_t parent = -1;           ///< the next joint towards the base, -1: none
  double lo = 0, hi = 0;              ///< range, rad; -infinity and infinity: it turns freely
  std::array<double, 3> origin = {};  ///< a point of the axis, m, base frame, all angles zero
  std::array<double, 3> axis = {};    ///< unit vector, base frame, all angles zero; positive turn of the farther body
  bool driven = true;                 ///< false: no motor; set points and torques for it are not used
  [[nodiscard]] bool turns_freely() const { return hi == std::numeric_limits<double>::infinity(); }
};

/// Throws std::invalid_argument for a set point that only a freely turning hinge can have: for a hinge with a range it is
/// probably in degrees, or a mistake.
inline void check_angle(const JointInfo& joint, const char* what, double angle) {
  constexpr double kLargest = 3.2;  // rad: slightly above half a turn
  if (joint.turns_freely() || (angle >= -kLargest && angle <= kLargest)) return;
  char text[200];
  (void)std::snprintf(text, sizeof text,
                      " is %.6g rad; allowed are -3.2 to 3.2 rad where the hinge has a range; %.6g degrees are %.4g rad", angle,
                      angle, angle * 3.14159265358979323846 / 180);
  throw std::invalid_argument(std::string(what) + " of joint " + joint.name + text);
}

struct ModuleInfo {
  std::string type;                       ///< name of the module type
  std::int64_t parent = -1;               ///< module that it is docked to, -1 for module 0
  int parent_face = -1;                   ///< face of the parent that it is docked to
  std::array<double, 3> normal = {};      ///< outward normal of that face, base frame, all angles zero
  std::array<double, 3> position = {};    ///< module frame, m, base frame, all angles zero
  std::array<double, 9> rotation = {};    ///< module axes in the base frame, row major
  std::vector<std::int64_t> joints = {};  ///< from the reference body outwards
  std::vector<std::int64_t> children = {};
  std::vector<std::array<double, 3>> feet =
      {};  ///< foot contact points, m, base frame, all angles zero; modules without children only
};

/// A robot as a tree of modules and joints, with its geometry at zero angles.
struct RobotInfo {
  std::vector<JointInfo> joints;
  std::vector<ModuleInfo> modules;
};

}  // namespace gaitlab
