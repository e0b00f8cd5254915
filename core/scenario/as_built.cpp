#include "core/scenario/as_built.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/philox.h"

namespace gaitlab {

namespace {

constexpr double kMostDeviations = 3;
constexpr double kMostShare = 0.3;     // a factor that is three deviations low is then still 0.1
constexpr double kMostFriction = 0.5;  // as much as chosen friction may be off; also of play, which differs as much
constexpr double kMostAngle = 0.1;     // rad
constexpr double kLeastFactor = 0.01;
constexpr double kMostFactor = 100;

constexpr Spec share(const char* about) { return {"", 0, kMostShare, about}; }
constexpr Spec factor(const char* about) { return {"", kLeastFactor, kMostFactor, about}; }
constexpr Spec angle(const char* about) { return {"rad", -0.5, 0.5, about}; }

/// Positions in kTolerances.
struct Deviation {
  enum : std::size_t { mass, inertia, dock_angle, foot_friction, R, Kt, gear_friction, play, supply };
};
/// Positions in kBuiltNumbers.
struct Number {
  enum At : std::size_t { mass, inertia, dock_x, dock_y, dock_z, foot_friction, R, Kt, gear_friction, play, supply };
};

using Of = BuiltNumber::Of;

}  // namespace

const std::array<Tolerance, 9> kTolerances{{
    {"mass", share("Deviation of a module's mass, as a share. The moments of inertia follow the mass.")},
    {"inertia", share("Further deviation of a module's moments of inertia, as a share.")},
    {"dock_angle", {"rad", 0, kMostAngle, "Deviation of the angle of a dock, about each of three axes."}},
    {"foot_friction", share("Deviation of the friction coefficient under a module's contact elements, as a share.")},
    {"R", share("Deviation of the winding resistance of a motor, as a share.")},
    {"Kt", share("Deviation of the torque constant of a motor, as a share; its back-EMF constant follows.")},
    {"gear_friction",
     {"", 0, kMostFriction,
      "Deviation of a gear's loss (1 - efficiency) and of a joint's friction, as a share. Draws are cut at a factor of 0.01."}},
    {"play", {"", 0, kMostFriction, "Deviation of the play of a gear, as a share. Draws are cut at a factor of 0.01."}},
    {"supply", share("Deviation of the motors' voltage limit, as a share; one draw for the whole robot, as for its battery.")},
}};

const std::array<BuiltNumber, 11> kBuiltNumbers{{
    {"mass", Of::modules, Deviation::mass, 1, factor("Factor on a module's mass and moments of inertia.")},
    {"inertia", Of::modules, Deviation::inertia, 1, factor("Further factor on a module's moments of inertia.")},
    {"dock_x", Of::modules, Deviation::dock_angle, 0,
     angle("Angle of a module at the dock to its parent, about the normal of the parent's face.")},
    {"dock_y", Of::modules, Deviation::dock_angle, 0,
     angle("Angle of a module at the dock to its parent, about the reference "
           "direction of the parent's face.")},
    {"dock_z", Of::modules, Deviation::dock_angle, 0,
     angle("Angle of a module at the dock to its parent, about normal x "
           "reference of the parent's face.")},
    {"foot_friction", Of::modules, Deviation::foot_friction, 1,
     factor("Factor on the friction coefficient under a module's contact elements.")},
    {"R", Of::motors, Deviation::R, 1, factor("Factor on the winding resistance of a motor.")},
    {"Kt", Of::motors, Deviation::Kt, 1, factor("Factor on the torque constant and the back-EMF constant of a motor.")},
    {"gear_friction", Of::motors, Deviation::gear_friction, 1,
     factor("Factor on a gear's loss (1 - efficiency, or load_friction) and on the friction of the motor's joint.")},
    {"play", Of::gears, Deviation::play, 1, factor("Factor on the play of the gear of a joint.")},
    {"supply", Of::robot, Deviation::supply, 1, factor("Factor on the motors' voltage limits.")},
}};

void Tolerances::fields(Fields& f) {
  for (std::size_t i = 0; i < kTolerances.size(); ++i) f.number(kTolerances[i].key, deviation[i], kTolerances[i].spec);
}

AsBuilt::AsBuilt() {
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i].common = kBuiltNumbers[i].neutral;
}

AsBuilt AsBuilt::unknown() {
  AsBuilt built;
  for (PerJoint& number : built.numbers) number.common = std::numeric_limits<double>::quiet_NaN();
  return built;
}

void AsBuilt::fields(Fields& f) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const BuiltNumber& number = kBuiltNumbers[i];
    if (number.of == Of::robot) {
      f.number(number.key, numbers[i].common, number.spec);
    } else if (number.of == Of::modules) {
      f.per_module(number.key, numbers[i], number.spec);
    } else {
      f.per_joint(number.key, numbers[i], number.spec);
    }
  }
}

std::vector<std::string> module_names(const Robot& robot) {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < robot.modules.size(); ++m) names.push_back(fmt::format("m{}", m));
  return names;
}

std::vector<std::string> parts_with(const BuiltNumber& number, const Robot& robot) {
  if (number.of == Of::robot) return {"robot"};
  std::vector<std::string> parts;
  if (number.of == Of::modules) {
    parts = module_names(robot);
    if (number.tolerance == Deviation::dock_angle) parts.front().clear();
  } else {
    const bool gears = number.of == Of::gears;
    for (const Joint& joint : robot.joints) parts.push_back((gears ? joint.play.any() : joint.driven()) ? joint.name : "");
  }
  return parts;
}

std::size_t draw(AsBuilt& built, const Tolerances& tolerances, const Robot& robot, std::uint64_t seed) {
  std::size_t draws = 0;
  for (std::size_t i = 0; i < kBuiltNumbers.size(); ++i) {
    const BuiltNumber& number = kBuiltNumbers[i];
    const double deviation = tolerances.deviation[number.tolerance];
    const std::vector<std::string> parts = parts_with(number, robot);
    std::vector<double> each(parts.size(), number.neutral);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (parts[p].empty()) continue;
      const double stated = built.numbers[i][p];
      if (!std::isnan(stated)) {
        each[p] = stated;
      } else if (deviation > 0) {
        const double normal = math::PhiloxStream(seed, parts[p] + "." + number.key).normal(0, 0);
        each[p] += deviation * std::clamp(normal, -kMostDeviations, kMostDeviations);
        if (number.neutral == 1) each[p] = std::max(each[p], kLeastFactor);
        ++draws;
      }
    }
    const bool equal = std::ranges::all_of(each, [&](double value) { return value == each.front(); });
    built.numbers[i] = {equal && !each.empty() ? each.front() : number.neutral, {}};
    if (!equal) built.numbers[i].each = std::move(each);
  }
  return draws;
}

std::vector<ModuleBuild> module_builds(const AsBuilt& built, std::size_t modules) {
  std::vector<ModuleBuild> all;
  const auto of = [&](Number::At number, std::size_t m) { return built.numbers[number][m]; };
  for (std::size_t m = 0; m < modules; ++m) {
    all.push_back({of(Number::mass, m), of(Number::inertia, m), of(Number::foot_friction, m),
                   Vec3(of(Number::dock_x, m), of(Number::dock_y, m), of(Number::dock_z, m))});
  }
  const bool any = std::ranges::any_of(all, [](const ModuleBuild& one) { return one != ModuleBuild(); });
  return any ? all : std::vector<ModuleBuild>();
}

std::string play_key(const AsBuilt& stated, const Tolerances& tolerances) {
  const PerJoint& play = stated.numbers[Number::play];
  const bool states = play.each.empty() ? !std::isnan(play.common) && play.common != 1
                                        : std::ranges::any_of(play.each, [](double x) { return !std::isnan(x) && x != 1; });
  if (states) return std::string(kAsBuiltSection) + "." + kBuiltNumbers[Number::play].key;
  const bool drawn = tolerances.deviation[Deviation::play] > 0;
  return drawn ? std::string(kTolerancesSection) + "." + kTolerances[Deviation::play].key : "";
}

double play_build(const AsBuilt& built, std::size_t joint) { return built.numbers[Number::play][joint]; }

MotorBuild motor_build(const AsBuilt& built, std::size_t joint) {
  return {built.numbers[Number::R][joint], built.numbers[Number::Kt][joint], built.numbers[Number::gear_friction][joint],
          built.numbers[Number::supply].common};
}

bool motors_differ(const AsBuilt& built) {
  const AsBuilt drawn;
  return std::ranges::any_of(std::array{Number::R, Number::Kt, Number::gear_friction, Number::supply},
                             [&](Number::At number) { return built.numbers[number] != drawn.numbers[number]; });
}

}  // namespace gaitlab
