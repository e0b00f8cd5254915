#include "kit/recorded_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace gaitlab::kit {

std::vector<std::string> recorded_settings(const Scenario& s, const std::vector<double>& set_points, const Initial& start,
                                           double period) {
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
  return {fmt::format("cpg={{type: table, model: {{interpolation: hold, repeat: false, cycle: {}, file: \"{}\\n\"}}}}", period,
                      table),
          fmt::format("initial={{angles: {}, speeds: {}, base_velocity: {}, base_angular_velocity: {}}}",
                      list(of_joints(start.angles)), list(of_joints(start.speeds)), vector(start.base_velocity),
                      vector(start.base_angular_velocity)),
          fmt::format("duration={}", static_cast<double>(rows) * s.control_period)};
}

}  // namespace gaitlab::kit
