#include "kit/recorded_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/scenario/sections.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/node.h"

namespace gaitlab::kit {

namespace {

/// Points of a value that is held from tick to tick: at each change the old value at the tick before, and the new one.
std::string points(const Recorded& episode, std::size_t column, double control_period) {
  const std::size_t width = episode.steering.size();
  std::string all;
  std::size_t last = 0;
  for (std::size_t k = 0; k * width < episode.steered.size(); ++k) {
    const double value = episode.steered[k * width + column];
    const double before = episode.steered[(k == 0 ? 0 : k - 1) * width + column];
    if (k > 0 && value == before) continue;
    const auto add = [&](std::size_t tick, double v) {
      all += fmt::format("{}[{}, {}]", all.empty() ? "" : ", ", static_cast<double>(tick) * control_period, v);
    };
    if (k > last + 1) add(k - 1, before);
    add(k, value);
    last = k;
  }
  return "points: [" + all + "]";
}

void put_on_one_line(Node& node) {
  node.flow = true;
  for (Node& item : node.items) put_on_one_line(item);
}

/// Section `sensors` with the values that were sent.
std::string steered_sensors(const Scenario& s, const Recorded& episode) {
  Node sensors = sensors_node(s, joint_names(*s.robot));
  for (std::size_t i = 0; i < sensors.keys.size(); ++i) {
    for (std::size_t k = 0; k < sensors.items[i].keys.size(); ++k) {
      if (sensors.items[i].keys[k].first != "values") continue;
      Node& values = sensors.items[i].items[k];
      for (std::size_t v = 0; v < values.keys.size(); ++v) {
        const auto at = std::ranges::find(episode.steering, sensors.keys[i].first + "." + values.keys[v].first);
        if (at == episode.steering.end()) continue;
        Node sent =
            parse_yaml(points(episode, static_cast<std::size_t>(at - episode.steering.begin()), s.control_period), "run");
        if (const Node* const unit = values.items[v].find("unit")) {
          sent.keys.emplace_back("unit", SourceLocation{});
          sent.items.push_back(*unit);
        }
        values.items[v] = std::move(sent);
      }
    }
  }
  put_on_one_line(sensors);
  std::string text = print_yaml(sensors);
  while (text.ends_with('\n')) text.pop_back();
  return "sensors=" + text;
}

}  // namespace

std::vector<std::string> recorded_settings(const Scenario& s, const Recorded& episode, double period) {
  const auto& [set_points, steering, steered, start] = episode;
  constexpr std::size_t kMost = 40000;  // numbers; a YAML text has at most 1 MB
  const auto refuse_set_points = [](const std::string& what) { throw InputError(SourceLocation{"run"}, what); };
  const std::size_t joints = s.robot->joints.size();
  const std::size_t rows = set_points.size() / joints;
  if (rows == 0) refuse_set_points("the episode has no set points; expected at least one step with record=True");
  if (set_points.size() > kMost) {
    refuse_set_points(fmt::format("the episode has {} set points; a scenario contains at most {}: end it after {:.4g} s",
                                  set_points.size(), kMost,
                                  std::floor(static_cast<double>(kMost) / static_cast<double>(joints)) * s.control_period));
  }
  for (const Change& change : s.changes) {
    const auto of_cpg = [](const auto& key) { return key.first == "cpg" || key.first.starts_with("cpg."); };
    if (std::ranges::any_of(change.set.keys, of_cpg)) {
      refuse_set_points(
          fmt::format("the CPG changes at {} s (section `at`); set points that are recorded replace it", change.t));
    }
  }
  std::string table = "time";
  for (std::size_t j = 0; j < joints; ++j) {
    if (s.robot->joints[j].driven()) table += "," + s.robot->joints[j].name;
  }
  // The last set points hold for a period; a table of one row needs a second one.
  for (std::size_t k = 0; k <= rows; ++k) {
    table += fmt::format("\\n{}", static_cast<double>(k) * s.control_period);
    for (std::size_t j = 0; j < joints; ++j) {
      if (s.robot->joints[j].driven()) table += fmt::format(",{}", set_points[std::min(k, rows - 1) * joints + j]);
    }
  }
  const auto list = [](const auto& numbers) { return fmt::format("[{}]", fmt::join(numbers, ", ")); };
  const auto of_joints = [&](const PerJoint& values) {
    std::vector<double> all;
    for (std::size_t j = 0; j < joints; ++j) all.push_back(values[j]);
    return all;
  };
  const auto vector = [&](const Vec3& v) { return list(std::vector<double>(v.data(), v.data() + 3)); };
  std::vector<std::string> sets{
      fmt::format("cpg={{type: table, model: {{interpolation: hold, repeat: false, cycle: {}, file: \"{}\\n\"}}}}", period,
                  table),
      fmt::format("initial={{angles: {}, speeds: {}, base_velocity: {}, base_angular_velocity: {}}}",
                  list(of_joints(start.angles)), list(of_joints(start.speeds)), vector(start.base_velocity),
                  vector(start.base_angular_velocity)),
      fmt::format("duration={}", static_cast<double>(rows) * s.control_period)};
  if (!steering.empty()) sets.push_back(steered_sensors(s, episode));
  return sets;
}

}  // namespace gaitlab::kit
