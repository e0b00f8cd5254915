#include "core/simulation/start_check.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <vector>

namespace gaitlab {

namespace {

// Largest ratio that counts as zero: inertia of a joint with the joints beyond it free, over its inertia with these joints
// locked. Rounding errors of the ratio are 1e-16 times the ratios of sizes along the chain.
constexpr double kNothing = 1e-12;
// Share of the locked inertia of a joint that its parent receives. With 1, a long chain would count as one rod, whose inertia
// grows with the third power of its length. Compared with this inertia, the free inertia of a joint would seem to be zero (in a
// chain of 7000 modules). With 0.5, distant links count little, and two joints in line are still found if other joints are
// between them.
constexpr double kHold = 0.5;

using Spatial = Eigen::Matrix<double, 6, 6>;
using Motion = Eigen::Matrix<double, 6, 1>;  ///< angular velocity, then velocity of a link's own origin; world axes

Mat3 cross(const Vec3& r) {
  Mat3 m;
  m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return m;
}

/// Spatial inertia of a link about its origin, world axes.
Spatial inertia_of(const Link& link, const Mat3& R) {
  const Mat3 c = cross(R * link.com);
  Spatial i;
  i << R * link.inertia * R.transpose() - link.mass * c * c, link.mass * c, -link.mass * c, link.mass * Mat3::Identity();
  return i;
}

/// Transforms a spatial inertia to another point; r is the position of its present point relative to the new point.
Spatial moved(const Spatial& inertia, const Vec3& r) {
  Spatial x = Spatial::Identity();  // motion here -> motion there
  x.bottomLeftCorner<3, 3>() = -cross(r);
  return x.transpose() * inertia * x;
}

}  // namespace

std::unique_ptr<Plant> make_plant(const Scenario& scenario, const PlantSettings& settings) try {
  return scenario.physics.engine->make(settings);
} catch (const TooManyJoints& error) {
  throw InputError(scenario.place("physics.engine"), error.what());
}

// The pivots of the mass matrix, eliminated from the tips inwards, are the divisors of the articulated-body recursion: R.
// Featherstone, Rigid Body Dynamics Algorithms (Springer, 2008), 7.3.
void check_inertia(const Scenario& scenario, const Kinematics& k, In rotors, std::size_t lanes, std::size_t lane,
                   const SourceLocation& place) {
  const Robot& robot = *scenario.robot;
  std::vector<Spatial> free(robot.links.size());  // inertias with all outer joints free
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = inertia_of(robot.links[i], k.R[i]);
  std::vector<Spatial> held = free;                    // inertias with the outer joints locked, of which the nearest count most
  for (std::size_t i = free.size() - 1; i > 0; --i) {  // a parent comes before its children
    const Link& link = robot.links[i];
    const auto joint = static_cast<std::size_t>(link.joint);
    // A rotor behind play adds no inertia to its link.
    const double rotor = rotors.empty() || robot.joints[joint].play.any() ? 0 : rotors[joint * lanes + lane];
    Motion axis = Motion::Zero();
    axis.head<3>() = k.R[i] * link.axis;
    const Motion momentum = free[i] * axis;
    const double pivot = axis.dot(momentum) + rotor;
    if (!(pivot > kNothing * (axis.dot(held[i] * axis) + rotor))) {
      throw InputError(place, fmt::format("joint '{}' moves no inertia: the next joint turns about the same axis "
                                          "(gimbal lock). Give the body between the two hinges mass, or start at other angles",
                                          robot.joints[joint].name));
    }
    const auto parent = static_cast<std::size_t>(link.parent);
    const Vec3 r = k.p[i] - k.p[parent];
    const Spatial left = free[i] - momentum * momentum.transpose() / pivot;
    free[parent] += moved(left, r);
    held[parent] += moved(kHold * held[i] + (1 - kHold) * left, r);
  }
}

}  // namespace gaitlab
