// Poses and velocities of all links, by recursion from the base outwards.
#pragma once
#include <span>
#include <vector>

#include "core/model/robot.h"

namespace gaitlab {

/// State of one robot, one lane: SI, world axes.
struct RobotState {
  Vec3 position = Vec3::Zero();          ///< origin of the base frame, m
  Quat orientation = Quat::Identity();   ///< base frame -> world
  Vec3 velocity = Vec3::Zero();          ///< velocity of the origin of the base frame, m/s
  Vec3 angular_velocity = Vec3::Zero();  ///< rad/s
  std::vector<double> q, qd;             ///< joint angles, rad, and speeds, rad/s
  /// Angles, rad, and speeds, rad/s, of the motors of joints with play (joints_with_play), at the joint.
  std::vector<double> rotor = {}, rotor_speed = {};
};

/// Time derivative of the velocities of a RobotState, world axes, SI.
struct Acceleration {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  ///< linear: of the origin of the base frame; angular: of the base frame
  std::vector<double> joints;
  std::vector<double> rotors = {};  ///< of motors of joints with play
};

/// World pose and velocity of every link frame. Only the constructor allocates.
struct Kinematics {
  explicit Kinematics(const Robot& robot);
  void update(const Robot& robot, const RobotState& state);
  /// Computes the poses only; omega and v are unchanged.
  void place(const Robot& robot, const RobotState& state);

  [[nodiscard]] Vec3 point(std::size_t link, const Vec3& in_link) const { return R[link] * in_link + p[link]; }
  /// Velocity of the material point of `link` that is at world point `x`.
  [[nodiscard]] Vec3 velocity(std::size_t link, const Vec3& x) const { return v[link] + omega[link].cross(x - p[link]); }

  std::vector<Mat3> R;      ///< link axes in the world
  std::vector<Vec3> p;      ///< origin of the link frame, m
  std::vector<Vec3> omega;  ///< rad/s
  std::vector<Vec3> v;      ///< velocity of the origin of the link frame, m/s
  std::vector<Quat> turns;  ///< per link (1..): rotation of the link frame by its joint, relative to angle 0
};

/// Kinematics with all angles and speeds 0 and the base frame equal to the world frame.
Kinematics at_zero(const Robot& robot);

/// Mechanical sums over all links.
struct Sums {
  Vec3 com = Vec3::Zero(), momentum = Vec3::Zero();
  Vec3 angular_momentum = Vec3::Zero();  ///< angular momentum about the world origin
  double kinetic = 0, potential = 0;     ///< J
};
/// Centre of mass as in Sums, m.
Vec3 centre_of_mass(const Robot& robot, const Kinematics& kinematics);
Sums sums(const Robot& robot, const Kinematics& kinematics, const Vec3& gravity);

/// Height (world z, m) of the lowest point of the contact elements or, without elements, of the outline of the robot.
double lowest_point(const Robot& robot, const Kinematics& kinematics, std::span<const ContactElement> elements);

}  // namespace gaitlab
