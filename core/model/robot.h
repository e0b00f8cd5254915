// Assembled robot, independent of engines: docked bodies fused into links, and every body with its name and pose.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/model/base.h"
#include "core/model/module_type.h"
#include "core/names.h"
#include "core/plugin/robot_info.h"

namespace gaitlab {

/// Bodies that move as one. The link frame is the frame of the joint that moves the link; for link 0 it is the base frame. A
/// parent comes before its children.
struct Link {
  int parent = -1;              ///< link towards the base, -1 for link 0
  int joint = -1;               ///< joint that moves the link, -1 for link 0
  Pose in_parent = {};          ///< link frame in the frame of the parent link, at joint angle 0
  Vec3 axis = Vec3::UnitY();    ///< joint axis, link frame, unit vector
  double mass = 0;              ///< kg
  Vec3 com = Vec3::Zero();      ///< m, link frame
  Mat3 inertia = Mat3::Zero();  ///< kg m^2, about the COM, link axes
};

struct Joint {
  std::string name;  ///< for example `m3/passive`
  std::size_t module = 0;
  std::size_t link = 0;   ///< link that the joint moves
  double lo = 0, hi = 0;  ///< rad or +-kNoStop; positive: right-hand turn of the outer body relative to the inner body
  std::optional<Passive> passive = {};  ///< set if the joint has no motor
  Play play = {};                       ///< of the gear of its motor
  [[nodiscard]] bool driven() const { return !passive; }
  [[nodiscard]] bool turns_freely() const { return hi == kNoStop; }
};

struct Body {
  std::string name;  ///< for example `m3/link`
  std::size_t module = 0;
  std::size_t type = 0;  ///< index in the bodies of the module type
  std::size_t link = 0;
  Pose in_link = {};
  bool free = false;            ///< true at the end of the hinge chain of a module; feet are on such bodies
  double mass = 0;              ///< kg
  Vec3 com = Vec3::Zero();      ///< m, body frame
  Mat3 inertia = Mat3::Zero();  ///< kg m^2, about the COM, body axes
};

/// A point (radius 0) or sphere that may touch the ground.
struct ContactElement {
  std::string name;  ///< `m3/passive/p0` for a point, `m3/passive/s0` for a sphere
  std::size_t body = 0;
  std::size_t link = 0;
  Vec3 centre = Vec3::Zero();  ///< m, link frame
  double radius = 0;           ///< m
  double friction = 1;         ///< factor on the ground's coefficient of friction
};

struct Dock {
  int child_face = 0, child_module = 0, parent_face = 0, parent_module = 0, orientation = 0;
  SourceLocation place = {};
};

/// Differences of a real module from its type.
struct ModuleBuild {
  double mass = 1;                 ///< factor on the masses of its bodies, and thereby on their inertias
  double inertia = 1;              ///< further factor on the inertias
  double friction = 1;             ///< factor on the coefficient of friction under its contact elements
  Vec3 dock_angle = Vec3::Zero();  ///< rotation vector of the module at its dock to the parent: normal of the parent's face,
                                   ///< its reference, and normal x reference; rad
  bool operator==(const ModuleBuild&) const = default;
};

struct Module {
  std::size_t type = 0;  ///< index in Robot::types
  int parent = -1;       ///< module to which this module is docked, -1 for module 0
  Dock dock = {};        ///< row of the build file; only if parent >= 0
  std::size_t first_body = 0;
  std::vector<std::size_t> joints = {};  ///< breadth-first from the reference body
  std::size_t reference = 0;             ///< docked body (index in Robot::bodies); for module 0 the root of the type
  ModuleBuild build = {};
};

/// A leg that the scenario states.
struct StatedLeg {
  std::string name;
  std::size_t body = 0;  ///< its last body
};

struct Robot {
  std::vector<ModuleType> types;
  std::vector<Module> modules;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Body> bodies;
  double mass = 0;                                         ///< kg
  std::optional<std::vector<StatedLeg>> stated_legs = {};  ///< without a value, legs_of() finds them

  [[nodiscard]] int dof(Base base) const {
    return static_cast<int>(joints.size()) + (base == Base::floating ? 6 : base == Base::planar ? 3 : 0);
  }
};

enum class ContactSet { none, feet, all };

template <>
struct EnumNames<ContactSet> {
  using enum ContactSet;
  static constexpr EnumName<ContactSet> kTable[] = {{none, "none"}, {feet, "feet"}, {all, "all"}};
};

/// Joints whose gears have play, in ascending order.
std::vector<std::size_t> joints_with_play(const Robot& robot);

/// Builds the robot from `type_of_module` (index into types, one per module) and the docks. Throws one InputError with all
/// problems, each at its row. Problems of a dock are a wrong gender, connectors that differ, a face used twice, an unknown
/// module or face, and an orientation that does not exist or that a face does not allow. Problems of the tree are two parents,
/// a loop, a gap in the numbering, and, in lattice types, two blocks in one cell at zero angles.
Robot assemble(std::vector<ModuleType> types, const std::vector<std::size_t>& type_of_module, const std::vector<Dock>& docks);

/// The robot `drawn` with differences of its modules, one entry per module. Links, joints, bodies and names are the same. Cells
/// of lattices are not checked again.
Robot as_built(const Robot& drawn, std::span<const ModuleBuild> modules);

/// Contact elements of the set `on`, sorted by body, then in file order. The set `feet` contains the feet of the free body of
/// every module without children.
std::vector<ContactElement> contact_elements(const Robot& robot, ContactSet on);
/// Contact elements of the set `on`, as one list per body.
std::vector<std::vector<ContactElement>> contact_elements_by_body(const Robot& robot, ContactSet on);

/// Description of the robot for plugins.
RobotInfo info(const Robot& robot);

}  // namespace gaitlab
