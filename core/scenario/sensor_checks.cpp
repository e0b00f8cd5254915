#include "core/scenario/sensor_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/model/pattern.h"
#include "core/scenario/sections.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/periods.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

/// Visitor of the fields of a sensor, which checks names and times.
class KeyChecks final : public Fields {
 public:
  /// `node` is the map that the fields were read from, or null if it is absent.
  KeyChecks(const Node* node, const Scenario& scenario, Problems& problems)
      : node_(node), scenario_(scenario), problems_(problems) {}

  void visit(const Field& field) override {
    const Node* given = node_ == nullptr ? nullptr : node_->find(field.key);
    if (given == nullptr) return;  // defaults are correct for every robot and control period
    if (const auto* names = std::get_if<field::Names>(&field.value)) check(*given, *names);
    if (const auto* periods = std::get_if<field::Periods>(&field.value)) check(*given, field.key, *periods);
    if (const auto* group = std::get_if<field::Group>(&field.value)) {
      KeyChecks inner(given, scenario_, problems_);
      group->visit(group->self, inner);
    }
  }
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

 private:
  void check(const Node& given, const field::Names& field) {
    if (field.among == Among::words || !scenario_.robot) return;
    const std::vector<std::string> known = names_of(field.among);
    for (std::size_t i = 0; i < field.value.size(); ++i) {
      const std::string wrong = problem_of(field.value[i], field, known);
      // A group of joints expands to several values.
      const bool same = given.kind == Node::Kind::list && given.items.size() == field.value.size();
      if (!wrong.empty()) problems_.add(same ? given.items[i].place : given.place, wrong);
    }
  }

  [[nodiscard]] std::vector<std::string> names_of(Among among) const {
    const Robot& robot = *scenario_.robot;
    std::vector<std::string> names;
    if (among == Among::modules) {
      for (std::size_t m = 0; m < robot.modules.size(); ++m) names.push_back(fmt::format("m{}", m));
    } else if (among == Among::bodies) {
      for (const Body& body : robot.bodies) names.push_back(body.name);
    } else {
      for (const Joint& joint : robot.joints) names.push_back(joint.name);
    }
    return names;
  }

  /// The message for a name, or "" if it is correct.
  [[nodiscard]] std::string problem_of(const std::string& text, const field::Names& field,
                                       const std::vector<std::string>& known) const {
    if (field.one && group_named(text, scenario_.groups) != nullptr)
      return in_quotes(text) + " is a group; expected the name of one " + noun(field.among);
    if (field.one && is_pattern(text)) return in_quotes(text) + " is a pattern; expected the name of one " + noun(field.among);
    const std::vector<std::size_t> meant = joints_of(text, known);
    if (meant.empty() && (field.among == Among::joints || field.among == Among::motors))
      return no_joint(text, known, "joint", scenario_.groups);
    if (meant.empty()) {
      return fmt::format("no {}{} {}{}", noun(field.among), is_pattern(text) ? " matches" : "", in_quotes(text),
                         offer(text, known, field.among == Among::bodies ? "bodies" : "modules"));
    }
    const auto driven = [&](std::size_t joint) { return scenario_.robot->joints[joint].driven(); };
    if (field.among != Among::motors || std::ranges::any_of(meant, driven)) return "";
    return is_pattern(text) ? "no joint that matches " + in_quotes(text) + " has a motor"
                            : "joint " + in_quotes(text) + " has no motor (drive: none)";
  }

  void check(const Node& given, const char* key, const field::Periods& field) {
    check(given.kind == Node::Kind::list ? given.items[0] : given, key, field.value);
    if (field.most != nullptr && given.kind == Node::Kind::list) check(given.items[1], key, *field.most);
  }

  void check(const Node& given, const char* key, double time) {
    const double period = scenario_.control_period;
    if (time == 0 || !(period > 0) || is_multiple(time, period)) return;
    const auto list = [](const std::vector<double>& values) {
      std::vector<std::string> texts;
      for (const double value : values) texts.push_back(number_text(value));
      return fmt::format("{}", fmt::join(texts, " or "));
    };
    problems_.add(given.place, fmt::format("{} is {} s; expected a whole multiple of the control period {} s: {}: {}, or "
                                           "controller.period: {}",
                                           key, number_text(time), number_text(period), key,
                                           list(fitting_periods(time, period)), list(fitting_steps({time}, period))));
  }

  const Node* node_;
  const Scenario& scenario_;
  Problems& problems_;
};

/// Words for the value that two sensors would replace, such as `the angle of joint 'm0/active'`, or for their column.
std::string measured_value(const SensorReading& reading, const Robot& robot) {
  if (reading.replaces == Replaces::nothing) return "column " + in_quotes(reading.column);
  constexpr std::string_view kQuantities[] = {"", "angle", "speed", "torque", "load", "load"};
  const bool module = reading.replaces == Replaces::touching;
  return fmt::format("the {} of {} {}", kQuantities[static_cast<std::size_t>(reading.replaces)], module ? "module" : "joint",
                     in_quotes(module ? fmt::format("m{}", reading.part) : robot.joints[reading.part].name));
}

void check_values(const std::vector<PlacedSensor>& sensors, const Robot& robot, Problems& problems) {
  std::map<std::string, const PlacedSensor*> owners;
  for (const PlacedSensor& one : sensors) {
    const PlacedSensor* told = nullptr;
    for (const SensorReading& reading : one.sensor->readings()) {
      const PlacedSensor* owner = owners.emplace(measured_value(reading, robot), &one).first->second;
      if (owner == &one || owner == told) continue;
      told = owner;  // one message for two sensors
      problems
          .add(one.place, fmt::format("{} has two sensors, {} and {}; expected one", measured_value(reading, robot),
                                      in_quotes(owner->selection.name), in_quotes(one.selection.name)))
          .notes.emplace_back(owner->place, in_quotes(owner->selection.name) + " is here");
    }
  }
}

void check_streams(const std::vector<PlacedSensor>& sensors, Problems& problems) {
  std::map<std::uint32_t, std::pair<std::string, const PlacedSensor*>> owners;
  for (const PlacedSensor& one : sensors) {
    for (const SensorStream& stream : one.sensor->streams()) {
      const auto [at, fresh] = owners.emplace(stream.hash, std::pair(stream.name, &one));
      if (fresh) continue;
      problems
          .add(one.place,
               fmt::format("the channels {} and {} have the same hash (FNV-1a, {:08x}) and would have the same noise; "
                           "rename a sensor",
                           in_quotes(at->second.first), in_quotes(stream.name), stream.hash))
          .notes.emplace_back(at->second.second->place, in_quotes(at->second.first) + " is here");
    }
  }
}

}  // namespace

void check_keys(const Node& node, const PluginSelection& plugin, const Scenario& scenario, Problems& problems) {
  KeyChecks checks(&node, scenario, problems);
  visit_settings(*plugin.entry, plugin.settings.get(), checks);
}

void check_names_and_times(const Node& node, const std::function<void(Fields&)>& visit, const Scenario& scenario,
                           Problems& problems) {
  KeyChecks checks(&node, scenario, problems);
  visit(checks);
}

void check_sensors(const std::vector<PlacedSensor>& sensors, const Scenario& scenario, Problems& problems) {
  const auto of_motor = [](const SensorReading& reading) { return reading.replaces == Replaces::torque; };
  for (const PlacedSensor& one : sensors) {
    const bool motors = one.sensor->needs_current() || std::ranges::any_of(one.sensor->readings(), of_motor);
    if (motors && scenario.actuator.entry == nullptr) {
      problems.add(one.place, fmt::format("sensor {} measures motors, but the robot has none (actuator.type: none); remove it",
                                          in_quotes(one.selection.name)));
    }
    if (!one.sensor->readings().empty()) continue;
    problems.add(one.place, fmt::format("sensor {} measures nothing: it has no parts or no quantities to measure; remove it",
                                        in_quotes(one.selection.name)));
  }
  check_values(sensors, *scenario.robot, problems);
  check_streams(sensors, problems);
}

}  // namespace gaitlab
