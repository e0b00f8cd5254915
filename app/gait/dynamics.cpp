// `gaitlab dynamics`, which evaluates the equations of motion once: it reads a state and writes accelerations or torques as
// JSON.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/shell/commands.h"
#include "core/dynamics/mass_matrix.h"
#include "core/scenario/state_file.h"
#include "core/simulation/plant.h"
#include "core/simulation/start.h"
#include "core/simulation/start_check.h"

namespace gaitlab::app {

namespace {

constexpr const char* kHelp =
    "The state: {\"q\": [], \"qd\": [], \"tau\": [], \"qdd\": [], \"base\": {\"position\", \"quaternion\": [w, x, y, z],\n"
    "\"velocity\", \"angular_velocity\", \"acceleration\", \"angular_acceleration\"}, \"wrenches\": [{\"body\", \"point\",\n"
    "\"force\", \"torque\"}]}; SI, world axes, joints in the order of `gaitlab check`. Defaults: q, qd, pose\n"
    "and twist at the scenario's start; point of a wrench: the origin of its body's frame; all others: 0.\n"
    "Gravity, tau and the wrenches act; motors, hinge stops, passive hinges and the ground do not. tau is the torque on the "
    "joint.\n\n"
    "Output of forward dynamics (from tau, computed by the scenario's engine): qdd, base, mass_matrix, bias, with\n"
    "    mass_matrix [base acceleration; qdd] + bias = [0; tau]\n"
    "Rows of the base are its free coordinates: all (floating), none (fixed), x, z, rotation about y (planar).\n"
    "Output of --inverse (from qdd and the base's accelerations): tau, base_wrench (external, about the origin of the base "
    "frame),\n"
    "reactions (force and torque of the parent on the child at every hinge and dock, m3/dock, about its origin).";

struct DynamicsArguments : ScenarioArguments {
  std::string state;     ///< file with the state in JSON
  bool inverse = false;  ///< true: compute torques and reactions for given accelerations
};

/// JSON array of numbers, each with the shortest text that is read back as the same double.
std::string list(In values) { return fmt::format("[{}]", fmt::join(values, ", ")); }
std::string list(const Eigen::VectorXd& v) { return list(In(v.data(), static_cast<std::size_t>(v.size()))); }
std::string list(const Vec3& v) { return list(In(v.data(), 3)); }

std::string wrench(const Wrench& w) { return fmt::format("{{\"force\": {}, \"torque\": {}}}", list(w.force), list(w.moment)); }

void check_finite(const Eigen::VectorXd& result, const SourceLocation& place) {
  if (!result.allFinite()) throw InputError(place, "the result is not finite; expected smaller values in the state");
}

/// Accelerations under the torques and wrenches of the input, computed by the scenario's engine.
Acceleration forward(const Scenario& scenario, const DynamicsInput& input) {
  PlantSettings settings;
  settings.robot = scenario.robot;
  settings.base = scenario.base;
  settings.gravity = scenario.physics.gravity;
  settings.ground.shape = NoGround{};
  settings.integrator = scenario.physics.integrator->name;
  const std::unique_ptr<Plant> plant = make_plant(scenario, settings);
  Acceleration acceleration;
  acceleration.joints.resize(input.tau.size());
  plant->accelerate(0, input.state, input.tau, input.wrenches, acceleration);
  return acceleration;
}

void print_forward(const Scenario& s, const DynamicsInput& input, const Kinematics& k) {
  check_inertia(s, k, {}, 1, 0, input.place);
  const Acceleration a = forward(s, input);
  MassMatrix mass(*s.robot, s.base);
  mass.update(k);
  InverseDynamics at_rest(*s.robot);
  Acceleration none;
  none.joints.assign(input.tau.size(), 0.0);
  at_rest.update(k, none, s.physics.gravity, input.wrenches);
  const Eigen::VectorXd bias = generalised_force(at_rest, s.base);
  Eigen::VectorXd all(6 + static_cast<Eigen::Index>(a.joints.size()));
  all << a.linear, a.angular, Eigen::Map<const Eigen::VectorXd>(a.joints.data(), static_cast<Eigen::Index>(a.joints.size()));
  check_finite(all, input.place);
  check_finite(bias, input.place);
  std::vector<std::string> rows;
  for (const auto& row : mass.matrix().rowwise()) rows.push_back("    " + list(Eigen::VectorXd(row.transpose())));
  fmt::print("{{\n  \"qdd\": {},\n  \"base\": {{\"acceleration\": {}, \"angular_acceleration\": {}}},\n", list(a.joints),
             list(a.linear), list(a.angular));
  fmt::print("  \"mass_matrix\": [\n{}\n  ],\n  \"bias\": {}\n}}\n", fmt::join(rows, ",\n"), list(bias));
}

void print_inverse(const Scenario& s, const DynamicsInput& input, const Kinematics& k) {
  const Robot& robot = *s.robot;
  InverseDynamics dynamics(robot);
  dynamics.update(k, input.acceleration, s.physics.gravity, input.wrenches);
  check_finite(generalised_force(dynamics, Base::floating), input.place);
  std::vector<std::string> reactions;
  const auto add = [&](const std::string& name, const Wrench& w) {
    reactions.push_back(fmt::format("    \"{}\": {}", name, wrench(w)));
  };
  for (std::size_t j = 0; j < robot.joints.size(); ++j) add(robot.joints[j].name, dynamics.hinge(j));
  for (std::size_t m = 1; m < robot.modules.size(); ++m) add(dock_name(m), dynamics.dock(m));
  fmt::print("{{\n  \"tau\": {},\n  \"base_wrench\": {},\n  \"reactions\": {{\n{}\n  }}\n}}\n", list(dynamics.torques()),
             wrench(dynamics.base()), fmt::join(reactions, ",\n"));
}

int dynamics(const DynamicsArguments& arguments) {
  Catalog catalog = standard_catalog();
  const Scenario scenario = read(arguments, catalog);
  const DynamicsInput input = read_state_file(arguments.state, *scenario.robot, scenario.base, start_state(scenario));
  Kinematics kinematics(*scenario.robot);
  kinematics.update(*scenario.robot, input.state);
  (arguments.inverse ? print_inverse : print_forward)(scenario, input, kinematics);
  return 0;
}

}  // namespace

void add_dynamics(Commands& commands) {
  add_command<DynamicsArguments>(
      commands, "dynamics", "Evaluate the equations of motion once, as JSON.", dynamics,
      [](CLI::App& command, DynamicsArguments& arguments) {
        command.footer(kHelp);
        add_scenario(command, arguments);
        command.add_option("--state", arguments.state, "JSON file with positions, velocities and applied forces")->required();
        command.add_flag("--inverse", arguments.inverse, "compute torques and reactions from given accelerations");
      });
}

}  // namespace gaitlab::app
