// Robot of an MJCF text, compiled by libmujoco: bodies, joints, geoms and actuators as plain values.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/model/frames.h"

namespace gaitlab::interchange {

struct MjcfJoint {
  enum class Type { free, ball, slide, hinge } type;
  std::string name;
  Vec3 pos, axis;        ///< m, and unit vector, body frame
  bool limited = false;  ///< true if lo and hi are a range
  double lo = 0, hi = 0;
  double at_start = 0, rest = 0;  ///< position of the pose as written, and that without torque of the spring
  double armature = 0, damping = 0, friction = 0, stiffness = 0;
  double torque_limit = 0;  ///< N m, of the sum of its actuators; 0 if the file states no limit
};

struct MjcfGeom {
  enum class Type { plane, heights, sphere, capsule, ellipsoid, cylinder, box, mesh } type;
  Pose in_body;
  Vec3 size;  ///< m, half sizes, as in MJCF
  int contype = 0, conaffinity = 0;
  std::string name = {};
  std::size_t mesh = 0;             ///< number of a mesh
  std::vector<Vec3> vertices = {};  ///< of a mesh, frame of the geom
};

struct MjcfBody {
  std::string name;
  std::size_t parent = 0;
  Pose in_parent;
  double mass = 0;
  Vec3 com;      ///< m, body frame
  Mat3 inertia;  ///< kg m^2, about the COM, body axes
  std::vector<MjcfJoint> joints = {};
  std::vector<MjcfGeom> geoms = {};
};

struct MjcfActuator {
  std::size_t body = 0, joint = 0;  ///< its joint: number in the body
  double gear = 1;
  std::optional<double> force;  ///< N m, largest force before the gear; nothing if it has no limit
  bool position = false;        ///< true if its force depends on the angle
};

struct MjcfRobot {
  std::vector<MjcfBody> bodies;         ///< body 0 is the world; each is after its parent, in the order of the file
  std::vector<MjcfActuator> actuators;  ///< of joints
  std::vector<std::pair<std::size_t, std::size_t>> excluded;  ///< pairs of bodies
};

/// An error of libmujoco.
struct MjcfError {
  std::string text;
  std::string element = {};  ///< name of its element
  int line = 0;              ///< in the text; 0 if it has none
};

/// The model, or the error. libmujoco is loaded at the first call; throws InputError at `file` if it is not installed.
struct CompiledMjcf {
  MjcfRobot model;
  std::optional<MjcfError> error;
  std::vector<std::string> warnings = {};
};
CompiledMjcf compile_mjcf(const std::string& text, const std::string& file);

}  // namespace gaitlab::interchange
