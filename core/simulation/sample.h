// State of one lane at one time, with the quantities that a recording derives from it.
#pragma once
#include <vector>

#include "core/dynamics/inverse_dynamics.h"
#include "core/recording/recording.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Reflected rotor inertia of the joints of one lane (Actuator::reflected_inertia).
struct Rotors {
  In inertia;  ///< kg m^2, index joint * lanes + lane; empty without rotors
  std::size_t lanes = 1, lane = 0;
};

/// State of one lane at a trace tick t_k, and the results of the actuator law at that state under the command in force just
/// before t_k.
struct Sample {
  explicit Sample(const Robot& robot, std::size_t contacts, std::size_t cpg_states);
  void forward_kinematics(const Robot& robot);  ///< fills kinematics, link orientations and sums from state
  void set_boxes(const Ground& ground);         ///< places the boxes at their start
  /// Reads the motion of the ground boxes from `plant`. The signs of their quaternions are continuous in time.
  void place_boxes(const Plant& plant);
  /// Fills the torques of stops, gears with play and passive hinges from the state. `passive` lists the joints without a motor.
  void compute_hinges(const Robot& robot, const std::vector<std::size_t>& passive);
  /// Kinetic and potential energy, including the energy of rotors and of springs of passive hinges, J.
  [[nodiscard]] double energy(const Robot& robot, const Rotors& rotors, const std::vector<std::size_t>& passive) const;
  /// Fills reactions from this sample and the accelerations that `plant` computes for it.
  void compute_reactions(const std::vector<ContactElement>& elements, Plant& plant, std::size_t lane);

  double t = 0;
  RobotState state;
  Kinematics kinematics;
  std::vector<Quat> orientation;  ///< link frames; signs continuous in time
  Sums sums;
  Vec3 gravity = Vec3::Zero();
  std::vector<double> setpoint, command, voltage, current, saturation, torque, friction, stop_torque, passive_torque;
  std::vector<double> gear_torque;  ///< of gears with play, on the links; 0 for other joints
  bool sticks = false;              ///< true if `friction` of passive hinges is set-valued, and part of passive_torque
  std::vector<double> fault, hold;  ///< per joint: number of its fault; its angle if it is stuck, rad, else NaN
  std::vector<double> stuck_for;    ///< time that each joint has been stuck, s, as in Plant::change_joints
  double segment = 0;
  std::vector<double> bus_voltage, bus_current;  ///< V, A; of each bus (buses()), with room for one of each module and one more
  std::vector<ContactSample> contacts;
  std::vector<BoxMotion> boxes;  ///< one per box of the ground; empty if none can move
  std::vector<double> cpg;
  std::vector<double> sensed;  ///< readings of the sensors; empty without sensors
  Ledger ledger;
  StepTally tally;
  InverseDynamics
      reactions;  ///< at hinges, docks and base under motors, stops, passive hinges and contacts; see compute_reactions()

 private:
  std::vector<std::size_t> plays_;  ///< joints with play
  Acceleration acceleration_;
  std::vector<double> applied_;
  std::vector<BodyWrench> ground_;
  std::vector<Quat> before_;
};

}  // namespace gaitlab
