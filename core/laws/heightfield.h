// A surface z(x, y) through heights on a square grid.
#pragma once
#include <cstddef>
#include <vector>

#include "core/model/frames.h"

namespace gaitlab {

/// Cubic in each cell (Catmull and Rom 1974, in x and in y): through the given heights, with a continuous normal. Triangles or
/// bilinear cells would turn the normal at every edge, and a foot that slides over one would be kicked. Planes are planes up to
/// the border; beside a step the surface overshoots by up to 7 % of it. Beyond the border the heights there go on outwards.
struct Heightfield {
  Vec3 origin = Vec3::Zero();       ///< of values[0], m, world
  double spacing = 0.1;             ///< m, in x and in y
  std::size_t columns = 0;          ///< along x; at least 2, as there are at least 2 rows, along y
  std::vector<double> values = {};  ///< above the origin, m, row by row

  struct SurfacePoint {
    double z;     ///< m, world
    Vec3 normal;  ///< upwards
  };
  [[nodiscard]] SurfacePoint at(double x, double y) const;
  [[nodiscard]] std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
};

}  // namespace gaitlab
