// Triangles of what is drawn: shapes of bodies, the ground.
#pragma once
#include <cstdint>
#include <vector>

#include "core/laws/heightfield.h"
#include "core/model/module_type.h"

namespace gaitlab::interchange {

/// Triangles, counter-clockwise as seen from outside; three corners each.
using Triangles = std::vector<std::uint32_t>;

/// Vertices with their normals (unit vectors, outwards), and triangles over them. A vertex of a sharp edge is there once for
/// each side of it, so that boxes have flat sides and cylinders round ones. m.
struct Mesh {
  std::vector<Vec3> places, normals;
  Triangles triangles;
};

/// Adds a shape, in the frame in which its pose is given. Round ones are inscribed prisms of 32 sides, spheres 32 by 16: up to
/// 0.5 % of the radius inside the shape (chosen).
void add(Mesh& mesh, const Shape& shape);

/// A rectangle of the world's x and y, m.
struct Area {
  double x_lo = 0, x_hi = 0, y_lo = 0, y_hi = 0;
};

/// A ground as square tiles with an edge of 1, 2 or 5 times a power of ten, at most 40 (and what is left of two) along either
/// side of what is drawn; a corner of four is at the world's x = y = 0. Tiles of both kinds, as a chessboard's, share the
/// vertices.
struct Tiles {
  double edge = 0;  ///< m
  Mesh light;       ///< with all vertices
  Triangles dark;
};

/// The plane z = 0, in whole tiles that cover the area.
Tiles tiles(const Area& area);

/// The surface over its grid and the area. Each cell is cut into 4 by 4 (2 by 2 above 16 000 cells, not at all above 64 000),
/// since it is curved, and where tiles begin; the normals are the field's own.
Tiles tiles(const Heightfield& field, const Area& area);

}  // namespace gaitlab::interchange
