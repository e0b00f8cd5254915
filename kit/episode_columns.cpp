#include "kit/episode_columns.h"

#include <fmt/format.h>

#include "core/plugin/plugin_instance.h"
#include "core/scenario/sections.h"
#include "core/scenario/sensor_section.h"

namespace gaitlab::kit {

namespace {

void add(std::vector<EpisodeColumn>& columns, const std::string& quantity, const std::vector<std::string>& parts,
         const char* unit) {
  for (const std::string& part : parts) columns.push_back({quantity + "." + part, unit});
}

}  // namespace

std::vector<EpisodeColumn> observed_columns(const Scenario& s) {
  const RobotInfo info = plugin_info(s);
  const std::vector<std::string> joints = joint_names(*s.robot);
  std::vector<std::string> modules;
  for (std::size_t m = 0; m < info.modules.size(); ++m) modules.push_back(fmt::format("m{}", m));
  std::vector<EpisodeColumn> columns;
  add(columns, "angle", joints, "rad");
  add(columns, "speed", joints, "rad/s");
  add(columns, "torque", joints, "N m");
  add(columns, "load", joints, "N");
  add(columns, "touching", modules, "");
  for (const auto& sensor : make_sensors(s)) {
    for (const SensorReading& reading : sensor->readings()) {
      if (reading.replaces == Replaces::nothing) columns.push_back({reading.name, reading.unit});
    }
  }
  return columns;
}

std::vector<EpisodeColumn> columns_of_truth(const std::vector<Leg>& legs) {
  std::vector<EpisodeColumn> columns;
  const std::vector<std::string> axes{"x", "y", "z"};
  add(columns, "base.position", axes, "m");
  add(columns, "base.rotation", {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"}, "");
  add(columns, "base.velocity", axes, "m/s");
  add(columns, "base.angular_velocity", axes, "rad/s");
  columns.push_back({"energy", "J"});
  columns.push_back({"time", "s"});
  for (const Leg& leg : legs) columns.push_back({"leg.load." + leg.name, "N"});
  return columns;
}

}  // namespace gaitlab::kit
