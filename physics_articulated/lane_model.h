// Model of one lane for queries that are not part of a step.
#pragma once
#include "core/simulation/stability.h"
#include "physics_articulated/kernel.h"

namespace gaitlab::articulated {

/// Ground::query with the types of the kernels.
Touch<double> query(const Ground& ground, const Vec<double>& centre, double radius);

/// Constants of a lane for the kernel. The settings must outlive the result.
LaneConstants rollout(const LaneSettings& lane, Base base);

class LaneModel final : private InverseMass {
 public:
  LaneModel(const PlantSettings& settings, const LaneSettings& own, std::size_t lane, std::size_t lanes);

  /// See Plant. x is the state of this lane only.
  void accelerate(In x, const RobotState& state, In torque, std::span<const BodyWrench> wrenches, Acceleration& out);
  void change(In hold);  ///< see Plant::change_joints
  [[nodiscard]] Stability stability(In x, const RobotState& state, In command, bool standing);

 private:
  void apply(In force, Out acceleration) override { body_.respond(force, acceleration); }
  /// Evaluates the actuator for all lanes, with commands and speeds of this lane.
  void ask(In command, In speed);

  const PlantSettings& settings_;
  const LaneSettings& own_;
  std::size_t lane_, lanes_;
  LaneConstants constants_;
  Environment<double> environment_;
  TreeBody<double> body_;
  Contacts<double> contacts_;
  std::vector<double> rotor_, a_, zero_, motor_speed_;
  std::vector<std::size_t> plays_;                        // joints with play
  std::vector<double> command_, speed_, torque_, slope_;  // all lanes: joint * lanes + lane
  std::vector<std::size_t> first_, next_;                 // wrenches of accelerate(): first of each link, next on the same link
  Kinematics kinematics_;
  RateMonitor monitor_;
};

}  // namespace gaitlab::articulated
