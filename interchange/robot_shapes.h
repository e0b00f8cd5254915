// Shapes that URDF and MJCF have in common.
#pragma once
#include <string>
#include <vector>

#include "core/model/module_type.h"
#include "interchange/mesh_points.h"
#include "interchange/robot_bodies.h"

namespace gaitlab::interchange {

/// Adds a cylinder whose axis is z of `pose`, with a sphere at each end if it is a capsule.
void add_cylinder_along_z(const Pose& pose, double radius, double length, bool capsule, std::vector<Shape>& shapes);

/// Points of an ellipsoid: a subdivided octahedron on the unit sphere, stretched by the radii, m.
std::vector<Vec3> ellipsoid_points(const Vec3& radii);

/// Hulls in the place of meshes or other round shapes.
class RobotHulls {
 public:
  RobotHulls(const char* one, const char* several) : one_(one), several_(several) {}
  /// Adds the hull at a pose in its body. Adds a note on a flat one, which is left out; `what` names its element and mesh.
  void add(const RobotElement& of, const std::string& what, const Pose& pose, const MeshHull& hull, std::vector<Shape>& shapes,
           std::vector<RobotNote>& notes);
  /// Adds a note on the hulls. `body` is the word of the format.
  void add_note(const char* body, std::vector<RobotNote>& notes) const;

 private:
  const char *one_, *several_;  ///< `mesh`, `meshes`
  std::size_t count_ = 0;
  double gap_ = 0;              ///< largest gap of a hull
  RobotElement widest_ = {};    ///< element of that hull
  std::size_t hollow_ = 0;      ///< number of meshes that fill less than half of their hulls
  double least_fill_ = 0.5;     ///< least of these shares
  RobotElement emptiest_ = {};  ///< element of that mesh
};

}  // namespace gaitlab::interchange
