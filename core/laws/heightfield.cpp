#include "core/laws/heightfield.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gaitlab {

namespace {

constexpr int kPerpendiculars = 3;  // steps to the foot of the perpendicular; they converge fast if the field is flat

/// Interpolation along one axis of the grid: the four nodes around a coordinate, and their weights.
struct Stencil {
  std::array<std::size_t, 4> node{};
  std::array<double, 4> value{}, slope{};  ///< slope: d(value)/d(t)
};

/// Interpolation at u, in units of the spacing, on an axis of n nodes.
Stencil stencil(double u, std::size_t n) {
  const double last = static_cast<double>(n - 1);
  const double inside = u > 0 ? std::min(u, last) : 0.0;  // 0 also for NaN, after a run has diverged
  const auto cell = std::min(static_cast<std::size_t>(inside), n - 2);
  const double t = inside - static_cast<double>(cell);
  Stencil s;
  s.node = {cell == 0 ? 0 : cell - 1, cell, cell + 1, std::min(cell + 2, n - 1)};
  s.value = {0.5 * t * (-1 + t * (2 - t)), 1 + 0.5 * t * t * (-5 + 3 * t), 0.5 * t * (1 + t * (4 - 3 * t)),
             0.5 * t * t * (t - 1)};
  s.slope = {0.5 * (-1 + t * (4 - 3 * t)), 0.5 * t * (-10 + 9 * t), 0.5 * (1 + t * (8 - 9 * t)), 0.5 * t * (-2 + 3 * t)};
  // Heights beyond the border are extrapolated linearly from the two nodes before it: v[-1] = 2 v[0] - v[1].
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

Heights::Heights(std::vector<double> heights) {
  if (heights.empty()) return;
  const auto [low, high] = std::ranges::minmax(heights);
  held_ = std::make_shared<const Held>(Held{std::move(heights), low, high});
}

Heights::Heights(std::initializer_list<double> heights) : Heights(std::vector<double>(heights)) {}

const std::vector<double>& Heights::list() const {
  static const std::vector<double> kNone;
  return held_ == nullptr ? kNone : held_->list;
}

Heightfield::SurfacePoint Heightfield::at(double x, double y) const {
  const Stencil a = stencil((x - origin.x()) / spacing, columns);
  const Stencil b = stencil((y - origin.y()) / spacing, rows());
  const std::vector<double>& heights = values.list();
  double z = 0;
  double dx = 0;
  double dy = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    double row = 0;
    double along = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      const double v = heights[b.node[i] * columns + a.node[j]];
      row += a.value[j] * v;
      along += a.slope[j] * v;
    }
    z += b.value[i] * row;
    dx += b.value[i] * along;
    dy += b.slope[i] * row;
  }
  return {origin.z() + z, Vec3(-dx / spacing, -dy / spacing, 1).normalized()};
}

bool Heightfield::covers(double x, double y) const {
  const double u = (x - origin.x()) / spacing;
  const double v = (y - origin.y()) / spacing;
  const auto within = [](double at, std::size_t count) { return at >= 0 && at <= static_cast<double>(count - 1); };
  return within(u, columns) && within(v, rows());
}

GroundTouch Heightfield::touch(const Vec3& centre, double radius, double friction) const {
  SurfacePoint spot = at(centre.x(), centre.y());
  double distance = (centre.z() - spot.z) * spot.normal.z();
  const bool near = std::abs(distance) < radius + spacing;  // otherwise a rough estimate of the gap is enough
  for (int step = 0; near && step < kPerpendiculars; ++step) {
    const Vec3 foot = centre - distance * spot.normal;
    spot = at(foot.x(), foot.y());
    distance = (centre - Vec3(foot.x(), foot.y(), spot.z)).dot(spot.normal);
  }
  return sphere_touch(radius - distance, spot.normal, friction, centre, radius);
}

double Heightfield::highest() const { return origin.z() + values.highest() + (values.highest() - values.lowest()); }

}  // namespace gaitlab
