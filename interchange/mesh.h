// Triangle meshes of the shapes of bodies and of the ground.
#pragma once
#include <cstdint>
#include <vector>

#include "core/laws/heightfield.h"
#include "core/model/module_type.h"

namespace gaitlab::interchange {

/// Vertex indices of triangles, three per triangle, counter-clockwise as seen from outside.
using Triangles = std::vector<std::uint32_t>;

/// Vertices (m) with their outward unit normals, and triangles. A vertex on a sharp edge is repeated for each side, so that
/// boxes look flat and cylinders round.
struct Mesh {
  std::vector<Vec3> places, normals;
  Triangles triangles;
};

/// Adds a shape, in the frame of the shape's pose. A cylinder becomes an inscribed prism of 32 sides, a sphere 32 x 16 faces.
/// The surface is up to 0.5 % of the radius inside the shape (chosen).
void add(Mesh& mesh, const Shape& shape);

/// A rectangle in the world's x and y, m.
struct Area {
  double x_lo = 0, x_hi = 0, y_lo = 0, y_hi = 0;
};

/// A ground of square tiles whose edge is 1, 2 or 5 times a power of ten. Either side of the drawn area has at most 40 whole
/// and two partial tiles. A corner of four tiles is at the world's origin. Light and dark tiles alternate as on a chessboard
/// and use common vertices.
struct Tiles {
  double edge = 0;  ///< m
  Mesh light;       ///< contains all vertices
  Triangles dark;
};

/// Tiles of the plane z = 0 that cover the area completely.
Tiles tiles(const Area& area);

/// Stride in x and y of the heights that are drawn, so that they are at most about 512 x 512.
std::size_t drawn_stride(const Heightfield& field);

/// Tiles of a height field that cover the bounding rectangle of its grid and the area. Because the surface within a cell is
/// curved, each cell is divided into 4 x 4 parts (2 x 2 above 16 000 cells, none above 64 000). Cells are also divided at the
/// edges of tiles. Normals are those of the height field.
Tiles tiles(const Heightfield& field, const Area& area);

}  // namespace gaitlab::interchange
