#include "core/model/solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/model/hull_shape.h"

namespace gaitlab {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kTouching = 1e-9;  // overlap of touching shapes by rounding, as a share of their size
constexpr std::size_t kBars = 256;  // bars per axis, shared by the intervals between the ends of shapes
constexpr int kIterations = 3000;   // for a distance between convex sets; between two edges, the search converges slowly
constexpr double kExactly = 0.01;   // relative accuracy of that distance

/// Point of the outline of a circle (radius r) in direction (x, z); 0 for a direction of length 0.
std::pair<double, double> on_circle(double r, double x, double z) {
  const double length = std::sqrt(x * x + z * z);
  return length > 0 ? std::pair(r * x / length, r * z / length) : std::pair(0.0, 0.0);
}

/// Farthest point of a shape in the axes of the shape.
Vec3 farthest_in_shape(const Shape& shape, const Vec3& d) {
  const Vec3& size = shape.size;
  if (shape.kind == Shape::Kind::hull) return shape.hull->farthest(d);
  if (shape.kind == Shape::Kind::sphere) return size.x() * d.normalized();
  if (shape.kind == Shape::Kind::box) {
    return {std::copysign(size.x() / 2, d.x()), std::copysign(size.y() / 2, d.y()), std::copysign(size.z() / 2, d.z())};
  }
  const bool flat = shape.kind == Shape::Kind::half_cylinder && d.x() < 0;  // the farthest point is on the flat side
  const auto [x, z] = flat ? std::pair(0.0, std::copysign(size.x(), d.z())) : on_circle(size.x(), d.x(), d.z());
  return {x, std::copysign(size.y() / 2, d.y()), z};
}

/// Distance from a half disc (radius r, on the side of +x), negative inside.
double from_half_disc(double r, double x, double z) {
  const double out = std::sqrt(x * x + z * z);
  if (x >= 0) return std::max(out - r, -x);
  return std::abs(z) <= r ? -x : std::sqrt(x * x + (std::abs(z) - r) * (std::abs(z) - r));
}

/// Distance from the intersection of two orthogonal sets whose distances are a and b.
double from_both(double a, double b) {
  const double x = std::max(a, 0.0);
  const double y = std::max(b, 0.0);
  return a <= 0 && b <= 0 ? std::max(a, b) : std::sqrt(x * x + y * y);
}

/// Lower bound of the distance of the origin from a convex set. The set is given by its farthest point in a direction, and by
/// one of its points. The result is negative or 0 if no bound was found. Stops when the bound is the distance within kExactly,
/// or 0 within `ignored`.
template <class Farthest>
double least_distance(const Farthest& farthest_of, Vec3 point, double ignored) {
  double bound = 0;
  for (int i = 0; i < kIterations; ++i) {
    const double length = point.norm();
    if (length <= ignored) return 0;
    const Vec3 end = farthest_of(-point);
    bound = std::max(bound, point.dot(end) / length);
    if (bound >= (1 - kExactly) * length) break;
    const Vec3 way = end - point;
    const double square = way.squaredNorm();
    if (!(square > 0)) break;
    point += std::clamp(-point.dot(way) / square, 0.0, 1.0) * way;
  }
  return bound;
}

/// Gap between two shapes along a direction; negative if they overlap.
double gap_along(const Shape& a, const Shape& b, const Vec3& d) {
  const auto ahead = [&](const Shape& near, const Shape& far, const Vec3& way) {
    return way.dot(farthest(far, -way)) - way.dot(farthest(near, way));
  };
  return std::max(ahead(a, b, d), ahead(a, b, -d));
}

/// True if a plane between the two shapes is found. Touching shapes count as separate.
bool apart(const Shape& a, const Shape& b) {
  const double touching = kTouching * std::max(a.size.norm(), b.size.norm());
  const Mat3& A = a.in_body.R;
  const Mat3& B = b.in_body.R;
  for (int i = 0; i < 3; ++i) {
    if (gap_along(a, b, A.col(i)) > -touching || gap_along(a, b, B.col(i)) > -touching) return true;
  }
  const auto between = [&](const Vec3& d) { return Vec3(farthest(a, d) - farthest(b, -d)); };
  return least_distance(between, a.in_body.p - b.in_body.p, touching) > 0;
}

/// True if `inner` certainly lies within `outer`.
bool within(const Shape& inner, const Shape& outer) {
  const double rounding = kTouching * outer.size.norm();
  if (outer.kind == Shape::Kind::box) {
    const Mat3& R = outer.in_body.R;
    for (int i = 0; i < 3; ++i) {
      for (const Vec3& d : {Vec3(R.col(i)), Vec3(-R.col(i))}) {
        if (d.dot(farthest(inner, d) - outer.in_body.p) > outer.size[i] / 2 + rounding) return false;
      }
    }
    return true;
  }
  if (inner.kind == Shape::Kind::sphere) return distance(outer, inner.in_body.p) <= rounding - inner.size.x();
  const auto inside = [&](const Vec3& corner) { return distance(outer, inner.in_body * corner) <= rounding; };
  if (inner.kind == Shape::Kind::hull) return std::ranges::all_of(inner.hull->corners, inside);
  return inner.kind == Shape::Kind::box && std::ranges::all_of(box_corners(inner.size), inside);
}

/// Part of a line in a convex shape, from `lo` to `hi` along the line; empty if lo >= hi.
struct Chord {
  double lo = -kInfinite, hi = kInfinite;

  /// Cuts off the part where the coordinate o + u t is not between `least` and `most`.
  void cut_slab(double o, double u, double least, double most) {
    if (u == 0) {
      if (o < least || o > most) hi = -kInfinite;
      return;
    }
    const double a = (least - o) / u;
    const double b = (most - o) / u;
    lo = std::max(lo, std::min(a, b));
    hi = std::min(hi, std::max(a, b));
  }
  /// Cuts off the part where (o + u t)^2 > r^2, with the squares of vectors uu, ou, oo.
  void cut_round(double uu, double ou, double oo, double r) {
    const double inside = ou * ou - uu * (oo - r * r);
    if (uu == 0 ? oo > r * r : inside <= 0) hi = -kInfinite;
    if (uu == 0 || inside <= 0) return;
    const double root = std::sqrt(inside);
    lo = std::max(lo, (-ou - root) / uu);
    hi = std::min(hi, (-ou + root) / uu);
  }
};

/// Chord of the line o + u t in a shape, in the axes of the shape.
Chord chord(const Shape& shape, const Vec3& o, const Vec3& u) {
  Chord cut;
  const Vec3& size = shape.size;
  switch (shape.kind) {
    case Shape::Kind::box:
      for (int i = 0; i < 3; ++i) cut.cut_slab(o[i], u[i], -size[i] / 2, size[i] / 2);
      return cut;
    case Shape::Kind::sphere:
      cut.cut_round(u.squaredNorm(), o.dot(u), o.squaredNorm(), size.x());
      return cut;
    case Shape::Kind::hull:
      for (const Hull::Face& face : shape.hull->faces)
        cut.cut_slab(face.normal.dot(o), face.normal.dot(u), -kInfinite, face.offset);
      return cut;
    case Shape::Kind::half_cylinder:
      cut.cut_slab(o.x(), u.x(), 0, size.x());
      break;
    case Shape::Kind::cylinder:
      break;
  }
  cut.cut_slab(o.y(), u.y(), -size.y() / 2, size.y() / 2);
  cut.cut_round(u.x() * u.x() + u.z() * u.z(), o.x() * u.x() + o.z() * u.z(), o.x() * o.x() + o.z() * o.z(), size.x());
  return cut;
}

/// Edges of bars along a coordinate. Every end of a shape is an edge. Bars are narrow near such ends, because the chords of
/// round shapes change fast there.
std::vector<double> edges(std::vector<double> ends) {
  std::sort(ends.begin(), ends.end());
  const double close = kTouching * (ends.back() - ends.front());
  std::vector<double> apart_ends;
  for (const double end : ends) {
    if (apart_ends.empty() || end - apart_ends.back() > close) apart_ends.push_back(end);
  }
  const std::size_t n = std::max<std::size_t>(1, kBars / (apart_ends.size() - 1));
  std::vector<double> all{apart_ends.front()};
  for (std::size_t i = 0; i + 1 < apart_ends.size(); ++i) {
    for (std::size_t k = 1; k <= n; ++k) {
      const double s = static_cast<double>(k) / static_cast<double>(n);
      all.push_back(apart_ends[i] + (apart_ends[i + 1] - apart_ends[i]) * s * s * (3 - 2 * s));
    }
  }
  return all;
}

/// The union of overlapping shapes, as bars along z of the frame of one of them.
class Bars {
 public:
  Bars(const std::vector<Shape>& shapes, const Pose& frame) {
    for (const Shape& shape : shapes) {
      shapes_.push_back(shape);
      shapes_.back().in_body = frame.inverse() * shape.in_body;
      const auto [low, high] = bounds({&shapes_.back(), 1});
      low_.push_back(low);
      high_.push_back(high);
    }
  }

  Solid add_up() {
    const std::vector<double> x = edges(ends(0));
    const std::vector<double> y = edges(ends(1));
    Solid sum;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      for (std::size_t k = 0; k + 1 < y.size(); ++k)
        add_bar({(x[i] + x[i + 1]) / 2, (y[k] + y[k + 1]) / 2, 0}, {x[i + 1] - x[i], y[k + 1] - y[k], 0}, sum);
    }
    sum.centre /= sum.volume;
    sum.second -= sum.volume * sum.centre * sum.centre.transpose();
    return sum;
  }

 private:
  [[nodiscard]] std::vector<double> ends(int axis) const {
    std::vector<double> all;
    for (const Vec3& low : low_) all.push_back(low[axis]);
    for (const Vec3& high : high_) all.push_back(high[axis]);
    return all;
  }

  /// Adds the moments about the origin of the union's parts on a bar.
  void add_bar(Vec3 middle, Vec3 size, Solid& sum) {
    chords_.clear();
    for (std::size_t s = 0; s < shapes_.size(); ++s) {
      if ((middle - low_[s]).head<2>().minCoeff() < 0 || (high_[s] - middle).head<2>().minCoeff() < 0) continue;
      const Pose& pose = shapes_[s].in_body;
      const Chord cut = chord(shapes_[s], pose.R.transpose() * (middle - pose.p), pose.R.row(2).transpose());
      if (cut.lo < cut.hi) chords_.emplace_back(cut.lo, cut.hi);
    }
    std::sort(chords_.begin(), chords_.end());
    double reached = -kInfinite;
    for (const auto& [lo, hi] : chords_) {
      const double from = std::max(lo, reached);
      if (!(hi > from)) continue;
      reached = hi;
      middle.z() = (from + hi) / 2;
      size.z() = hi - from;
      const double volume = size.prod();
      sum.volume += volume;
      sum.centre += volume * middle;
      sum.second += volume * (middle * middle.transpose() + Mat3(size.cwiseAbs2().asDiagonal()) / 12);
    }
  }

  std::vector<Shape> shapes_ = {};
  std::vector<Vec3> low_ = {}, high_ = {};
  std::vector<std::pair<double, double>> chords_ = {};
};

/// Solid of shapes, each of which overlaps another shape.
Solid merged(const std::vector<Shape>& shapes) {
  if (shapes.size() == 1) return solid(shapes.front());
  const auto larger = [](const Shape& a, const Shape& b) { return solid(a).volume < solid(b).volume; };
  const Pose frame = std::max_element(shapes.begin(), shapes.end(), larger)->in_body;
  const Solid there = Bars(shapes, frame).add_up();
  return {there.volume, frame * there.centre, frame.R * there.second * frame.R.transpose()};
}

}  // namespace

std::array<Vec3, 8> box_corners(const Vec3& edges) {
  std::array<Vec3, 8> corners;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 sign((k & 1) != 0 ? 0.5 : -0.5, (k & 2) != 0 ? 0.5 : -0.5, (k & 4) != 0 ? 0.5 : -0.5);
    corners[k] = sign.cwiseProduct(edges);
  }
  return corners;
}

void Solid::add(const Solid& other) {
  const double all = volume + other.volume;
  const Vec3 way = other.centre - centre;
  second += other.second + volume * other.volume / all * way * way.transpose();
  centre += other.volume / all * way;
  volume = all;
}

Solid solid(const Shape& shape) {
  if (shape.kind == Shape::Kind::hull) {
    const Solid own = solid(*shape.hull);
    const Mat3& R = shape.in_body.R;
    return {own.volume, shape.in_body * own.centre, R * own.second * R.transpose()};
  }
  const double r = shape.size.x();
  const double length = shape.size.y();
  Solid own;
  Vec3 mean = shape.size.cwiseAbs2() / 12;  // mean squares of the coordinates about the centre
  switch (shape.kind) {
    case Shape::Kind::box:
      own.volume = shape.size.prod();
      break;
    case Shape::Kind::sphere:
      own.volume = 4 * std::numbers::pi / 3 * r * r * r;
      mean.setConstant(r * r / 5);
      break;
    case Shape::Kind::cylinder:
      own.volume = std::numbers::pi * r * r * length;
      mean = {r * r / 4, length * length / 12, r * r / 4};
      break;
    case Shape::Kind::half_cylinder:
      own.volume = std::numbers::pi / 2 * r * r * length;
      own.centre.x() = 4 * r / (3 * std::numbers::pi);
      mean = {r * r / 4 - own.centre.x() * own.centre.x(), length * length / 12, r * r / 4};
      break;
    case Shape::Kind::hull:
      break;
  }
  const Mat3& R = shape.in_body.R;
  return {own.volume, shape.in_body * own.centre, R * Mat3((own.volume * mean).asDiagonal()) * R.transpose()};
}

Solid united(std::span<const Shape> shapes) {
  std::vector<Shape> outer;
  for (const Shape& shape : shapes) {
    const auto in_it = [&](const Shape& other) { return within(other, shape); };
    if (std::any_of(outer.begin(), outer.end(), [&](const Shape& other) { return within(shape, other); })) continue;
    outer.erase(std::remove_if(outer.begin(), outer.end(), in_it), outer.end());
    outer.push_back(shape);
  }
  std::vector<std::vector<Shape>> groups;  // of shapes that overlap, directly or through others
  for (const Shape& shape : outer) {
    std::vector<Shape> group{shape};
    const auto meets = [&](const std::vector<Shape>& other) {
      return std::any_of(other.begin(), other.end(), [&](const Shape& one) { return !apart(one, shape); });
    };
    for (std::size_t i = 0; i < groups.size();) {
      if (!meets(groups[i])) {
        ++i;
        continue;
      }
      group.insert(group.end(), groups[i].begin(), groups[i].end());
      groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(i));
    }
    groups.push_back(std::move(group));
  }
  Solid sum;
  for (const std::vector<Shape>& group : groups) sum.add(merged(group));
  return sum;
}

Vec3 farthest(const Shape& shape, const Vec3& d) {
  return shape.in_body * farthest_in_shape(shape, shape.in_body.R.transpose() * d);
}

std::pair<Vec3, Vec3> bounds(std::span<const Shape> shapes) {
  Vec3 low = Vec3::Constant(kInfinite);
  Vec3 high = -low;
  for (const Shape& shape : shapes) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], farthest(shape, -Vec3::Unit(i))[i]);
      high[i] = std::max(high[i], farthest(shape, Vec3::Unit(i))[i]);
    }
  }
  return {low, high};
}

double distance(const Shape& shape, const Vec3& point) {
  const Vec3 p = shape.in_body.inverse() * point;
  const Vec3& size = shape.size;
  switch (shape.kind) {
    case Shape::Kind::sphere:
      return p.norm() - size.x();
    case Shape::Kind::hull:
      return shape.hull->distance(p);
    case Shape::Kind::box: {
      const Vec3 out = p.cwiseAbs() - size / 2;
      return out.maxCoeff() <= 0 ? out.maxCoeff() : out.cwiseMax(0.0).norm();
    }
    case Shape::Kind::cylinder:
      return from_both(std::sqrt(p.x() * p.x() + p.z() * p.z()) - size.x(), std::abs(p.y()) - size.y() / 2);
    default:
      return from_both(from_half_disc(size.x(), p.x(), p.z()), std::abs(p.y()) - size.y() / 2);
  }
}

double distance(std::span<const Shape> shapes, const Vec3& point) {
  double least = kInfinite;
  for (const Shape& shape : shapes) least = std::min(least, distance(shape, point));
  return least;
}

double outside_hull(std::span<const Shape> shapes, const Vec3& point) {
  const auto farthest_of = [&](const Vec3& d) {
    Vec3 best = farthest(shapes.front(), d);
    for (const Shape& shape : shapes.subspan(1)) {
      const Vec3 end = farthest(shape, d);
      if (end.dot(d) > best.dot(d)) best = end;
    }
    return Vec3(best - point);
  };
  const auto [low, high] = bounds(shapes);
  return std::max(0.0, least_distance(farthest_of, solid(shapes.front()).centre - point, kTouching * (high - low).norm()));
}

}  // namespace gaitlab
