#include "studies/plan/worlds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "core/laws/data_sheet.h"
#include "core/laws/dc_motor.h"
#include "core/math/philox.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/chosen_friction.h"
#include "core/settings/explainer.h"
#include "core/settings/wording.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

enum class Whose { ground, motors, robot, gears, rotors };

/// A number that is not known exactly, and its usual errors as shares: a factor of `as_built` or, for rotors, a key of the
/// actuator.
struct Uncertain {
  const char *name, *key;
  Whose of;
  double below, above;                  ///< largest errors; 0 if that end is not tried
  double DcMotor::*of_motor = nullptr;  ///< the changed constant if `of` is motors
  const char* unit = "";
  [[nodiscard]] double deviation() const {
    return below / 2;
  }  ///< standard deviation of draws, chosen so that 19 in 20 draws are within the ends
};

constexpr std::array kUncertain{
    Uncertain{"friction", "foot_friction", Whose::ground, 0.25, 0.25},
    Uncertain{"R", "R", Whose::motors, 0.05, 0.05, &DcMotor::R, "ohm"},
    Uncertain{"Kt", "Kt", Whose::motors, 0.05, 0.05, &DcMotor::Kt, "N m/A"},
    Uncertain{"mass", "mass", Whose::robot, 0.03, 0.03, nullptr, "kg"},
    Uncertain{"supply", "supply", Whose::motors, 0.1, 0, &DcMotor::u_max, "V"},
    Uncertain{"gear friction", "gear_friction", Whose::gears, 0.5, 1},
    Uncertain{"rotor inertia", "rotor_inertia", Whose::rotors, 0.5, 1, nullptr, "kg m^2"},
};
constexpr std::int64_t kDraws = 7;
constexpr double kMostDeviations = 3;  // limit of a draw, the same as for tolerances

/// Makes the worlds of a scenario from its robot, motors and ground.
class WorldMaker {
 public:
  explicit WorldMaker(const Scenario& own) : own_(own), actuator_(own.actuator.entry == nullptr ? nullptr : make_motors(own)) {
    for (std::size_t j = 0; j < own.robot->joints.size() && motors() != nullptr; ++j) {
      if (own.robot->joints[j].driven()) driven_.push_back(j);
    }
    if (directional()) gears_ = {"actuator.efficiency_model=directional"};
  }

  [[nodiscard]] bool has(const Uncertain& number) const {
    if (number.of == Whose::ground) return own_.ground.exists() && own_.contact.on != ContactSet::none;
    if (number.of == Whose::robot) return true;
    if (driven_.empty()) return false;
    if (number.of == Whose::rotors) return !times_chosen(own_, number.key, 1).empty();
    return number.of == Whose::motors || chosen_gears();
  }
  [[nodiscard]] World end(const Uncertain& number, double error) const {
    const double factor = 1 + error;
    World world{fmt::format("{} {:+g} %", number.name, 100 * error), text(number, factor)};
    world.seed = own_.seed;
    world.applies = has(number);
    if (world.applies) world.sets = times(number, factor);
    world.sets.insert(world.sets.end(), gears_.begin(), gears_.end());
    return world;
  }
  [[nodiscard]] World draw(std::int64_t number) const {
    World world{fmt::format("draw {}", number)};
    world.seed = own_.seed + number;
    world.number = fmt::format("seed {}", world.seed);
    world.drawn = true;
    for (const Uncertain& one : kUncertain) {
      if (own_.tolerances.any() || !has(one)) continue;
      const bool by_tolerance = one.of != Whose::rotors && !(one.of == Whose::ground && one_coefficient());
      const std::vector<std::string> sets =
          by_tolerance ? std::vector{fmt::format("{}.{}={}", kTolerancesSection, one.key, number_text(one.deviation()))}
                       : times(one, drawn_factor(one, world.seed));
      world.sets.insert(world.sets.end(), sets.begin(), sets.end());
    }
    world.sets.push_back(fmt::format("seed={}", world.seed));
    world.sets.insert(world.sets.end(), gears_.begin(), gears_.end());
    return world;
  }

 private:
  [[nodiscard]] const DcMotor* motors() const { return actuator_ == nullptr ? nullptr : actuator_->dc_motors(); }
  /// True if the contact law has one coefficient of friction for each solid, and none for the parts of the robot.
  [[nodiscard]] bool one_coefficient() const { return !own_.contact.model().penalty_settings; }

  /// True if the actuator has an efficiency model and no efficiency is 0, because the directional model divides by it.
  [[nodiscard]] bool directional() const {
    if (driven_.empty()) return false;
    Explainer settings;
    visit_settings(*own_.actuator.entry, default_settings(*own_.actuator.entry).get(), settings);
    const bool has_key = std::ranges::find(settings.keys(), "efficiency_model") != settings.keys().end();
    return has_key && std::ranges::all_of(driven_, [&](std::size_t j) { return motors()[j].efficiency > 0; });
  }

  /// True if some friction of the gears is chosen, and none takes all of the torque where it is twice as large.
  [[nodiscard]] bool chosen_gears() const {
    const auto chosen = [&](const char* key) { return !times_chosen(own_, key, 1).empty(); };
    const auto turns = [&](std::size_t j) { return 2 * load_of_efficiency(motors()[j].load) < 1; };
    return std::ranges::any_of(std::array{"dry_friction", "viscous_friction", "load_friction"}, chosen) &&
           std::ranges::all_of(driven_, turns);
  }

  static double drawn_factor(const Uncertain& number, std::int64_t seed) {
    const char* const stream = number.of == Whose::ground ? "ground.friction" : "actuator.rotor_inertia";
    const double normal = math::PhiloxStream(static_cast<std::uint64_t>(seed), stream).normal(0, 0);
    return 1 + number.deviation() * std::clamp(normal, -kMostDeviations, kMostDeviations);
  }

  [[nodiscard]] std::vector<std::string> ground_times(double factor) const {
    std::vector<std::string> sets{"ground.friction=" + number_text(own_.ground.friction * factor)};
    const Boxes& boxes = own_.ground.boxes();
    for (std::size_t i = 0; i < boxes.size(); ++i)
      sets.push_back(fmt::format("ground.boxes.{}.friction={}", i, number_text(boxes[i].friction * factor)));
    return sets;
  }

  [[nodiscard]] std::vector<std::string> times(const Uncertain& number, double factor) const {
    if (number.of == Whose::ground && one_coefficient()) return ground_times(factor);
    if (number.of == Whose::rotors) return {times_chosen(own_, number.key, factor)};
    const auto at = std::ranges::find(kBuiltNumbers, std::string_view(number.key), &BuiltNumber::key);
    const std::vector<std::string> parts = parts_with(*at, *own_.robot);
    const PerJoint& built = own_.as_built.numbers[static_cast<std::size_t>(at - kBuiltNumbers.begin())];
    std::vector<std::string> values;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const double value = parts[p].empty() ? at->neutral : std::clamp(built[p] * factor, at->spec.min, at->spec.max);
      values.push_back(number_text(value));
    }
    const bool alike = built.each.empty();
    const std::string all = number_text(std::clamp(built.common * factor, at->spec.min, at->spec.max));
    return {fmt::format("{}.{}={}", kAsBuiltSection, number.key, alike ? all : fmt::format("[{}]", fmt::join(values, ", ")))};
  }

  /// The changed number with its unit; "" if it differs from part to part.
  [[nodiscard]] std::string text(const Uncertain& number, double factor) const {
    const auto shown = [&](double value) { return with_unit(rounded(value * factor), number.unit); };
    if (!has(number) || number.of == Whose::gears) return "";  // gears have three numbers
    if (number.of == Whose::robot) return shown(own_.robot->mass);
    if (number.of == Whose::ground) return shown(own_.ground.friction);
    const auto value = [&](std::size_t j) {
      return number.of == Whose::rotors ? actuator_->reflected_inertia()[j] : motors()[j].*number.of_motor;
    };
    const double first = value(driven_.front());
    return std::ranges::all_of(driven_, [&](std::size_t j) { return value(j) == first; }) ? shown(first) : "";
  }
  static double rounded(double value) { return number_of(fmt::format("{:.3g}", value)); }

  const Scenario& own_;
  std::unique_ptr<Actuator> actuator_;
  std::vector<std::size_t> driven_;  ///< joints with a DC motor
  std::vector<std::string> gears_;
};

}  // namespace

std::string World::text() const { return number.empty() ? name : fmt::format("{} ({})", name, number); }

std::vector<World> worlds(const Scenario& own) {
  const WorldMaker maker(own);
  std::vector<World> all;
  for (const Uncertain& number : kUncertain) {
    all.push_back(maker.end(number, -number.below));
    if (number.above > 0) all.push_back(maker.end(number, number.above));
  }
  for (std::int64_t k = 1; k <= kDraws; ++k) all.push_back(maker.draw(k));
  return all;
}

}  // namespace gaitlab::studies
