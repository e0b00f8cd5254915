#include "interchange/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/functions.h"

namespace gaitlab::interchange {

namespace {

constexpr std::uint32_t kSides = 32;  // sides of a full circle; even, so that half of them surround half a cylinder
constexpr std::uint32_t kRings = kSides / 2;

/// Adds vertices and triangles to a mesh, in the frame of a shape.
class Surface {
 public:
  Surface(Mesh& mesh, const Pose& pose) : mesh_(mesh), pose_(pose) {}

  std::uint32_t vertex(const Vec3& place, const Vec3& normal) {
    mesh_.places.push_back(pose_ * place);
    mesh_.normals.push_back(pose_.R * normal);
    return static_cast<std::uint32_t>(mesh_.places.size() - 1);
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c}); }
  /// Adds a quadrilateral whose corners are given in order around it.
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  /// Adds a convex planar polygon.
  void flat(const std::vector<Vec3>& around, const Vec3& normal) {
    std::vector<std::uint32_t> corners;
    corners.reserve(around.size());
    for (const Vec3& place : around) corners.push_back(vertex(place, normal));
    for (std::size_t k = 2; k < corners.size(); ++k) triangle(corners[0], corners[k - 1], corners[k]);
  }

 private:
  Mesh& mesh_;
  Pose pose_;
};

void add_box(Surface& to, const Vec3& size) {
  const Vec3 half = size / 2;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vec3 u = Vec3::Unit((axis + 1) % 3).cwiseProduct(half);
    const Vec3 v = Vec3::Unit((axis + 2) % 3).cwiseProduct(half);
    for (const double side : {1.0, -1.0}) {
      const Vec3 n = side * Vec3::Unit(axis);
      const Vec3 middle = n.cwiseProduct(half);
      const Vec3 along = side * v;  // sign so that u, along, n are right-handed
      to.flat({middle - u - along, middle + u - along, middle + u + along, middle - u + along}, n);
    }
  }
}

/// Unit vector perpendicular to axis y with number k. The directions turn from -z through +x, with kSides per turn.
Vec3 direction(std::uint32_t k) {
  const auto [s, c] = math::sincos(2 * std::numbers::pi * k / kSides - std::numbers::pi / 2);
  return {c, 0, s};
}

void add_cylinder(Surface& to, double radius, double length, bool half) {
  const Vec3 up = length / 2 * Vec3::UnitY();
  const std::uint32_t sides = half ? kSides / 2 : kSides;
  std::vector<Vec3> rim;
  std::uint32_t before_low = 0;
  std::uint32_t before_high = 0;
  for (std::uint32_t k = 0; k <= sides; ++k) {
    const Vec3 n = direction(k);
    const std::uint32_t low = to.vertex(radius * n - up, n);
    const std::uint32_t high = to.vertex(radius * n + up, n);
    if (k > 0) to.quad(before_low, before_high, high, low);
    before_low = low;
    before_high = high;
    if (k < sides || half) rim.push_back(radius * n);
  }
  std::vector<Vec3> bottom;
  bottom.reserve(rim.size());
  for (const Vec3& place : rim) bottom.push_back(place - up);
  to.flat(bottom, -Vec3::UnitY());
  std::vector<Vec3> top;
  for (auto place = rim.rbegin(); place != rim.rend(); ++place) top.push_back(*place + up);
  to.flat(top, Vec3::UnitY());
  if (half) to.flat({rim.front() - up, rim.back() - up, rim.back() + up, rim.front() + up}, -Vec3::UnitX());
}

void add_sphere(Surface& to, double radius) {
  std::vector<std::uint32_t> before;
  for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
    const auto [s, c] = math::sincos(std::numbers::pi * ring / kRings);
    std::vector<std::uint32_t> now;
    for (std::uint32_t k = 0; k <= kSides; ++k) {
      const bool pole = ring == 0 || ring == kRings;
      const Vec3 n = pole ? Vec3((ring == 0 ? 1 : -1) * Vec3::UnitY()) : Vec3(s * direction(k) + c * Vec3::UnitY());
      now.push_back(to.vertex(radius * n, n));
    }
    for (std::uint32_t k = 0; k < kSides && ring > 0; ++k) {
      if (ring > 1) to.triangle(before[k], before[k + 1], now[k]);
      if (ring < kRings) to.triangle(before[k + 1], now[k + 1], now[k]);
    }
    before = std::move(now);
  }
}

void add_hull(Surface& to, const Hull& hull) {
  for (const Hull::Face& face : hull.faces) {
    std::vector<Vec3> around;
    for (const std::size_t corner : face.corners) around.push_back(hull.corners[corner]);
    to.flat(around, face.normal);
  }
}

/// The shortest tile edge for which `length` has at most 40 tiles.
double tile_edge(double length) {
  for (const double power : {1e-4, 1e-3, 1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4}) {
    for (const double times : {1.0, 2.0, 5.0}) {
      if (40 * times * power >= length) return times * power;
    }
  }
  return length / 40;
}

/// Coordinates of the edges of whole tiles that cover [lo, hi].
std::vector<double> tile_lines(double edge, double lo, double hi) {
  std::vector<double> at;
  const double first = std::floor(lo / edge);
  const auto count = static_cast<std::size_t>(std::ceil(hi / edge) - first);
  for (std::size_t k = 0; k <= count; ++k) at.push_back(edge * (first + static_cast<double>(k)));
  return at;
}

/// Nodes of a height field along an axis. `parts` - 1 lines are drawn between two nodes; if `stride` exceeds 1, only every
/// `stride`th line is drawn.
struct FieldAxis {
  double origin, spacing;
  std::size_t nodes, parts, stride;
};

/// Coordinates of the lines that divide a height field along an axis: parts of its cells, edges of tiles, and the ends of the
/// drawn area. Lines that nearly coincide are merged, because float32 might not distinguish them.
std::vector<double> field_lines(const FieldAxis& axis, double edge, double lo, double hi) {
  const double part = axis.spacing / static_cast<double>(axis.parts);
  std::vector<double> all{lo, hi};
  const std::size_t last = (axis.nodes - 1) * axis.parts;
  for (std::size_t k = 0; k < last; k += axis.stride) all.push_back(axis.origin + part * static_cast<double>(k));
  all.push_back(axis.origin + part * static_cast<double>(last));
  for (const double x : tile_lines(edge, lo, hi)) {
    if (x > lo && x < hi) all.push_back(x);
  }
  std::sort(all.begin(), all.end());
  const double near = 1e-3 * std::min(part, edge);
  std::vector<double> at;
  for (const double x : all) {
    if (at.empty() || x - at.back() > near) at.push_back(x);
  }
  return at;
}

/// Tiles with a vertex at each crossing of the lines, and two triangles in each cell between the lines.
template <class Vertex>
Tiles grid(double edge, const std::vector<double>& xs, const std::vector<double>& ys, const Vertex& vertex) {
  Tiles made;
  made.edge = edge;
  Surface to(made.light, {});
  for (const double y : ys) {
    for (const double x : xs) vertex(to, x, y);
  }
  const auto number = [edge](double a, double b) { return std::floor((a + b) / 2 / edge); };
  for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
      const auto a = static_cast<std::uint32_t>(j * xs.size() + i);
      const auto above = static_cast<std::uint32_t>(a + xs.size());
      const bool even = std::fmod(number(xs[i], xs[i + 1]) + number(ys[j], ys[j + 1]), 2) == 0;
      Triangles& list = even ? made.light.triangles : made.dark;
      list.insert(list.end(), {a, a + 1, above + 1, a, above + 1, above});
    }
  }
  return made;
}

}  // namespace

void add(Mesh& mesh, const Shape& shape) {
  Surface to(mesh, shape.in_body);
  switch (shape.kind) {
    case Shape::Kind::box:
      return add_box(to, shape.size);
    case Shape::Kind::cylinder:
      return add_cylinder(to, shape.size.x(), shape.size.y(), false);
    case Shape::Kind::half_cylinder:
      return add_cylinder(to, shape.size.x(), shape.size.y(), true);
    case Shape::Kind::sphere:
      return add_sphere(to, shape.size.x());
    case Shape::Kind::hull:
      return add_hull(to, *shape.hull);
  }
}

Tiles tiles(const Area& area) {
  const double edge = tile_edge(std::max(area.x_hi - area.x_lo, area.y_hi - area.y_lo));
  return grid(edge, tile_lines(edge, area.x_lo, area.x_hi), tile_lines(edge, area.y_lo, area.y_hi),
              [](Surface& to, double x, double y) {
                to.vertex({x, y, 0}, Vec3::UnitZ());
              });
}

std::size_t drawn_stride(const Heightfield& field) {
  constexpr double kMost = 512;
  return static_cast<std::size_t>(std::max(1.0, std::ceil(std::sqrt(static_cast<double>(field.values.size())) / kMost)));
}

Tiles tiles(const Heightfield& field, const Area& area) {
  const std::size_t cells = (field.columns - 1) * (field.rows() - 1);
  const std::size_t parts = cells > 64000 ? 1 : cells > 16000 ? 2 : 4;
  const auto end = [&](double origin, std::size_t nodes) { return origin + field.spacing * static_cast<double>(nodes - 1); };
  const Area drawn{std::min(area.x_lo, field.origin.x()), std::max(area.x_hi, end(field.origin.x(), field.columns)),
                   std::min(area.y_lo, field.origin.y()), std::max(area.y_hi, end(field.origin.y(), field.rows()))};
  const double edge = tile_edge(std::max(drawn.x_hi - drawn.x_lo, drawn.y_hi - drawn.y_lo));
  const std::size_t stride = drawn_stride(field);
  const auto xs = field_lines({field.origin.x(), field.spacing, field.columns, parts, stride}, edge, drawn.x_lo, drawn.x_hi);
  const auto ys = field_lines({field.origin.y(), field.spacing, field.rows(), parts, stride}, edge, drawn.y_lo, drawn.y_hi);
  return grid(edge, xs, ys, [&field](Surface& to, double x, double y) {
    const Heightfield::SurfacePoint at = field.at(x, y);
    to.vertex({x, y, at.z}, at.normal);
  });
}

}  // namespace gaitlab::interchange
