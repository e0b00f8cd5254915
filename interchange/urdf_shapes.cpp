#include "interchange/urdf_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/settings/wording.h"
#include "interchange/urdf.h"

namespace gaitlab::interchange {

namespace fs = std::filesystem;

namespace {

constexpr int kFoldersAbove = 4;

const std::string& name_of_mesh(const UrdfPart& part) { return static_cast<const urdf::Mesh&>(*part.of).filename; }

/// Name of a mesh file without the scheme of its address.
std::string without_scheme(const std::string& name) {
  for (const std::string scheme : {"package://", "model://", "file://"}) {
    if (name.starts_with(scheme)) return name.substr(scheme.size());
  }
  return name;
}

/// Longest edge of the points' box, m; 0 without points.
double extent(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& point : points) box.extend(point);
  return box.isEmpty() ? 0 : box.sizes().maxCoeff();
}

}  // namespace

Vec3 vec(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose pose_of(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return {Quat(r.w, r.x, r.y, r.z).toRotationMatrix(), vec(pose.position)};
}

bool UrdfPart::is_point() const {
  return of->type == urdf::Geometry::SPHERE && static_cast<const urdf::Sphere&>(*of).radius <= kPointRadius;
}

std::optional<std::string> UrdfShapes::file_of(const std::string& name) const {
  const fs::path path = without_scheme(name);
  if (path.empty()) return {};
  const fs::path inner = path.is_absolute() ? path.filename() : path.lexically_relative(*path.begin());  // without the package
  std::vector<fs::path> places;
  if (!meshes_.empty()) {
    for (const fs::path& one : {path.relative_path(), inner, path.filename()}) places.push_back(meshes_ / one);
  }
  if (path.is_absolute()) places.push_back(path);
  fs::path folder = fs::absolute(urdf_.place().file).lexically_normal().parent_path();
  for (int above = 0; above <= kFoldersAbove; ++above, folder = folder.parent_path()) {
    for (const fs::path& one : {path.relative_path(), inner}) places.push_back(folder / one);
  }
  const auto found = std::ranges::find_if(places, [](const fs::path& one) {
    std::error_code none;
    return fs::is_regular_file(one, none);
  });
  if (found == places.end()) return {};
  return found->lexically_normal().string();
}

bool UrdfShapes::readable(const UrdfPart& part) const {
  if (!part.is_mesh()) return true;
  const std::optional<std::string> file = file_of(name_of_mesh(part));
  return file && is_mesh_file(*file);
}

const MeshHull& UrdfShapes::hull_of(const std::string& file, const Vec3& scale) {
  const std::string key = fmt::format("{} {} {} {}", scale.x(), scale.y(), scale.z(), file);
  if (const auto known = hulls_.find(key); known != hulls_.end()) return known->second;
  std::vector<Vec3> points = mesh_vertices(file);
  for (Vec3& point : points) point = point.cwiseProduct(scale);
  MeshHull& made = hulls_[key] = hull_of_few(points);
  if (has_triangles(file)) made.enclosed = enclosed_volume(points);
  return made;
}

void UrdfShapes::add_mesh(const std::string& link, const Pose& pose, const urdf::Mesh& mesh, std::vector<Shape>& shapes,
                          std::vector<RobotNote>& notes, Problems& problems) {
  const SourceLocation place = urdf_.place("link", link);
  const std::string what = fmt::format("link {} has the mesh {}", in_quotes(link), in_quotes(mesh.filename));
  const std::optional<std::string> file = file_of(mesh.filename);
  if (!file) {
    problems.add(place, fmt::format("{}, which is neither beside the URDF file nor in the {} folders above it{}; expected its "
                                    "folder by --meshes, or box, cylinder or sphere as collision",
                                    what, kFoldersAbove, meshes_.empty() ? "" : " nor in " + in_quotes(meshes_)));
    return;
  }
  constexpr double kLargest = 50;  // m; chosen: millimetres without their scale are beyond
  try {
    const MeshHull& hull = hull_of(*file, vec(mesh.scale));
    if (const double size = extent(hull.points); size > kLargest) {
      problems.add(
          place,
          fmt::format("{}, which is {:.3g} m large; if its numbers are mm, expected scale=\"0.001 0.001 0.001\"", what, size));
      return;
    }
    made_.add({link, place}, what, pose, hull, shapes, notes);
  } catch (const InputError& error) {
    for (const Problem& one : error.problems())
      problems.add(place, fmt::format("{}: {}: {}", what, to_string(one.place), one.text));
  }
}

void UrdfShapes::add(const std::string& link, const Pose& pose, const UrdfPart& part, std::vector<Shape>& shapes,
                     std::vector<RobotNote>& notes, Problems& problems) {
  Shape shape{.in_body = pose};
  if (part.of->type == urdf::Geometry::BOX) {
    shape.size = vec(static_cast<const urdf::Box&>(*part.of).dim);
  } else if (part.of->type == urdf::Geometry::SPHERE) {
    shape.kind = Shape::Kind::sphere;
    shape.size.x() = static_cast<const urdf::Sphere&>(*part.of).radius;
  } else if (part.of->type == urdf::Geometry::CYLINDER) {
    const auto& cylinder = static_cast<const urdf::Cylinder&>(*part.of);
    return add_cylinder_along_z(pose, cylinder.radius, cylinder.length, part.capsule, shapes);
  } else {
    return add_mesh(link, pose, static_cast<const urdf::Mesh&>(*part.of), shapes, notes, problems);
  }
  shapes.push_back(shape);
}

}  // namespace gaitlab::interchange
