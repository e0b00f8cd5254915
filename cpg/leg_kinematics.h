// Foot of a leg as a function of the joint angles, and angles that bring it to a point.
#pragma once
#include <vector>

#include "core/model/legs.h"

namespace gaitlab::cpg {

/// A leg in the base frame. Joints between base and leg, and passive joints, keep the angles that the caller gives.
class LegKinematics {
 public:
  LegKinematics(const RobotInfo& robot, const Leg& leg);

  /// Position of the foot, m, base frame, for the angles `q` of all joints, rad: a product of exponentials,
  /// x = T_1 ... T_n x_0, T_k the turn by q_k about the axis of joint k at zero angles.
  [[nodiscard]] Vec3 foot(const std::vector<double>& q) const;
  /// Origin of the first joint of the leg, as foot().
  [[nodiscard]] Vec3 hip(const std::vector<double>& q) const;
  /// Origin of the last joint of the leg, as foot().
  [[nodiscard]] Vec3 knee(const std::vector<double>& q) const;
  /// Axis of the first joint of the leg, base frame, for the angles `q`.
  [[nodiscard]] Vec3 hip_axis(const std::vector<double>& q) const;
  /// Length of the stretched leg: distances between its joints, and from the last joint to the foot, m.
  [[nodiscard]] double length() const { return length_; }

  /// Makes the middle of the contact elements that are lowest (to 1 mm) at the angles `q` the foot. False if it is the foot.
  bool stand(const std::vector<double>& q, const Vec3& up);

  /// Moves the angles of the leg's joints, within their ranges, and wider ranges cut to 2.5 rad on each side of 0 or to the
  /// start, until the foot is nearest to `target`, by at most `rounds` steps of damped least squares
  ///     dq = J' W' (W J J' W' + d^2 1)^-1 W e,   e = target - foot, |dq_j| <= 0.3 rad.
  /// `weights` (W) has the weights of directions in its rows. `damping` is d as a share of the norm of W J.
  /// Reference: S. Buss, Introduction to inverse kinematics with Jacobian transpose, pseudoinverse and damped least squares
  /// methods, 2009. Allocates nothing.
  void reach(const Vec3& target, const Mat3& weights, double damping, int rounds, std::vector<double>& q) const;

  /// Range in which reach() moves joint number `i` of the leg, rad.
  struct Range {
    double lo, hi;
  };
  [[nodiscard]] const std::vector<Range>& ranges() const { return ranges_; }

 private:
  struct Hinge {
    std::size_t joint;
    Vec3 origin, axis;  ///< base frame at zero angles
    int of_leg = -1;    ///< number among the driven joints of the leg
  };
  /// Position of a point of the last link, given in the base frame at zero angles, m.
  [[nodiscard]] Vec3 moved(Vec3 at, const std::vector<double>& q) const;
  void measure();
  /// Turn about a point: x -> R x + p.
  [[nodiscard]] static Pose turn_of(const Hinge& hinge, double angle);

  std::vector<Hinge> hinges_;  ///< from the base outwards
  std::size_t first_ = 0;      ///< number in hinges_ of the first driven joint of the leg
  std::vector<std::size_t> joints_;
  std::vector<Range> ranges_;
  std::vector<std::array<double, 4>> elements_;
  Vec3 foot_ = Vec3::Zero();
  double length_ = 0;
  mutable std::vector<double> jacobian_, step_;  ///< scratch
};

}  // namespace gaitlab::cpg
