// Inverse dynamics by recursive Newton-Euler over the bodies, independent of any engine: torques and reactions that a motion
// requires.
#pragma once
#include <span>
#include <vector>

#include "core/dynamics/body_tree.h"
#include "core/dynamics/wrench.h"
#include "core/model/kinematics.h"
#include "core/plugin/fields.h"

namespace gaitlab {

/// Recursive Newton-Euler algorithm (Luh, Walker, Paul 1980), here in world axes. Every body needs f = m (a - g) and n = I
/// alpha + omega x I omega about its COM, minus the external wrenches on the body. A hinge or dock carries the sum over all
/// bodies beyond it. The torque of a joint is the component of the carried moment along the joint axis. Moments are summed
/// about the origin of the base frame, then moved to the hinge or dock. Only the inertia of bodies is included; the caller adds
/// the inertia of rotors. update() does not allocate.
class InverseDynamics {
 public:
  explicit InverseDynamics(const Robot& robot);

  /// `kinematics` must be up to date with the state whose accelerations are given.
  void update(const Kinematics& kinematics, const Acceleration& acceleration, const Vec3& gravity,
              std::span<const BodyWrench> wrenches = {});

  [[nodiscard]] In torques() const { return torques_; }  ///< joint torques, N m, positive along the axis
  /// External wrench that the base requires, about the origin of the base frame. 0 for a free base.
  [[nodiscard]] const Wrench& base() const { return carried_[tree_.order[0]]; }
  /// Wrench of the parent on the child, about the origin of the hinge: the sum of motor torque, stop and bearing.
  [[nodiscard]] const Wrench& hinge(std::size_t joint) const { return carried_[body_of_joint_[joint]]; }
  /// Wrench of the parent on a module (not the root) at their dock, about the origin of the docked faces.
  [[nodiscard]] const Wrench& dock(std::size_t module) const { return carried_[robot_.modules[module].reference]; }

 private:
  void move_links(const Kinematics& k, const Acceleration& a);
  [[nodiscard]] Wrench needed(const Kinematics& k, std::size_t body, const Vec3& gravity) const;

  const Robot& robot_;
  BodyTree tree_;
  std::vector<std::size_t> body_of_joint_;  ///< child body of each joint
  std::vector<Vec3> alpha_, a_;             ///< per link: angular acceleration; acceleration of the link frame's origin
  std::vector<Wrench> carried_;             ///< per body: wrench of the parent on the body
  std::vector<double> torques_;
};

}  // namespace gaitlab
