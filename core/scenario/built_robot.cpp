#include "core/scenario/built_robot.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/laws/data_sheet.h"
#include "core/laws/motor_bank.h"
#include "core/scenario/buses.h"
#include "core/settings/wording.h"

namespace gaitlab {

namespace {

/// Finds the joints without a value of `i_max`, whose current limit the actuator takes from the current at stall, and those
/// without `u_max`, which take the voltage of their data sheet, or that of the scenario's supply.
struct DerivedLimits final : Fields {
  PerJoint i_max{1}, u_max{1};
  void visit(const Field& field) override {
    const auto* each = std::get_if<field::EachJoint>(&field.value);
    if (each == nullptr) return;
    const std::string_view key = field.key;
    if (key == "i_max") i_max = each->value;
    if (key == "u_max") u_max = each->value;
  }
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}
};

/// True if the integrator is implicit in the motors, so that the law of a gear may jump.
bool implicit(const Scenario& scenario) {
  return scenario.physics.integrator != nullptr && !scenario.physics.integrator->limited;
}

DcMotor with_jump(DcMotor motor) {
  motor.jumps = 1;
  motor.reversal_speed = 0;
  return motor;
}

DcMotor built(DcMotor motor, const MotorBuild& build, bool limited_at_stall) {
  motor.R *= build.R;
  motor.Kt *= build.Kt;
  motor.Ks *= build.Kt;
  motor.u_max *= build.supply;
  const double more = build.gear_friction;
  if (motor.returns > 0) {
    motor.load = efficiency_of_load(more * load_of_efficiency(motor.load));
  } else {
    motor.efficiency = 1 - more * (1 - motor.efficiency);
    motor.load = 1 - more * (1 - motor.load);
  }
  if (limited_at_stall) motor.i_max /= build.R;
  motor.derive();
  return motor;
}

JointFriction built(const JointFriction& friction, const MotorBuild& build) {
  return {friction.dry * build.gear_friction, friction.viscous * build.gear_friction};
}

class BuiltMotors final : public MotorBank {
 public:
  BuiltMotors(const Actuator& drawn, std::span<const Scenario* const> lanes) {
    const In inertia = drawn.reflected_inertia();
    const auto ratings = drawn.ratings();
    const auto friction = drawn.friction();
    std::vector<DerivedLimits> limits(lanes.size());
    for (std::size_t l = 0; l < lanes.size(); ++l)
      visit_settings(*lanes[l]->actuator.entry, lanes[l]->actuator.settings.get(), limits[l]);
    for (std::size_t j = 0; j < lanes[0]->robot->joints.size(); ++j) {
      for (std::size_t l = 0; l < lanes.size(); ++l) {
        const std::size_t i = j * lanes.size() + l;
        const MotorBuild build = motor_build(lanes[l]->as_built, j);
        DcMotor motor = drawn.dc_motors()[i];
        if (motor.reversal_speed > 0 && implicit(*lanes[l])) motor = with_jump(motor);
        if (const double supply = supply_of(*lanes[l], j).voltage; supply > 0 && !(limits[l].u_max[j] > 0))
          motor.u_max = supply;
        add(build == MotorBuild() ? motor : built(motor, build, !(limits[l].i_max[j] > 0)), inertia.empty() ? 0 : inertia[i],
            ratings.empty() ? DriveRatings() : ratings[i], friction.empty() ? JointFriction() : built(friction[i], build));
      }
    }
  }
};

/// Advice for a tolerance one of whose draws is too large: no draw is more than three deviations off.
std::string as_every_seed(double most, std::int64_t seed) {
  return fmt::format("which every seed gives with a deviation below {:.4g} (this is seed {})", most / 3, seed);
}

/// Applies the factors on play to the robot.
void build_gears(Scenario& scenario) {
  std::shared_ptr<Robot> built;
  for (const std::size_t j : joints_with_play(*scenario.robot)) {
    const double factor = play_build(scenario.as_built, j);
    if (factor == 1) continue;
    if (!built) built = std::make_shared<Robot>(*scenario.robot);
    built->joints[j].play.width *= factor;
  }
  if (built) scenario.robot = std::move(built);
}

}  // namespace

std::string build_robot(Scenario& scenario, bool stated) {
  const Robot& drawn = *scenario.robot;
  const bool no_play = joints_with_play(drawn).empty();
  const std::string play = no_play ? play_key(scenario.as_built, scenario.tolerances) : "";
  scenario.drawn = draw(scenario.as_built, scenario.tolerances, drawn, static_cast<std::uint64_t>(scenario.seed));
  const std::vector<ModuleBuild> modules = module_builds(scenario.as_built, drawn.modules.size());
  if (!modules.empty()) scenario.robot = std::make_shared<const Robot>(as_built(drawn, modules));
  build_gears(scenario);
  if (!play.empty()) return play + " has no effect, because no gear of the robot has play";
  if (scenario.drawn > 0 || !scenario.tolerances.any()) return "";
  return stated ? "tolerances has no effect, because as_built states every number, as in the resolved scenario of a run; for "
                  "another robot use the original scenario, or --set as_built={}"
                : "tolerances has no effect, because no part of the robot has such a number";
}

std::unique_ptr<Actuator> make_motors(std::span<const Scenario* const> lanes) {
  std::vector<const PluginSelection*> selections;
  for (const Scenario* lane : lanes) selections.push_back(&lane->actuator);
  std::unique_ptr<Actuator> drawn = make_actuator(selections, info(*lanes[0]->robot));
  const bool differ =
      std::ranges::any_of(lanes, [](const Scenario* lane) { return motors_differ(lane->as_built) || !buses(*lane).empty(); });
  if (drawn == nullptr || drawn->dc_motors() == nullptr) return drawn;
  const std::span<const DcMotor> motors(drawn->dc_motors(), lanes[0]->robot->joints.size() * lanes.size());
  const bool jump = implicit(*lanes[0]) && std::ranges::any_of(motors, [](const DcMotor& m) { return m.reversal_speed > 0; });
  if (!differ && !jump) return drawn;
  return std::make_unique<BuiltMotors>(*drawn, lanes);
}

std::unique_ptr<Actuator> make_motors(const Scenario& scenario) {
  const Scenario* const one = &scenario;
  return make_motors({&one, 1});
}

std::string not_buildable(const Scenario& scenario, const Actuator* actuator, const std::string& of_motors) {
  if (actuator == nullptr) return of_motors + " applies only to motors, but the robot has none";
  const DcMotor* const motors = actuator->dc_motors();
  if (motors == nullptr) {
    return fmt::format("{} applies only to dc_motor and servo, but the actuator is {}", of_motors,
                       in_quotes(std::string(scenario.actuator.entry->name)));
  }
  for (std::size_t j = 0; j < scenario.robot->joints.size(); ++j) {
    const double factor = motor_build(scenario.as_built, j).gear_friction;
    if (!scenario.robot->joints[j].driven() || factor == 1) continue;
    if (motors[j].returns > 0) {
      if (motors[j].load > 0) continue;
      const double share = load_of_efficiency(motors[j].load) / factor;
      return fmt::format(
          "gear_friction {:.4g} changes load_friction of {} from {:.4g} to {:.4g}; expected a factor below {:.4g}", factor,
          scenario.robot->joints[j].name, share, share * factor, 1 / share);
    }
    const double eta = motors[j].efficiency * motors[j].load;
    if (eta > 0) continue;
    const double lost = (1 - eta) / factor;  // lost share of the gear in the drawings
    const std::string wrong = fmt::format(
        "gear_friction {:.4g} changes the gear efficiency of {} from {:.4g} to {:.4g}; expected an efficiency above 0, ",
        factor, scenario.robot->joints[j].name, 1 - lost, eta);
    if (of_motors.starts_with(kTolerancesSection)) {
      return wrong + as_every_seed(1 / lost - 1, scenario.seed);
    }
    return wrong + fmt::format("thus a factor below {:.4g}", 1 / lost);
  }
  return "";
}

std::string too_much_play(const Scenario& scenario, const std::string& of_gears) {
  const Robot& robot = *scenario.robot;
  for (const std::size_t j : joints_with_play(robot)) {
    const Joint& joint = robot.joints[j];
    const double factor = play_build(scenario.as_built, j);
    const double range = joint.hi - joint.lo;
    if (factor == 1 || joint.play.width < range) continue;
    const double drawn = joint.play.width / factor;
    const std::string wrong = fmt::format(
        "play {:.4g} changes the play of {} from {:.4g} to {:.4g} rad; expected less than its range of {:.4g} rad, ", factor,
        joint.name, drawn, joint.play.width, range);
    if (of_gears.starts_with(kTolerancesSection)) return wrong + as_every_seed(range / drawn - 1, scenario.seed);
    return wrong + fmt::format("thus a factor below {:.4g}", range / drawn);
  }
  return "";
}

}  // namespace gaitlab
