#include "studies/plan/worlds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "core/laws/dc_motor.h"
#include "core/math/philox.h"
#include "core/scenario/built_robot.h"
#include "core/settings/explainer.h"
#include "core/settings/wording.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

enum class Whose { ground, motors, robot };

/// A number that is not known exactly: a factor of `as_built`, and its usual error as a share.
struct Uncertain {
  const char *name, *key;
  Whose of;
  double end;                           ///< largest error
  bool both;                            ///< false if only the value below the nominal one is tried
  double DcMotor::*of_motor = nullptr;  ///< the changed constant if `of` is motors
  const char* unit = "";
  [[nodiscard]] double deviation() const {
    return end / 2;
  }  ///< standard deviation of draws, chosen so that 19 in 20 draws are within the ends
};

constexpr std::array kUncertain{
    Uncertain{"friction", "foot_friction", Whose::ground, 0.25, true},
    Uncertain{"R", "R", Whose::motors, 0.05, true, &DcMotor::R, "ohm"},
    Uncertain{"Kt", "Kt", Whose::motors, 0.05, true, &DcMotor::Kt, "N m/A"},
    Uncertain{"mass", "mass", Whose::robot, 0.03, true, nullptr, "kg"},
    Uncertain{"supply", "supply", Whose::motors, 0.1, false, &DcMotor::u_max, "V"},
};
constexpr std::int64_t kDraws = 7;
constexpr std::array kSigns{-1, 1};
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
    return number.of == Whose::robot || !driven_.empty();
  }
  [[nodiscard]] World end(const Uncertain& number, int sign) const {
    const double factor = 1 + sign * number.end;
    World world{fmt::format("{} {:+g} %", number.name, sign * 100 * number.end), text(number, factor)};
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
      const bool of_ground = one.of == Whose::ground && one_coefficient();
      const std::vector<std::string> sets =
          of_ground ? ground_times(drawn_factor(one, world.seed))
                    : std::vector{fmt::format("{}.{}={}", kTolerancesSection, one.key, number_text(one.deviation()))};
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

  static double drawn_factor(const Uncertain& number, std::int64_t seed) {
    const double normal = math::PhiloxStream(static_cast<std::uint64_t>(seed), "ground.friction").normal(0, 0);
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
    if (!has(number)) return "";
    if (number.of == Whose::robot) return shown(own_.robot->mass);
    if (number.of == Whose::ground) return shown(own_.ground.friction);
    const double first = motors()[driven_.front()].*number.of_motor;
    const auto alike = [&](std::size_t j) { return motors()[j].*number.of_motor == first; };
    return std::ranges::all_of(driven_, alike) ? shown(first) : "";
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
    for (const int sign : kSigns) {
      if (number.both || sign < 0) all.push_back(maker.end(number, sign));
    }
  }
  for (std::int64_t k = 1; k <= kDraws; ++k) all.push_back(maker.draw(k));
  return all;
}

}  // namespace gaitlab::studies
