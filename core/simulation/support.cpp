#include "core/simulation/support.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/math/convex_hull.h"

namespace gaitlab {

namespace {

constexpr double kBand = 1e-3;  // m; more than a robot sinks while it settles on its lowest elements

/// True if `com` is in the convex hull of the elements: seen from `com`, no gap between the directions to the vertices is as
/// wide as pi.
bool holds(std::span<const SupportElement> elements, const Vec3& com) {
  std::vector<double> angles;
  for (const SupportElement& s : elements) angles.push_back(math::atan2(s.point.y() - com.y(), s.point.x() - com.x()));
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
  return widest < std::numbers::pi;
}

}  // namespace

std::vector<SupportElement> support_elements(std::vector<SupportElement> elements, const Vec3& com) {
  std::stable_sort(elements.begin(), elements.end(),
                   [](const SupportElement& a, const SupportElement& b) { return a.gap < b.gap; });
  if (elements.empty()) return elements;
  // Least number of elements that hold the robot. Bisection is possible because a further element only divides a gap between
  // directions.
  std::size_t count = 1;
  for (std::size_t end = elements.size(); count < end;) {
    const std::size_t middle = (count + end) / 2;
    if (holds({elements.data(), middle}, com)) {
      end = middle;
    } else {
      count = middle + 1;
    }
  }
  const double highest = (holds({elements.data(), count}, com) ? elements[count - 1].gap : elements.front().gap) + kBand;
  std::erase_if(elements, [&](const SupportElement& s) { return s.gap > highest; });
  return elements;
}

namespace {

/// A point seen from above, m.
struct Above {
  double x, y;
};

/// Squared distance from c to the line segment from a to b, m^2.
double distance_square(Above a, Above b, Above c) {
  const Above along{b.x - a.x, b.y - a.y};
  const double length = along.x * along.x + along.y * along.y;
  const double foot = length > 0 ? ((c.x - a.x) * along.x + (c.y - a.y) * along.y) / length : 0;
  const double at = std::clamp(foot, 0.0, 1.0);
  const double x = a.x + at * along.x - c.x;
  const double y = a.y + at * along.y - c.y;
  return x * x + y * y;
}

}  // namespace

double support_margin(std::span<const Vec3> points, const Vec3& com) {
  if (points.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<Above> seen;
  seen.reserve(points.size());
  for (const Vec3& p : points) seen.push_back({p.x(), p.y()});
  const std::vector<Above> hull = math::convex_hull(std::move(seen));
  const Above c{com.x(), com.y()};
  bool inside = hull.size() > 2;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Above a = hull[i];
    const Above b = hull[(i + 1) % hull.size()];
    nearest = std::min(nearest, distance_square(a, b, c));
    inside = inside && (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;  // c is to the left of the edge
  }
  return inside ? std::sqrt(nearest) : -std::sqrt(nearest);
}

}  // namespace gaitlab
