#include "core/simulation/support.h"

#include <algorithm>
#include <numbers>
#include <span>

namespace gaitlab {

namespace {

constexpr double kBand = 1e-3;  // m: a robot that settles on its lowest elements sinks by less than this

/// A point is inside a convex hull if no gap between the directions to its vertices, seen from the point, is as wide as pi.
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
  std::size_t count = std::min<std::size_t>(1, elements.size());
  while (count < elements.size() && !holds({elements.data(), count}, com)) ++count;
  if (count == 0) return elements;
  const double highest = (holds({elements.data(), count}, com) ? elements[count - 1].gap : elements.front().gap) + kBand;
  std::erase_if(elements, [&](const SupportElement& s) { return s.gap > highest; });
  return elements;
}

}  // namespace gaitlab
