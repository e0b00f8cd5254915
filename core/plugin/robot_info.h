// What a plugin may know of the robot it moves. Standard library only.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace gaitlab {

struct JointInfo {
  std::string name;                   ///< `m3/passive`
  std::int64_t module = 0;            ///< its module
  std::int64_t parent = -1;           ///< the next joint towards the base, -1: none
  double lo = 0, hi = 0;              ///< range, rad
  std::array<double, 3> origin = {};  ///< a point of the axis, m, base frame, all angles zero
  std::array<double, 3> axis = {};    ///< unit vector, base frame, all angles zero; positive turn of the farther body
};

struct ModuleInfo {
  std::string type;                       ///< name of the module type
  std::int64_t parent = -1;               ///< the module it is docked to, -1 for module 0
  int parent_face = -1;                   ///< the parent's face it sits on
  std::array<double, 3> normal = {};      ///< outward normal of that face, base frame, all angles zero
  std::array<double, 3> position = {};    ///< module frame, m, base frame, all angles zero
  std::array<double, 9> rotation = {};    ///< module axes in the base frame, row major
  std::vector<std::int64_t> joints = {};  ///< from the reference body outwards
  std::vector<std::int64_t> children = {};
  std::vector<std::array<double, 3>> feet =
      {};  ///< its foot contact points, m, base frame, all angles zero; without children only
};

/// A robot as a tree of modules and joints, with its geometry at zero angles.
struct RobotInfo {
  std::vector<JointInfo> joints;
  std::vector<ModuleInfo> modules;
};

}  // namespace gaitlab
