#include "core/model/hull.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "core/math/convex_hull.h"

namespace gaitlab {

namespace {

// Distances that count as 0, as shares of the points' extent.
constexpr double kOnPlane = 1e-9;  // from a plane or an edge
constexpr double kOnLine = 1e-6;   // of a point from the line through two others: rounding turns their plane by 1e-10 at most

/// The plane through three points, with all points on its inner side; nothing if there are points on both sides, or if the
/// three are on a line.
std::optional<Hull::Face> supporting_plane(const std::vector<Vec3>& points, const std::array<std::size_t, 3>& of,
                                           double extent) {
  const double rounding = kOnPlane * extent;
  const Vec3& origin = points[of[0]];
  const Vec3 u = points[of[1]] - origin;
  const Vec3 v = points[of[2]] - origin;
  const Vec3 across = u.cross(v);
  const double area = across.norm();
  if (!(area > kOnLine * extent * std::max({u.norm(), v.norm(), (v - u).norm()}))) return {};
  Vec3 normal = across / area;
  double low = 0;
  double high = 0;
  for (const Vec3& point : points) {
    const double out = normal.dot(point - origin);
    low = std::min(low, out);
    high = std::max(high, out);
  }
  if (low < -rounding && high > rounding) return {};
  if (high > rounding) normal = -normal;
  return Hull::Face{normal, normal.dot(origin), {}};
}

/// A corner in the axes of a face.
struct Flat {
  double x, y;
  std::size_t index;
};

/// Removes corners that are on the line through their neighbours.
void drop_straight_corners(std::vector<std::size_t>& around, const std::vector<Vec3>& points, double rounding) {
  for (std::size_t k = 0; k < around.size() && around.size() > 3;) {
    const Vec3& before = points[around[(k + around.size() - 1) % around.size()]];
    const Vec3 way = points[around[(k + 1) % around.size()]] - before;
    if ((points[around[k]] - before).cross(way).norm() > rounding * way.norm()) {
      ++k;
    } else {
      around.erase(around.begin() + static_cast<std::ptrdiff_t>(k));
      k = 0;
    }
  }
}

/// Sets the corners of a face to the corners of the outline of the points `on` its plane.
void set_corners(Hull::Face& face, const std::vector<Vec3>& points, const std::vector<std::size_t>& on, double rounding) {
  const Vec3 u = face.normal.unitOrthogonal();
  const Vec3 v = face.normal.cross(u);
  std::vector<Flat> flat;
  flat.reserve(on.size());
  for (const std::size_t p : on) flat.push_back({u.dot(points[p]), v.dot(points[p]), p});
  for (const Flat& corner : math::convex_hull(std::move(flat))) face.corners.push_back(corner.index);
  drop_straight_corners(face.corners, points, rounding);
}

bool contains(const std::vector<std::size_t>& all, const std::array<std::size_t, 3>& some) {
  return std::ranges::all_of(some, [&](std::size_t one) { return std::ranges::binary_search(all, one); });
}

/// The points, each place once.
std::vector<Vec3> distinct(std::span<const Vec3> points, double rounding) {
  std::vector<Vec3> all;
  for (const Vec3& point : points) {
    if (std::ranges::none_of(all, [&](const Vec3& other) { return (other - point).norm() <= rounding; })) all.push_back(point);
  }
  return all;
}

/// Removes the points that are not corners of a face.
void drop_inner_points(Hull& hull) {
  std::vector<std::size_t> number(hull.corners.size(), hull.corners.size());
  std::vector<Vec3> kept;
  for (Hull::Face& face : hull.faces) {
    for (std::size_t& corner : face.corners) {
      if (number[corner] == hull.corners.size()) {
        number[corner] = kept.size();
        kept.push_back(hull.corners[corner]);
      }
      corner = number[corner];
    }
  }
  hull.corners = std::move(kept);
}

/// Distance of a point from a segment.
double from_segment(const Vec3& a, const Vec3& b, const Vec3& point) {
  const Vec3 way = b - a;
  return (point - a - std::clamp((point - a).dot(way) / way.squaredNorm(), 0.0, 1.0) * way).norm();
}

}  // namespace

const Vec3& Hull::farthest(const Vec3& d) const {
  return *std::ranges::max_element(corners, {}, [&](const Vec3& corner) { return d.dot(corner); });
}

double Hull::distance(const Vec3& point) const {
  double outmost = -std::numeric_limits<double>::infinity();
  double nearest = -outmost;
  for (const Face& face : faces) {
    const double out = face.normal.dot(point) - face.offset;
    outmost = std::max(outmost, out);
    if (out <= 0) continue;
    bool above = true;  // the point projects into the face
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const Vec3& a = corners[face.corners[k]];
      const Vec3& b = corners[face.corners[(k + 1) % face.corners.size()]];
      above = above && (b - a).cross(point - a).dot(face.normal) >= 0;
      nearest = std::min(nearest, from_segment(a, b, point));
    }
    if (above) nearest = std::min(nearest, out);
  }
  return outmost <= 0 ? outmost : nearest;
}

Hull convex_hull(std::span<const Vec3> points) {
  Hull hull;
  if (points.empty()) return hull;
  Vec3 low = points.front();
  Vec3 high = low;
  for (const Vec3& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double extent = (high - low).norm();
  const double rounding = kOnPlane * extent;
  hull.corners = distinct(points, rounding);
  const std::vector<Vec3>& p = hull.corners;
  std::vector<std::vector<std::size_t>> on_faces;  // points on the plane of each face
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      for (std::size_t k = j + 1; k < p.size(); ++k) {
        const std::array three{i, j, k};
        if (std::ranges::any_of(on_faces, [&](const auto& on) { return contains(on, three); })) continue;
        std::optional<Hull::Face> face = supporting_plane(p, three, extent);
        if (!face) continue;
        std::vector<std::size_t> on;
        for (std::size_t n = 0; n < p.size(); ++n) {
          if (face->normal.dot(p[n]) - face->offset >= -rounding) on.push_back(n);
        }
        if (on.size() == p.size()) return {};
        set_corners(*face, p, on, rounding);
        hull.faces.push_back(std::move(*face));
        on_faces.push_back(std::move(on));
      }
    }
  }
  if (hull.faces.size() < 4) return {};
  drop_inner_points(hull);
  return hull;
}

}  // namespace gaitlab
