// Type of module: any tree of bodies and revolute hinges, with faces, contact elements and a default motor.
#pragma once
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/base.h"
#include "core/model/body_pairs.h"
#include "core/model/frames.h"
#include "core/model/hull.h"
#include "core/model/passive.h"
#include "core/model/play.h"
#include "core/model/supply.h"
#include "core/names.h"

namespace gaitlab {

/// Piece of the outline of a body, for drawing, m, body frame: a box (full sizes), a cylinder, a half cylinder, a sphere, or
/// the convex hull of points. The axis of a cylinder is y of its frame; a half cylinder bulges towards +x. The origin of a hull
/// is the mean of its corners.
struct Shape {
  enum class Kind { box, cylinder, half_cylinder, sphere, hull } kind = Kind::box;
  Pose in_body = {};
  Vec3 size = Vec3::Zero();  ///< box: x y z; cylinders: radius, length, 0; sphere: radius, 0, 0; hull: edges of its box
  std::shared_ptr<const Hull> hull = {};  ///< set for a hull only, in the axes of the shape
};

template <>
struct EnumNames<Shape::Kind> {
  using enum Shape::Kind;
  static constexpr EnumName<Shape::Kind> kTable[] = {
      {box, "box"}, {cylinder, "cylinder"}, {half_cylinder, "half_cylinder"}, {sphere, "sphere"}, {hull, "hull"}};
};

struct BodyType {
  std::string name;
  double mass = 0;              ///< kg; 0 only for a body between two hinges
  Vec3 com = Vec3::Zero();      ///< m, body frame
  Mat3 inertia = Mat3::Zero();  ///< kg m^2, about the COM, body axes
  std::vector<Shape> shapes = {};
  bool bare = false;  ///< true for `shape: []`: the body has no extent, so that checks of overlaps leave it out
  double volume = 0;  ///< m^3, of the union of the shapes, if they determine the inertia; 0 if the inertia is stated
};

inline constexpr double kNoStop = std::numeric_limits<double>::infinity();  ///< value of hi and -lo if a hinge turns freely

/// A hinge. The frame of the child at angle 0 is the hinge frame. A positive angle is a right-hand turn of the child relative
/// to the parent.
struct HingeType {
  std::string name;
  std::size_t parent = 0, child = 0;  ///< indices of bodies
  Pose in_parent = {};
  Vec3 axis = Vec3::UnitY();            ///< unit vector, hinge frame
  double lo = 0, hi = 0;                ///< rad; -kNoStop and kNoStop if the hinge turns freely
  std::optional<Passive> passive = {};  ///< set for `drive: none`; empty if a motor drives the hinge
  Play play = {};                       ///< of the gear of its motor
};

/// Gender of a face. An active face docks on a passive face. A face without gender (none) docks on another face without gender.
enum class Gender { active, passive, none };

template <>
struct EnumNames<Gender> {
  using enum Gender;
  static constexpr EnumName<Gender> kTable[] = {{active, "active"}, {passive, "passive"}, {none, "none"}};
};

/// Rated loads of the connector of a face, N and N m; 0 if not stated. `source` is the origin of the values.
struct Connector {
  double tension = 0, shear = 0, bending = 0, torsion = 0;
  std::string source = {};
};

struct FaceType {
  int id = 0;
  std::size_t body = 0;
  Gender gender = Gender::active;
  Vec3 origin = Vec3::Zero(), normal = Vec3::UnitX(), reference = Vec3::UnitY();  ///< body frame; unit vectors at right angles
  std::string connector = {};                         ///< name, may be ""; faces dock only if the names are equal
  std::array<bool, 4> turns{true, true, true, true};  ///< allowed quarter turns
};

/// A point (radius 0) or sphere fixed to a body.
struct ContactType {
  std::size_t body = 0;
  Vec3 centre = Vec3::Zero();  ///< m, body frame
  double radius = 0;           ///< m
};

/// A type of module. core/robot_files/module_check guarantees that bodies and hinges form one tree and that faces have distinct
/// ids.
struct ModuleType {
  std::string name;
  bool lattice =
      false;  ///< true if bodies with faces fill cells of a cubic lattice; two bodies in one cell at zero angles are an error
  std::vector<BodyType> bodies;
  std::vector<HingeType> hinges;
  std::vector<FaceType> faces;
  std::map<std::string, Connector> connectors = {};  ///< connectors of the faces with known loads, by name
  std::vector<ContactType> feet, all;                ///< feet: used for `on: feet` if on a free body; all: used for `on: all`
  Base base = Base::floating;                        ///< of a scenario that `gaitlab new scenario` writes for the type
  std::vector<BodyPair> may_overlap = {};            ///< bodies that are not compared for collisions
  Battery battery = {};                              ///< of the motors of each module; voltage 0 without one
  std::size_t root = 0;                              ///< body that is not the child of a hinge; its frame is the module frame
};

}  // namespace gaitlab
