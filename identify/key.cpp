#include "identify/key.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/laws/dc_motor.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/sections.h"
#include "core/settings/settings_numbers.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab::identify {

namespace {

constexpr double kSpread = 20;  // chosen: data sheets are wrong by factors, not by orders of magnitude
/// A key that is fitted if none is named.
struct UsualKey {
  const char* name;
  bool from_zero = false;  ///< true if 0 is a usual value
  bool of_ticks = false;   ///< true if it counts in whole control periods
};
constexpr UsualKey kUsual[] = {{"actuator.stall_torque"},           {"actuator.no_load_speed"},
                               {"actuator.rotor_inertia"},          {"actuator.dry_friction", true},
                               {"actuator.viscous_friction", true}, {"actuator.load_friction", true},
                               {"controller.latency", true, true}};

struct Number {
  std::string unit;
  PerJoint value;
  double min = 0, max = 0;  ///< range of the setting
};

/// Numbers of the bench's motor and its controller by key.
std::vector<std::pair<std::string, Number>> numbers_of(const Scenario& bench) {
  std::vector<std::pair<std::string, Number>> all;
  const auto add = [&](const std::string& section, const PluginSelection& plugin) {
    const SettingsNumbers numbers(plugin);
    for (const SettingsNumbers::Found& one : numbers.all())
      all.emplace_back(section + "." + one.key, Number{one.unit, one.value, one.min, one.max});
  };
  add("actuator", bench.actuator);
  add("controller", bench.controller);
  for (const SensorSelection& sensor : bench.sensors) add("sensors." + sensor.name, sensor.plugin);
  return all;
}

/// Numbers LOW and HIGH of a text `LOW:HIGH`, or nothing.
std::optional<std::pair<double, double>> range_of(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return {};
  const auto number = [](const std::string& one) { return read_number(Node{Node::Kind::scalar, {}, one}, ""); };
  const Reading<double> low = number(text.substr(0, colon));
  const Reading<double> high = number(text.substr(colon + 1));
  if (!low.ok() || !high.ok() || !(low.value < high.value)) return {};
  return std::pair(low.value, high.value);
}

}  // namespace

std::vector<Key> fitted_keys(const Scenario& bench, const std::vector<std::string>& asked) {
  const std::vector<std::pair<std::string, Number>> known = numbers_of(bench);
  std::vector<std::string> names;
  for (const auto& one : known) names.push_back(one.first);
  std::vector<std::string> wanted = asked;
  if (wanted.empty()) {
    for (const UsualKey& usual : kUsual) {
      if (std::ranges::find(names, usual.name) != names.end()) wanted.emplace_back(usual.name);
    }
  }
  Problems problems;
  const SourceLocation option{"--fit"};
  std::vector<Key> keys;
  for (const std::string& text : wanted) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    // The key is a number of a plugin, or KEY.JOINT for its value at one joint.
    const std::vector<std::string> joints = joint_names(*bench.robot);
    const auto of_joint = std::ranges::find_if(joints, [&](const std::string& joint) { return name.ends_with("." + joint); });
    const std::string common = of_joint == joints.end() ? name : name.substr(0, name.size() - of_joint->size() - 1);
    const auto at = std::ranges::find(known, common, [](const auto& one) { return one.first; });
    if (at == known.end()) {
      problems.add(option, fmt::format("{} is not a number of the bench's actuator, controller or sensors{}", in_quotes(name),
                                       offer(name, names, "keys")));
      continue;
    }
    if (std::ranges::find(keys, name, &Key::name) != keys.end()) {
      problems.add(option, fmt::format("{} is named twice", name));
      continue;
    }
    const PerJoint& value = at->second.value;
    const auto differs = [&](double one) { return one != value.each.front(); };
    if (of_joint == joints.end() && std::ranges::any_of(value.each, differs)) {
      problems.add(option, fmt::format("{0} differs between the joints of the bench; expected one joint, such as {0}.{1}", name,
                                       joints[0]));
      continue;
    }
    const double start = value[of_joint == joints.end() ? 0 : static_cast<std::size_t>(of_joint - joints.begin())];
    Key key{name, at->second.unit, start, start, start / kSpread, start * kSpread};
    if (name == "actuator.i_max" && key.start == 0) {  // not stated: the current at stall
      const std::unique_ptr<Actuator> motors = make_motors(bench);
      if (const DcMotor* const dc = motors->dc_motors(); dc != nullptr) key.start = dc[0].i_max;
      key.low = key.start / kSpread;
      key.high = key.start * kSpread;
    }
    const auto* const usual = std::ranges::find(kUsual, common, &UsualKey::name);
    if (usual != std::end(kUsual) && usual->from_zero) key.low = 0;
    key.low = std::max(key.low, at->second.min);
    key.high = std::min(key.high, at->second.max);
    if (usual != std::end(kUsual) && usual->of_ticks) key.least = bench.control_period;
    if (equals != std::string::npos) {
      const auto range = range_of(text.substr(equals + 1));
      if (!range) {
        problems.add(option, fmt::format("{} has the range {}; expected LOW:HIGH with LOW below HIGH", name,
                                         in_quotes(text.substr(equals + 1))));
        continue;
      }
      std::tie(key.low, key.high) = *range;
      key.start = std::clamp(key.start, key.low, key.high);
    } else if (!(key.start > 0)) {
      // From 0 the size of a usual value does not follow. A key that --fit does not name then keeps this value.
      if (!asked.empty()) {
        problems.add(option, fmt::format("{} is {} in the bench; expected a range, as in --fit {}=LOW:HIGH", name,
                                         number_text(key.start), name));
      }
      continue;
    }
    keys.push_back(std::move(key));
  }
  problems.raise();
  if (keys.empty())
    throw InputError(option, "the bench has none of the usual keys with a value above 0; name keys with --fit KEY=LOW:HIGH");
  return keys;
}

}  // namespace gaitlab::identify
