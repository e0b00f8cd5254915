// What only a whole scenario can show, once its sections are read.
#pragma once
#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Each check adds its findings to the problems, at the places of `root`, the scenario's tree.
class ScenarioChecks {
 public:
  ScenarioChecks(const Node& root, const Scenario& scenario, const Catalog& catalog, Problems& problems)
      : root_(root), scenario_(scenario), catalog_(catalog), problems_(problems) {}

  /// What Bullet's own solver cannot do.
  void law();
  /// Within the hinges' ranges.
  void initial_angles();
  /// Joints of the robot.
  void figure_joints();
  /// A base cannot start with a velocity that it cannot have.
  void base_velocity();
  /// What warns comes before what fails.
  void limits();
  /// What only integrators that choose their steps have.
  void automatic_step();
  /// The controller commands what the actuator takes.
  void units(const Actuator& actuator, const Controller& controller);
  /// An engine that cannot add rotor inertia refuses it and names the ones that can.
  void rotors(const Actuator& actuator);

 private:
  /// SourceLocation of a joint's initial angle.
  [[nodiscard]] SourceLocation angle_place(std::size_t joint) const;

  const Node& root_;
  const Scenario& scenario_;
  const Catalog& catalog_;
  Problems& problems_;
};

}  // namespace gaitlab
