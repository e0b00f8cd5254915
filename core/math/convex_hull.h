// Convex hull of points in a plane.
#pragma once
#include <algorithm>
#include <cstddef>
#include <tuple>
#include <vector>

namespace gaitlab::math {

/// Convex hull, counter-clockwise, without points on its edges. The hull of points on one line is the two ends of the line. P
/// has members x and y. (Andrew's monotone chain, Inf. Proc. Letters 9, 1979: the lower hull from left to right, then the upper
/// hull from right to left.)
template <class P>
std::vector<P> convex_hull(std::vector<P> points) {
  const auto cross = [](P o, P a, P b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); };
  std::sort(points.begin(), points.end(), [](P a, P b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  if (points.size() < 3) return points;
  std::vector<P> hull;
  const auto add = [&](P p, std::size_t fixed) {
    while (hull.size() >= fixed + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
    hull.push_back(p);
  };
  for (const P& point : points) add(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

}  // namespace gaitlab::math
