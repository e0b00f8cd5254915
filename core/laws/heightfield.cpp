#include "core/laws/heightfield.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gaitlab {

namespace {

/// Where a coordinate lies on its axis of the grid, and what the four nodes around it weigh.
struct Stencil {
  std::array<std::size_t, 4> node{};
  std::array<double, 4> value{}, slope{};  ///< slope: d(value)/d(t)
};

/// u: in units of the spacing; n nodes.
Stencil stencil(double u, std::size_t n) {
  const double last = static_cast<double>(n - 1);
  const double inside = u > 0 ? std::min(u, last) : 0.0;  // 0, too, where a run has diverged and u is not a number
  const auto cell = std::min(static_cast<std::size_t>(inside), n - 2);
  const double t = inside - static_cast<double>(cell);
  Stencil s;
  s.node = {cell == 0 ? 0 : cell - 1, cell, cell + 1, std::min(cell + 2, n - 1)};
  s.value = {0.5 * t * (-1 + t * (2 - t)), 1 + 0.5 * t * t * (-5 + 3 * t), 0.5 * t * (1 + t * (4 - 3 * t)),
             0.5 * t * t * (t - 1)};
  s.slope = {0.5 * (-1 + t * (4 - 3 * t)), 0.5 * t * (-10 + 9 * t), 0.5 * (1 + t * (8 - 9 * t)), 0.5 * t * (-2 + 3 * t)};
  // A node beyond the border lies on the line through the two before it: v[-1] = 2 v[0] - v[1].
  for (auto* weight : {&s.value, &s.slope}) {
    auto& w = *weight;
    if (cell == 0) {
      w[1] += 2 * w[0];
      w[2] -= w[0];
      w[0] = 0;
    }
    if (cell + 2 == n) {
      w[2] += 2 * w[3];
      w[1] -= w[3];
      w[3] = 0;
    }
  }
  if (!(u >= 0 && u <= last)) s.slope = {};
  return s;
}

}  // namespace

Heightfield::SurfacePoint Heightfield::at(double x, double y) const {
  const Stencil a = stencil((x - origin.x()) / spacing, columns);
  const Stencil b = stencil((y - origin.y()) / spacing, rows());
  double z = 0;
  double dx = 0;
  double dy = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    double row = 0;
    double along = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      const double v = values[b.node[i] * columns + a.node[j]];
      row += a.value[j] * v;
      along += a.slope[j] * v;
    }
    z += b.value[i] * row;
    dx += b.value[i] * along;
    dy += b.slope[i] * row;
  }
  return {origin.z() + z, Vec3(-dx / spacing, -dy / spacing, 1).normalized()};
}

}  // namespace gaitlab
