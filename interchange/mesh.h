// Triangle meshes of shapes of bodies and of the ground.
#pragma once
#include <cstdint>
#include <vector>

#include "core/laws/heightfield.h"
#include "core/model/module_type.h"

namespace gaitlab::interchange {

/// Triangles, counter-clockwise as seen from outside; three corners each.
using Triangles = std::vector<std::uint32_t>;

/// Vertices with their normals (unit vectors, outwards), and triangles over them. A vertex of a sharp edge is repeated for each
/// side, so that boxes have flat sides and cylinders round ones. m.
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

/// A ground as square tiles with an edge of 1, 2 or 5 times a power of ten, at most 40 (and two partial ones) along either side
/// of the drawn area; a corner of four tiles is at the world's x = y = 0. Tiles of both kinds alternate as on a chessboard and
/// share the vertices.
struct Tiles {
  double edge = 0;  ///< m
  Mesh light;       ///< with all vertices
  Triangles dark;
};

/// The plane z = 0, in whole tiles that cover the area.
Tiles tiles(const Area& area);

/// Stride of the heights that are drawn in x and in y, so that there are at most about 512 x 512.
std::size_t drawn_stride(const Heightfield& field);

/// The surface over its grid and the area. Each cell is cut into 4 by 4 (2 by 2 above 16 000 cells, not at all above 64 000),
/// because it is curved, and at the edges of tiles; the normals are those of the field.
Tiles tiles(const Heightfield& field, const Area& area);

}  // namespace gaitlab::interchange
