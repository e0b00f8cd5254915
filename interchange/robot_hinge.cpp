#include "interchange/robot_hinge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gaitlab::interchange {

namespace {

constexpr double kChosenShare = 2;  // of the weight that the motor holds
constexpr double kStandard = 9.81;  // m/s^2

/// Load of a hinge: mass of all that it moves, and the longest distance from its origin to a centre of mass, or radius of
/// gyration.
struct Carried {
  double mass = 0, lever = 0;
};

std::vector<Carried> carried_by_body(const std::vector<BodyType>& bodies, const std::vector<RobotHinge>& hinges) {
  std::vector<Carried> carried;
  for (const BodyType& body : bodies) {
    const double gyration = body.mass > 0 ? std::sqrt(std::max(body.inertia.diagonal().maxCoeff(), 0.0) / body.mass) : 0;
    carried.push_back({body.mass, body.mass > 0 ? std::max(body.com.norm(), gyration) : 0});
  }
  std::vector<const HingeType*> inwards;
  for (const RobotHinge& one : hinges) inwards.push_back(&one.hinge);
  std::ranges::sort(inwards, [](const HingeType* a, const HingeType* b) { return a->child > b->child; });
  for (const HingeType* const hinge : inwards) {
    const Carried& child = carried[hinge->child];
    Carried& parent = carried[hinge->parent];
    parent.mass += child.mass;
    parent.lever = std::max(parent.lever, hinge->in_parent.p.norm() + child.lever);
  }
  return carried;
}

double three_digits(double value) { return std::strtod(fmt::format("{:.3g}", value).c_str(), nullptr); }

}  // namespace

std::vector<double> holding_torques(const std::vector<BodyType>& bodies, const std::vector<RobotHinge>& hinges) {
  const std::vector<Carried> carried = carried_by_body(bodies, hinges);
  std::vector<double> torques;
  for (const RobotHinge& one : hinges) {
    const Carried& load = carried[one.hinge.child];
    torques.push_back(three_digits(kChosenShare * load.mass * kStandard * load.lever));
  }
  return torques;
}

}  // namespace gaitlab::interchange
