// Vertices of mesh files, and a choice of few with nearly the same convex hull.
#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/model/frames.h"

namespace gaitlab::interchange {

/// Vertices in a file, in its order and unit: STL, binary or text, or OBJ (lines `v x y z`), by the ending of its name. Counts
/// that the file states are compared with its length and do not reserve memory. Throws InputError, with the line of a text, for
/// a file that cannot be read, has another ending, is longer than 200 MB, is shorter than announced, has numbers that are not
/// finite, or has none or more than 4e6 vertices.
std::vector<Vec3> mesh_vertices(const std::string& file);

/// True if the vertices of the file are those of triangles, three each: STL.
bool has_triangles(const std::string& file);

/// True for a file name with the ending of STL or OBJ, in letters of any case.
bool is_mesh_file(const std::string& file);

inline constexpr std::size_t kFewPoints = 32;

/// Few of many points.
struct MeshHull {
  std::vector<Vec3> points;
  double gap = 0;  ///< largest distance by which their hull is inside that of all, as a share of the longest edge of the box
  double enclosed = std::numeric_limits<double>::quiet_NaN();  ///< volume in the mesh's surface; NaN if it is not known
};

/// Volume in a closed surface of triangles, three points each: V = |sum a . (b x c)| / 6. NaN if the surface is open: the sum
/// of its areas, as vectors, exceeds a thousandth of that of their magnitudes. Volumes in surfaces that overlap are counted
/// twice.
double enclosed_volume(std::span<const Vec3> triangles);

/// At most 32 of the points, chosen by support function over 1026 fixed directions (a subdivided octahedron): begun at the
/// farthest point along the first, it adds the farthest point along the direction in which the hull of those chosen falls
/// short most, until it falls short by less than 1 % of the longest edge of the points' box. Every chosen point is one of the
/// given, so that the hull of the result is inside theirs. The result depends on the points' values alone, not on their order
/// (of equally far points, the least in x, then y, then z is taken). Cost: 1026 products per point.
MeshHull hull_of_few(std::span<const Vec3> points);

}  // namespace gaitlab::interchange
