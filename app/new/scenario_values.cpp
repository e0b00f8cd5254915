#include "app/new/scenario_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/laws/contact.h"
#include "core/model/outline.h"
#include "core/settings/wording.h"
#include "report/analysis/envelope.h"

namespace gaitlab::app {

namespace {

constexpr double kGravity = 9.81;    // m/s^2
constexpr double kMotorShare = 0.5;  // share of a motor's torque at rest and of its no-load speed

using PerHinge = std::vector<std::pair<std::string, double>>;

/// Value of a key per joint: `default` for all hinges, and the values of some hinges by their names.
std::string per_hinge(double common, const PerHinge& others) {
  if (others.empty()) return number_text(common);
  std::string text = "{default: " + number_text(common);
  for (const auto& [hinge, value] : others) text += fmt::format(", \"*/{}\": {}", hinge, number_text(value));
  return text + "}";
}

/// True for a hinge that moves in the gait: it has a motor and a range, or no hinge with a motor has a range.
bool swings(const ModuleType& type, const HingeType& hinge) {
  const auto limited = [](const HingeType& one) { return !one.passive && one.hi != kNoStop; };
  return !hinge.passive && (hinge.hi != kNoStop || std::ranges::none_of(type.hinges, limited));
}

/// Smallest value of a property of the motors that move in the gait; nothing if no motor has it.
std::optional<double> least_of_motors(const Scenario& one, std::optional<double> report::Envelope::*property) {
  const report::Motors known = report::motors(one, 0);
  std::optional<double> least;
  for (const HingeType& hinge : one.robot->types[0].hinges) {
    const auto joint = std::ranges::find(one.robot->joints, "m0/" + hinge.name, &Joint::name);
    if (known.of_joint.empty() || !swings(one.robot->types[0], hinge)) continue;
    const std::optional<double> value = known.joint(static_cast<std::size_t>(joint - one.robot->joints.begin())).*property;
    if (value && *value > 0) least = std::min(*value, least.value_or(*value));
  }
  return least;
}

/// Rounds down to two digits.
double two_digits_down(double value) {
  constexpr double kRounding = 1e-9;  // keeps 0.5 at 0.5
  const double per_one = std::pow(10, 1 - std::floor(std::log10(value)));
  return std::floor(value * per_one + kRounding) / per_one;
}

double mass_of(const ModuleType& type) {
  double mass = 0;
  for (const BodyType& body : type.bodies) mass += body.mass;
  return mass;
}

/// Stiffness and damping of a ground on which four contact elements (or all, if there are fewer) sink by at most 1 mm under
/// the robot. Empty if the default is stiff enough.
std::string stiffer(const ModuleType& type, int modules) {
  constexpr double kSink = 1e-3;  // m
  constexpr std::size_t kFeet = 4;
  const PenaltyContact usual;
  const std::size_t elements = std::max(type.all.size(), type.feet.size());
  const double force = modules * mass_of(type) * kGravity / static_cast<double>(std::min(kFeet, elements));
  const double times = force / usual.spring(kSink);
  if (!(times > 1)) return "";
  const double rounded = std::ceil(times);
  return fmt::format(
      "  stiffness: {}       # N/m: the standing robot sinks in by less than 1 mm\n  damping: {}        # N s/m^2\n",
      number_text(rounded * usual.kn), number_text(rounded * usual.cd));
}

}  // namespace

int modules_carried(const Scenario& one, int most) {
  const std::optional<double> torque = least_of_motors(one, &report::Envelope::rest);
  const double bend = mass_of(one.robot->types[0]) * kGravity * outline_edges(*one.robot).maxCoeff() / 8;  // of one module
  if (!torque || !(bend > 0)) return most;
  return std::max(1, static_cast<int>(std::min<double>(most, std::sqrt(kMotorShare * *torque / bend))));
}

GaitValues gait_values(const Scenario& one, double amplitude) {
  constexpr double kFrequency = 0.5;  // Hz
  constexpr double kShare = 0.8;      // share of half the range, if the range is narrow
  constexpr double kDigits = 1000;    // values are rounded to 0.001 rad
  constexpr double kPeriods = 4;      // one to start, and three that are judged
  const ModuleType& type = one.robot->types[0];
  PerHinge amplitudes, offsets, angles;
  for (const HingeType& hinge : type.hinges) {
    if (!hinge.passive && !swings(type, hinge)) amplitudes.emplace_back(hinge.name, 0);
    if (hinge.hi == kNoStop || (hinge.lo <= -amplitude && hinge.hi >= amplitude)) continue;
    const double middle = std::round((hinge.lo + hinge.hi) / 2 * kDigits) / kDigits;
    const double half = std::min(middle - hinge.lo, hinge.hi - middle);
    angles.emplace_back(hinge.name, middle);
    if (hinge.passive) continue;
    offsets.emplace_back(hinge.name, middle);
    amplitudes.emplace_back(hinge.name, std::min(amplitude, std::floor(kShare * half * kDigits) / kDigits));
  }
  double frequency = kFrequency;
  if (const std::optional<double> speed = least_of_motors(one, &report::Envelope::no_load))
    frequency = std::min(frequency, two_digits_down(kMotorShare * *speed / (2 * std::numbers::pi * amplitude)));
  return {number_text(frequency), per_hinge(amplitude, amplitudes), per_hinge(0, offsets), per_hinge(0, angles),
          number_text(std::ceil(kPeriods / frequency))};
}

Surroundings surroundings(const ModuleType& type, int modules) {
  const bool touches = !type.all.empty() || !type.feet.empty();
  const Base base = modules > 1 ? Base::floating : type.base;
  std::string base_text;
  if (base != Base::floating) {
    base_text = fmt::format("  base: {:<19}# that of the module\n", name_of(base));
  } else if (!touches) {
    base_text = "  base: fixed              # the module has no contact elements, so that it would fall\n";
  }
  if (!touches) return {base_text, "ground: {type: none}\ncontact: {on: none}\n"};
  const char* const on = type.all.empty()
                             ? "  on: feet                 # the module has elements only at its feet; all: every element\n"
                             : "  on: all                  # every contact element of the module; feet: those of its feet\n";
  return {base_text, std::string("ground:\n  friction: 0.8            # coefficient between robot and ground\ncontact:\n") +
                         on + stiffer(type, modules)};
}

}  // namespace gaitlab::app
