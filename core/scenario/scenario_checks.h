// Checks of a scenario as a whole, after its sections are read.
#pragma once
#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Checks that add their findings to the problems, at the places of `root`, the scenario's tree.
class ScenarioChecks {
 public:
  ScenarioChecks(const Node& root, const Scenario& scenario, const Catalog& catalog, Problems& problems)
      : root_(root), scenario_(scenario), catalog_(catalog), problems_(problems) {}

  /// Settings that Bullet's own solver does not support.
  void law();
  /// Initial angles are within the hinges' ranges.
  void initial_angles();
  /// Joints of the figure exist in the robot.
  void figure_joints();
  /// The initial velocity of the base is among its degrees of freedom.
  void base_velocity();
  /// Every warning limit is below the limit that fails.
  void limits();
  /// Settings that require an integrator that chooses its steps.
  void automatic_step();
  /// The controller's unit is the actuator's.
  void units(const Actuator& actuator, const Controller& controller);
  /// Rotor inertia requires an engine that can add it; names the engines that can.
  void rotors(const Actuator& actuator);

 private:
  void refuse_law(const Engine& engine);
  /// SourceLocation of a joint's initial angle.
  [[nodiscard]] SourceLocation angle_place(std::size_t joint) const;

  const Node& root_;
  const Scenario& scenario_;
  const Catalog& catalog_;
  Problems& problems_;
};

/// Refuses `sensors`, unless it is an empty list.
void refuse_sensors(const Node& node, Problems& problems);

}  // namespace gaitlab
