#include "core/scenario/sensor_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/model/legs.h"
#include "core/plugin/plugin_instance.h"
#include "core/scenario/sections.h"
#include "core/scenario/sensor_checks.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"

namespace gaitlab {
namespace {

constexpr const char* kType = "type";
constexpr const char* kExpected = "a map of sensors by name, such as {imu: {type: imu, body: m0/active}}, or {} for none";

SensorSite site(const Scenario& scenario, const RobotInfo& robot, const std::string& name) {
  return {robot, name, static_cast<std::uint64_t>(scenario.seed), scenario.control_period};
}

/// The sensor as a section of a plugin, with its type and its keys.
PluginFields fields_of(SensorSelection& sensor, const Catalog* catalog) {
  return {Kind::sensor, sensor.plugin, describe(Kind::sensor).default_type, catalog};
}

class SensorReader {
 public:
  SensorReader(const Scenario& scenario, const Catalog& catalog, JointNames joints, Problems& problems)
      : scenario_(scenario), catalog_(catalog), joints_(joints), problems_(problems) {}

  void read(const std::string& name, const SourceLocation& place, const Node& node) {
    if (!is_name(name, "_-") || !std::isalpha(static_cast<unsigned char>(name[0])) || name == kType) {
      problems_.add(place,
                    fmt::format("{} is not a name of a sensor; expected a letter, then letters, digits, `_` and `-`, but not "
                                "`{}`",
                                in_quotes(name), kType));
      return;
    }
    SensorSelection sensor{name, {}};
    Reader reader(node, "sensors." + name, problems_, joints_);
    reader.groups(scenario_.groups);
    if (node.kind != Node::Kind::map) return;
    if (!reader.has(kType)) {
      problems_.add(node.place, fmt::format("sensor {} has no key '{}'; known types: {}", in_quotes(name), kType,
                                            joined(catalog_.names(Kind::sensor))));
      return;
    }
    PluginFields fields = fields_of(sensor, &catalog_);
    fields.problems = &problems_;
    fields.fields(reader);
    reader.finish();
    if (!fields.sound || sensor.plugin.entry == nullptr) return;
    check_keys(node, sensor.plugin, scenario_, problems_);
    found_.push_back({std::move(sensor), place});
  }

  /// Returns the sensors after checking them together. Empty if there is no robot, or if problems were added after `before`.
  std::vector<SensorSelection> take(std::size_t before) {
    if (problems_.size() == before && scenario_.robot) check_together();
    std::vector<SensorSelection> sensors;
    if (problems_.size() > before || !scenario_.robot) return sensors;
    for (PlacedSensor& one : found_) sensors.push_back(std::move(one.selection));
    return sensors;
  }

 private:
  void check_together() try {
    const RobotInfo robot = info(*scenario_.robot);
    for (PlacedSensor& one : found_) one.sensor = make_sensor(one.selection.plugin, site(scenario_, robot, one.selection.name));
    check_sensors(found_, scenario_, problems_);
  } catch (const PluginError& error) {
    problems_.add(found_.front().place, error.what());
  }

  const Scenario& scenario_;
  const Catalog& catalog_;
  JointNames joints_;
  Problems& problems_;
  std::vector<PlacedSensor> found_;
};

}  // namespace

std::vector<SensorSelection> read_sensors(const Node* node, const Scenario& scenario, const Catalog& catalog, JointNames joints,
                                          Problems& problems) {
  if (node == nullptr) return {};
  const bool list = node->kind == Node::Kind::list;
  if (list && node->items.empty()) return {};
  if (node->kind != Node::Kind::map) {
    problems.add(node->place, fmt::format("sensors is {}; expected {}",
                                          list ? fmt::format("a list of {}", node->items.size()) : found(*node), kExpected));
    return {};
  }
  const std::size_t before = problems.size();
  SensorReader reader(scenario, catalog, joints, problems);
  if (const Node* type = node->find(kType); type != nullptr && type->kind == Node::Kind::scalar) {
    reader.read(catalog.find(Kind::sensor, type->text) == nullptr ? "sensor" : type->text, node->place, *node);
  } else {
    for (std::size_t i = 0; i < node->keys.size(); ++i) reader.read(node->keys[i].first, node->keys[i].second, node->items[i]);
  }
  return reader.take(before);
}

Node sensors_node(const Scenario& scenario, const std::vector<std::string>& joints) {
  Node none{Node::Kind::list};
  none.flow = true;
  if (scenario.sensors.empty()) return none;
  Writer all(joints);
  for (SensorSelection sensor : scenario.sensors) {
    Writer one(joints);
    fields_of(sensor, nullptr).fields(one);
    all.add(sensor.name, one.take());
  }
  return all.take();
}

std::vector<std::unique_ptr<Sensor>> make_sensors(const Scenario& scenario) {
  std::vector<std::unique_ptr<Sensor>> sensors;
  if (scenario.sensors.empty()) return sensors;
  const RobotInfo robot = info(*scenario.robot);
  for (const SensorSelection& one : scenario.sensors) {
    sensors.push_back(make_sensor(one.plugin, site(scenario, robot, one.name)));
  }
  return sensors;
}

std::vector<SensorReading> sensor_readings(const Scenario& scenario) {
  std::vector<SensorReading> all;
  for (const auto& sensor : make_sensors(scenario)) {
    all.insert(all.end(), sensor->readings().begin(), sensor->readings().end());
  }
  return all;
}

bool quantised(const Scenario& scenario) {
  return std::ranges::any_of(make_sensors(scenario), [](const auto& sensor) { return sensor->quantises(); });
}

bool seed_matters(const Scenario& scenario) {
  const auto loses = [](const JointFault& fault) {
    return fault.kind == FaultKind::lost && fault.share > 0 && fault.share < 1;
  };
  const auto draws = [&](const Change& change) { return std::ranges::any_of(change.faults, loses); };
  return scenario.drawn > 0 || std::ranges::any_of(scenario.changes, draws) ||
         std::ranges::any_of(make_sensors(scenario), [](const auto& sensor) { return sensor->draws(); });
}

std::vector<std::string> default_columns(const Scenario& scenario) {
  std::vector<std::string> columns = TraceSettings().columns;
  const std::vector<SensorReading> readings = sensor_readings(scenario);
  const auto of_no_joint = [](const SensorReading& reading) { return reading.column.starts_with("sensor."); };
  if (std::ranges::any_of(readings, of_no_joint)) columns.emplace_back("sensor.*");
  if (!scenario.changes.empty()) columns.emplace_back("segment");
  return columns;
}

RobotInfo plugin_info(const Scenario& scenario) {
  RobotInfo robot = info(*scenario.robot);
  robot.control_period = scenario.control_period;
  std::vector<double> start(robot.joints.size());
  for (std::size_t j = 0; j < start.size(); ++j) {
    JointInfo& joint = robot.joints[j];
    if (scenario.initial.stated) joint.start = scenario.initial.angles[j];
    start[j] = std::clamp(joint.start, joint.lo, joint.hi);
  }
  const Mat3 base = rpy(scenario.orientation);
  robot.up = {base(2, 0), base(2, 1), base(2, 2)};
  robot.start_stated = scenario.initial.stated;
  robot.legs = legs_of(*scenario.robot, start, base);
  for (SensorReading& reading : sensor_readings(scenario)) {
    if (reading.replaces == Replaces::nothing) robot.channels.push_back(std::move(reading.name));
  }
  return robot;
}

}  // namespace gaitlab
