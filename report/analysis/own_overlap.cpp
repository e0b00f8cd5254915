#include "report/analysis/own_overlap.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "core/math/philox.h"

namespace gaitlab::report {

namespace {

constexpr double kWholeTurn = 2 * std::numbers::pi;
constexpr double kNoDepth = 1e-9;  // m, rounding

std::vector<Convex> shapes_of(const BodyType& body, const Pose& place) {
  std::vector<Convex> made;
  for (const Shape& shape : body.shapes) made.push_back(moved(convex(shape), place));
  return made;
}

/// Poses of the bodies in the frame of the root, with the hinges at the angles (rad).
std::vector<Pose> poses_at(const ModuleType& type, const std::vector<double>& angles) {
  std::vector<std::optional<Pose>> found(type.bodies.size());
  found[type.root] = Pose{};
  for (bool more = true; more;) {
    more = false;
    for (std::size_t h = 0; h < type.hinges.size(); ++h) {
      const HingeType& hinge = type.hinges[h];
      if (!found[hinge.parent] || found[hinge.child]) continue;
      found[hinge.child] = *found[hinge.parent] * hinge.in_parent;
      if (angles[h] != 0) found[hinge.child]->R *= turn(hinge.axis, angles[h]).toRotationMatrix();
      more = true;
    }
  }
  std::vector<Pose> poses;
  for (const std::optional<Pose>& pose : found) poses.push_back(pose.value_or(Pose{}));
  return poses;
}

bool on_one_hinge(const ModuleType& type, std::size_t a, std::size_t b) {
  return std::ranges::any_of(
      type.hinges, [&](const HingeType& hinge) { return std::minmax(hinge.parent, hinge.child) == std::minmax(a, b); });
}

}  // namespace

Placed::Placed(std::vector<Convex> of) : shapes(std::move(of)) {
  std::size_t corners = 0;
  for (const Convex& shape : shapes) {
    for (const Vec3& vertex : shape.vertices) centre += vertex;
    corners += shape.vertices.size();
  }
  if (corners > 0) centre /= static_cast<double>(corners);
  for (const Convex& shape : shapes) {
    for (const Vec3& vertex : shape.vertices) reach = std::max(reach, (vertex - centre).norm() + shape.radius);
  }
}

bool Placed::clear_of(const Placed& other) const { return (centre - other.centre).norm() > reach + other.reach; }

double depth_of(const Placed& one, const Placed& other) {
  if (one.clear_of(other)) return 0;
  double deepest = 0;
  for (const Convex& shape : one.shapes) {
    for (const Convex& with : other.shapes) deepest = std::max(deepest, penetration(shape, with, deepest));
  }
  return deepest;
}

DesignOverlap::DesignOverlap(const ModuleType& type) : type_(type) {
  const std::vector<Pose> poses = poses_at(type, std::vector<double>(type.hinges.size(), 0.0));
  for (std::size_t b = 0; b < type.bodies.size(); ++b) bodies_.emplace_back(shapes_of(type.bodies[b], poses[b]));
}

double DesignOverlap::depth(std::size_t a, std::size_t b) {
  if (bodies_[a].clear_of(bodies_[b])) return 0;
  const auto [known, fresh] = known_.emplace(std::minmax(a, b), 0);
  if (fresh) known->second = depth_of(bodies_[known->first.first], bodies_[known->first.second]);
  return known->second;
}

std::vector<std::pair<std::size_t, std::size_t>> DesignOverlap::pairs() {
  const BodyPairs left_out(type_.may_overlap, body_names(type_));
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t a = 0; a < bodies_.size(); ++a) {
    for (std::size_t b = a + 1; b < bodies_.size(); ++b) {
      if (depth(a, b) > kNoDepth && !on_one_hinge(type_, a, b) && !left_out.has(a, b)) found.emplace_back(a, b);
    }
  }
  std::ranges::stable_sort(found, std::greater<>(), [&](const auto& pair) { return depth(pair.first, pair.second); });
  return found;
}

HingeOverlap::HingeOverlap(const ModuleType& type, std::size_t hinge, double by_design, double ignored)
    : hinge_(type.hinges[hinge]),
      by_design_(by_design),
      ignored_(ignored),
      parent_(shapes_of(type.bodies[hinge_.parent], hinge_.in_parent.inverse())),
      child_(shapes_of(type.bodies[hinge_.child], Pose{})) {
  for (const Convex& shape : child_) {
    for (const Vec3& vertex : shape.vertices) reach_ = std::max(reach_, vertex.cross(hinge_.axis).norm() + shape.radius);
  }
}

double HingeOverlap::beyond(double angle) {
  if (parent_.empty() || child_.empty()) return 0;
  angle = std::remainder(angle, kWholeTurn);
  const auto after = clear_.upper_bound(angle);
  if (after != clear_.begin() && angle <= std::prev(after)->second) return 0;
  const Pose turned{turn(hinge_.axis, angle).toRotationMatrix(), Vec3::Zero()};
  const double counts = by_design_ + ignored_;
  double deepest = 0;
  double room = counts;
  for (const Convex& own : child_) {
    const Convex there = moved(own, turned);
    for (const Convex& other : parent_) {
      Vec3 apart;
      deepest = std::max(deepest, penetration(other, there, std::max(counts, deepest), apart));
      if (deepest == 0) room = std::min(room, counts - overlap_along(Extent(other), {}, Extent(there), {}, apart));
    }
  }
  if (deepest > 0) return deepest - by_design_;
  const double near = room / std::max(reach_, kNoDepth);
  double& end = clear_[angle - near];
  end = std::max(end, angle + near);
  return 0;
}

double deepest_in_range(const ModuleType& type, std::size_t hinge) {
  constexpr double kApart = 0.05;  // rad
  const HingeType& own = type.hinges[hinge];
  const double by_design = kTurned * DesignOverlap(type).depth(own.parent, own.child);
  HingeOverlap overlap(type, hinge, by_design, 0);
  const double lo = std::max(own.lo, -kWholeTurn / 2);
  const double hi = std::min(own.hi, kWholeTurn / 2);
  const int steps = std::max(1, static_cast<int>(std::ceil((hi - lo) / kApart)));
  double deepest = 0;
  for (int k = 0; k <= steps; ++k) deepest = std::max(deepest, overlap.beyond(lo + (hi - lo) * k / steps));
  return deepest;
}

std::vector<std::pair<std::size_t, std::size_t>> always_overlapping(const ModuleType& type) {
  constexpr double kDeep = 5e-4;  // m
  constexpr std::uint32_t kDraws = 64;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < type.bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < type.bodies.size(); ++b) pairs.emplace_back(a, b);
  }
  for (std::uint32_t draw = 0; draw < kDraws && !pairs.empty(); ++draw) {
    std::vector<double> angles;
    for (std::size_t h = 0; h < type.hinges.size(); ++h) {
      const double lo = std::max(type.hinges[h].lo, -kWholeTurn / 2);
      const double hi = std::min(type.hinges[h].hi, kWholeTurn / 2);
      const double share = math::philox({draw, static_cast<std::uint32_t>(h), 0, 0}, {0, 0})[0] / 4294967296.0;
      angles.push_back(lo + share * (hi - lo));
    }
    const std::vector<Pose> poses = poses_at(type, angles);
    std::vector<Placed> bodies;
    for (std::size_t b = 0; b < type.bodies.size(); ++b) bodies.emplace_back(shapes_of(type.bodies[b], poses[b]));
    const auto apart = [&](const auto& pair) { return depth_of(bodies[pair.first], bodies[pair.second]) <= kDeep; };
    std::erase_if(pairs, apart);
  }
  return pairs;
}

std::vector<std::string> body_names(const ModuleType& type) {
  std::vector<std::string> names;
  for (const BodyType& body : type.bodies) names.push_back(body.name);
  return names;
}

}  // namespace gaitlab::report
