// Touch of a contact element among boxes, which combines all solids in reach.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/laws/boxes.h"

namespace gaitlab {

namespace {

constexpr double kSame = 1e-9;    // m; closer positions count as equal
constexpr double kBack = -0.5;    // cosine; a face whose normal points back along the path so far is not an exit
constexpr std::size_t kMost = 4;  // largest number of touches of one element; a corner has three
constexpr int kSweeps = 8;        // iterations of shares(); one iteration is exact for normals at right angles

/// Push of one solid that an element touches or is near.
struct Push {
  double penetration;
  Vec3 normal;
  double friction;
};

/// Face of a box, given by axis and sign. depth() is the depth of a position (in box axes) below the face, m.
struct Face {
  Eigen::Index axis;
  double sign;
  [[nodiscard]] double depth(const Box& box, const Vec3& local) const { return 0.5 * box.size[axis] - sign * local[axis]; }
  [[nodiscard]] Vec3 normal(const Box& box) const { return sign * box.R.col(axis); }
};

constexpr std::array<Face, 6> kFaces{{{2, 1}, {2, -1}, {1, 1}, {1, -1}, {0, 1}, {0, -1}}};

/// Normals of the faces through which an element left one box after another, as at a seam or a corner of four tiles.
struct ExitPath {
  std::array<Vec3, 3> normals;
  std::size_t count = 0;
  [[nodiscard]] bool back(const Vec3& normal) const {
    return std::any_of(normals.begin(), normals.begin() + count, [&](const Vec3& way) { return normal.dot(way) <= kBack; });
  }
};

/// Limit on the number of searches in a query, because a complete search of n boxes in one place looks at n^4 boxes. The corner
/// of a tiled floor needs 276 searches; stairs of 200 boxes on top of one another need 50. A query in a heap of a hundred boxes
/// takes about a millisecond.
struct Searches {
  static constexpr std::size_t kFewest = 300, kLooks = 6000;
  std::size_t left;
};

/// Remaining distance to the open, m, from a position where an element left box `left`. The search ends if the distance reaches
/// `bound`. The result is 0 after the last allowed search.
double remaining_exit_depth(const Boxes& boxes, const Box& left, const Vec3& place, const ExitPath& ways, double bound,
                            Searches& searches) {
  if (searches.left == 0) return 0;
  --searches.left;
  double most = 0;
  for (const std::uint32_t i : boxes.near(place, kSame)) {
    const Box& box = boxes[i];
    if (most >= bound) break;
    if (&box == &left) continue;
    const Vec3 local = box.R.transpose() * (place - box.center);
    if (((local.cwiseAbs() - 0.5 * box.size).array() > kSame).any()) continue;
    double least = bound;
    for (const Face& face : kFaces) {
      const Vec3 normal = face.normal(box);
      double cost = face.depth(box, local);
      if (cost >= least || ways.back(normal)) continue;
      if (ways.count < ways.normals.size()) {
        ExitPath longer = ways;
        longer.normals[longer.count++] = normal;
        cost += remaining_exit_depth(boxes, box, place + cost * normal, longer, least - cost, searches);
      }
      least = std::min(least, cost);
      if (least <= most) break;
    }
    most = std::max(most, least);
  }
  return most;
}

/// Push on a sphere whose centre is in the box, through the face of least depth that leads into the open.
Push inside(const Boxes& boxes, const Box& box, const Vec3& centre, const Vec3& local, double radius, Searches& searches) {
  double least = 2 * box.size.sum();
  Push push{0, Vec3::UnitZ(), box.friction};
  for (const Face& face : kFaces) {
    const double depth = face.depth(box, local);
    if (depth >= least) continue;
    const Vec3 normal = face.normal(box);
    const Vec3 place = centre + depth * normal;
    if (normal.z() < kBack && place.z() < 2 * kSame) continue;
    // The remaining distance counts twice, so that the way up remains the shortest way at the seam to a near box.
    const double cost = depth + 2 * remaining_exit_depth(boxes, box, place, {{normal}, 1}, least - depth, searches);
    if (cost >= least) continue;
    least = cost;
    push.penetration = radius + depth;
    push.normal = normal;
  }
  return push;
}

Push against(const Boxes& boxes, const Box& box, const Vec3& centre, double radius, Searches& searches) {
  const Vec3 local = box.R.transpose() * (centre - box.center);
  const Vec3 nearest = local.cwiseMax(-0.5 * box.size).cwiseMin(0.5 * box.size);
  const double distance = (local - nearest).norm();
  if (!(distance > 0)) return inside(boxes, box, centre, local, radius, searches);
  return {radius - distance, box.R * ((local - nearest) / distance), box.friction};
}

/// Radius of the search around a position, m. It includes all solids that the sphere touches or, if there are none, the nearest
/// solid. `most` is a known bound.
double nearest_distance(const Boxes& boxes, const Vec3& place, double radius, double most) {
  if (most <= boxes.margin()) return most;
  // The sphere is high above the plane, but perhaps close to a box below it.
  double least = most;
  for (const std::uint32_t i : boxes.near(place, 0)) {
    const Vec3 local = boxes[i].R.transpose() * (place - boxes[i].center);
    least = std::min(least, (1 + kSame) * (local.cwiseAbs() - 0.5 * boxes[i].size).cwiseMax(0).norm() + kSame);
  }
  return std::max(least, radius);
}

/// Combination of all touches of an element into one.
class Sum {
 public:
  /// Keeps the deepest touches, sorted by penetration.
  void add(const Push& push) {
    if (count_ > 0 && !(push.penetration > std::min(0.0, pushes_[0].penetration))) return;
    if (count_ == kMost && pushes_[kMost - 1].penetration >= push.penetration) return;
    count_ = std::min(count_ + 1, kMost);
    std::size_t at = count_ - 1;
    for (; at > 0 && pushes_[at - 1].penetration < push.penetration; --at) pushes_[at] = pushes_[at - 1];
    pushes_[at] = push;
  }
  [[nodiscard]] double deepest() const { return pushes_[0].penetration; }

  [[nodiscard]] Push take() const {
    if (count_ < 2 || !(pushes_[1].penetration > 0)) return pushes_[0];
    const std::array<double, kMost> share = shares();
    Vec3 sum = Vec3::Zero();
    double friction = 0;
    double all = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      sum += share[i] * pushes_[i].normal;
      friction += share[i] * pushes_[i].friction;
      all += share[i];
    }
    const double size = sum.norm();
    if (!(size > 0)) return {0, pushes_[0].normal, pushes_[0].friction};  // squeezed from both sides
    return {size, sum / size, friction / all};
  }

 private:
  [[nodiscard]] std::array<double, kMost> shares() const {
    std::array<double, kMost> share{pushes_[0].penetration};
    // The shares of the two deepest touches are computed exactly, because the iteration converges slowly if their normals are
    // almost equal.
    const double c = pushes_[0].normal.dot(pushes_[1].normal);
    const double rest = pushes_[1].penetration - c * pushes_[0].penetration;
    if (c > 0 && rest > 0) {
      share[0] = (pushes_[0].penetration - c * pushes_[1].penetration) / (1 - c * c);
      share[1] = rest / (1 - c * c);
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (std::size_t i = 0; i < count_; ++i) {
        double others = 0;
        for (std::size_t j = 0; j < count_; ++j) {
          if (j != i) others += share[j] * pushes_[i].normal.dot(pushes_[j].normal);
        }
        share[i] = std::max(0.0, pushes_[i].penetration - std::max(0.0, others));
      }
    }
    return share;
  }

  std::array<Push, kMost> pushes_{};  ///< sorted by falling penetration
  std::size_t count_ = 0;
};

/// Height at which the vertical through a position leaves the box upwards, m. Minus infinity if the vertical misses the box.
double top_at(const Box& box, const Vec3& place) {
  const Vec3 at = box.R.transpose() * (Vec3(place.x(), place.y(), 0) - box.center);
  const Vec3 up = box.R.row(2);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double bottom = -kInfinity;
  double top = kInfinity;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double half = 0.5 * box.size[k];
    if (up[k] == 0) {
      if (std::abs(at[k]) > half) return -kInfinity;
      continue;
    }
    const double one = (half - at[k]) / up[k];
    const double other = (-half - at[k]) / up[k];
    bottom = std::max(bottom, std::min(one, other));
    top = std::min(top, std::max(one, other));
  }
  return bottom <= top ? top : -kInfinity;
}

}  // namespace

GroundTouch Boxes::touch(const Vec3& centre, double radius, double friction) const {
  Sum sum;
  sum.add({radius - centre.z(), Vec3::UnitZ(), friction});
  // An element that has sunk into the plane beside a box must not count as beneath the box.
  const Vec3 lifted(centre.x(), centre.y(), std::max(centre.z(), radius + kSame));
  Searches searches{std::max(Searches::kFewest, Searches::kLooks / std::max<std::size_t>(1, size()))};
  for (const std::uint32_t i : near(lifted, nearest_distance(*this, lifted, radius, radius - std::min(0.0, sum.deepest())))) {
    // A farther box neither touches the element nor is the nearest solid.
    const Ball& ball = this->ball(i);
    const double reach = ball.radius + radius - std::min(0.0, sum.deepest());
    if ((lifted - ball.center).squaredNorm() < reach * reach) sum.add(against(*this, (*this)[i], lifted, radius, searches));
  }
  const Push push = sum.take();
  return sphere_touch(push.penetration, push.normal, push.friction, centre, radius);
}

double Boxes::surface_below(const Vec3& point, double give) const {
  double height = 0;
  for (const std::uint32_t i : near(point, 0)) {
    if (const double top = top_at((*this)[i], point); top <= point.z() + give) height = std::max(height, top);
  }
  return height;
}

double Boxes::highest() const {
  double top = 0;
  for (const Box& box : *this) top = std::max(top, box.center.z() + 0.5 * box.size.norm());
  return top;
}

}  // namespace gaitlab
