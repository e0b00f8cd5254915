// Checks of a scenario as a whole, after all sections are read.
#pragma once
#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Checks of a scenario that add problems at the places of `root`, the tree of the scenario.
class ScenarioChecks {
 public:
  ScenarioChecks(const Node& root, const Scenario& scenario, const Catalog& catalog, Problems& problems)
      : root_(root), scenario_(scenario), catalog_(catalog), problems_(problems) {}

  /// Checks that the name can be the name of a run folder.
  void name();
  /// Checks that the scenario does not set both a height of the base and `on_ground: true`.
  void height(const Node& position, bool given, const Node* on_ground);
  /// Refuses settings that Bullet's own solver does not support.
  void law();
  /// Refuses the section `controller`, because the scenario does not have an actuator.
  void no_controller();
  /// Checks that initial angles are within the ranges of their hinges.
  void initial_angles();
  /// Checks that the joints of the figure exist in the robot.
  void figure_joints();
  /// Checks that the base has the degrees of freedom of its initial velocity.
  void base_velocity();
  /// Checks that limits.touch, which causes a warning, is at most limits.collision, which causes a failure.
  void limits();
  /// Refuses settings for integrators that choose their steps, if the integrator does not.
  void automatic_step();
  /// Checks that controller and actuator use the same unit for commands.
  void units(const Actuator& actuator, const Controller& controller);
  /// Refuses a supply of actuators (nullptr for none) that are not DC motors.
  void supply(const Actuator* actuator);
  /// Refuses play of gears whose motors (nullptr for none) have no inertia, and under laws that cannot simulate it. True if
  /// there was no problem.
  bool play(const Actuator* actuator);
  /// Refuses rotor inertia if the engine cannot add it. The message names the engines that can.
  void rotors(const Actuator& actuator);
  /// Refuses differences of motor constants that the actuator (nullptr for none) does not use, and of friction that the contact
  /// law does not use.
  void built_numbers(const Actuator* actuator);

 private:
  /// Refuses numbers in as_built of parts, given by name, that cannot differ.
  void parts_as_built();
  void refuse_law(const Engine& engine);
  /// Place of the play of a joint's hinge in its module type.
  [[nodiscard]] SourceLocation play_place(std::size_t joint) const;
  /// Place of a joint's initial angle.
  [[nodiscard]] SourceLocation angle_place(std::size_t joint) const;

  const Node& root_;
  const Scenario& scenario_;
  const Catalog& catalog_;
  Problems& problems_;
};

}  // namespace gaitlab
