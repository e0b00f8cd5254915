#include "app/new/chain.h"

#include <algorithm>
#include <optional>

#include "core/model/docking.h"
#include "core/model/kinematics.h"

namespace gaitlab::app {

namespace {

/// Smallest number of quarter turns that both faces allow; nothing if they cannot dock.
std::optional<int> orientation(const FaceType& child, const FaceType& parent) {
  const bool alike = child.gender == parent.gender;
  const bool none = child.gender == Gender::none || parent.gender == Gender::none;
  if ((none ? !alike : alike) || child.connector != parent.connector || child.id == parent.id) return {};
  for (std::size_t turn = 0; turn < child.turns.size(); ++turn) {
    if (child.turns[turn] && parent.turns[turn]) return static_cast<int>(turn);
  }
  return {};
}

/// Face in the module frame at zero angles.
struct PlacedFace {
  Vec3 origin, normal;
};

PlacedFace placed(const FaceType& face, const Robot& robot, const Kinematics& zero) {
  const Body& body = *std::ranges::find(robot.bodies, face.body, &Body::type);
  return {zero.point(body.link, body.in_link * face.origin), zero.R[body.link] * (body.in_link.R * face.normal)};
}

}  // namespace

std::vector<Dock> chain(const Scenario& one, int count) {
  constexpr double kStraight = 0.99;  // cosine of the largest bend at a module of a straight row, 8 degrees
  constexpr double kBetter = 1e-9;    // for cosines and for m; above the rounding errors of equal pairs
  const Robot& robot = *one.robot;
  const Kinematics zero = at_zero(robot);
  const std::vector<FaceType>& faces = robot.types[0].faces;
  Dock best;
  double straight = 0, longest = 0;  // values of the best pair: cosine of the bend; distance of the two planes, m
  for (const FaceType& child : faces) {
    for (const FaceType& parent : faces) {
      const std::optional<int> turn = orientation(child, parent);
      if (!turn) continue;
      const PlacedFace tail = placed(child, robot, zero);
      const PlacedFace head = placed(parent, robot, zero);
      const double cosine = -tail.normal.dot(head.normal);
      const double length = (head.origin - tail.origin).dot(head.normal);
      const bool as_straight = cosine > straight - kBetter && length > longest + kBetter;
      if (!(cosine > straight + kBetter && length > 0) && !as_straight) continue;
      straight = cosine;
      longest = length;
      best = {child.id, 0, parent.id, 0, *turn};
    }
  }
  const int modules = straight >= kStraight ? count : straight > 0 ? 2 : 1;
  std::vector<Dock> docks;
  for (int module = 1; module < modules; ++module) {
    best.child_module = module;
    best.parent_module = module - 1;
    docks.push_back(best);
  }
  return docks;
}

}  // namespace gaitlab::app
