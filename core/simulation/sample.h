// One lane at one moment: its state and what follows from it, for columns of a recording.
#pragma once
#include <vector>

#include "core/dynamics/inverse_dynamics.h"
#include "core/recording/recording.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Reflected inertia of the rotors of one of `lanes` lanes (Actuator::reflected_inertia).
struct Rotors {
  In inertia;  ///< joint * lanes + lane; empty: none
  std::size_t lanes = 1, lane = 0;
};

/// One lane at a trace tick: the state at t_k and the actuator law at that state under the command in force just before t_k.
struct Sample {
  explicit Sample(const Robot& robot, std::size_t contacts, std::size_t cpg_states);
  void forward_kinematics(const Robot& robot);  ///< fills kinematics, link orientations and sums from state
  void set_boxes(const Ground& ground);         ///< as they start
  /// The ground's boxes as `plant` has them; the signs of their quaternions continuous.
  void place_boxes(const Plant& plant);
  /// Fills the torques of stops and passive hinges from the state. passive: the joints without a motor.
  void compute_hinges(const Robot& robot, const std::vector<std::size_t>& passive);
  /// Kinetic and potential energy, of rotors and springs of passive hinges, too, J.
  [[nodiscard]] double energy(const Robot& robot, const Rotors& rotors, const std::vector<std::size_t>& passive) const;
  /// Fills reactions from what is known here and the accelerations that `plant` gives for it.
  void compute_reactions(const std::vector<ContactElement>& elements, Plant& plant, std::size_t lane);

  double t = 0;
  RobotState state;
  Kinematics kinematics;
  std::vector<Quat> orientation;  ///< of every link frame; sign continuous in time
  Sums sums;
  Vec3 gravity = Vec3::Zero();
  std::vector<double> setpoint, command, voltage, current, saturation, torque, stop_torque, passive_torque;
  std::vector<ContactSample> contacts;
  std::vector<BoxMotion> boxes;  ///< of Ground::boxes(); none where none of them moves
  std::vector<double> cpg;
  Ledger ledger;
  StepTally tally;
  InverseDynamics
      reactions;  ///< at hinges, docks and base: motors, stops, passive hinges and contacts acting; only after react

 private:
  Acceleration acceleration_;
  std::vector<double> applied_;
  std::vector<BodyWrench> ground_;
  std::vector<Quat> before_;
};

}  // namespace gaitlab
