// Shapes of links from the geometry of a URDF file and its mesh files.
#pragma once
#include <urdf_model/link.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/model/module_type.h"
#include "interchange/mesh_points.h"
#include "interchange/robot_note.h"
#include "interchange/robot_shapes.h"
#include "interchange/urdf_text.h"

namespace gaitlab::interchange {

Vec3 vec(const urdf::Vector3& v);
Pose pose_of(const urdf::Pose& pose);

/// A part of a link's visual or collision.
struct UrdfPart {
  Pose in_link;
  const urdf::Geometry* of;
  bool capsule;  ///< for a cylinder of the model

  [[nodiscard]] bool is_mesh() const { return of->type == urdf::Geometry::MESH; }
  /// True for a point, as our own export writes contact elements without radius.
  [[nodiscard]] bool is_point() const;
};

/// Maker of shapes. A mesh becomes the convex hull of at most 32 of its points. A mesh file is looked up in the folder `meshes`
/// if there is one, then beside the URDF file and in the four folders above it, with and without the name of its package.
class UrdfShapes {
 public:
  UrdfShapes(const UrdfText& urdf, std::string meshes) : urdf_(urdf), meshes_(std::move(meshes)) {}

  /// True if the part is not a mesh, or if its file is there and is STL or OBJ.
  bool readable(const UrdfPart& part) const;
  /// Adds the shapes of a part of a link, at a pose in their body. Adds a problem for a mesh that cannot be read, and a note
  /// on a flat one, which is left out.
  void add(const std::string& link, const Pose& pose, const UrdfPart& part, std::vector<Shape>& shapes,
           std::vector<RobotNote>& notes, Problems& problems);
  [[nodiscard]] const RobotHulls& made_hulls() const { return made_; }

 private:
  /// Path of a mesh file; nothing if there is none.
  [[nodiscard]] std::optional<std::string> file_of(const std::string& name) const;
  [[nodiscard]] const MeshHull& hull_of(const std::string& file, const Vec3& scale);
  void add_mesh(const std::string& link, const Pose& pose, const urdf::Mesh& mesh, std::vector<Shape>& shapes,
                std::vector<RobotNote>& notes, Problems& problems);

  const UrdfText& urdf_;
  std::string meshes_;
  std::map<std::string, MeshHull> hulls_ = {};  ///< by file and scale
  RobotHulls made_{"mesh", "meshes"};
};

}  // namespace gaitlab::interchange
