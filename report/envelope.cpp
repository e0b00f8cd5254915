#include "report/envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/plugin/plugin_instance.h"
#include "core/plugin/robot_info.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kSpeeds = 121;  // of a curve; odd: rest is among them
constexpr double kFastest = 1e5;      // rad/s: no joint turns faster
constexpr int kHalvings = 60;         // until nothing is left between the two bounds

/// All joints' motors under the largest command of one sign, each at a speed of its own.
class FullCommand {
 public:
  FullCommand(const Actuator& actuator, std::size_t joints) : actuator_(actuator), limit_(joints), torque_(joints) {
    std::ranges::copy(actuator.command_limit(), limit_.begin());
  }
  [[nodiscard]] double limit(std::size_t joint) const { return limit_[joint]; }
  /// N m, of every joint; where there is no limit the number means nothing.
  const std::vector<double>& torques(double sign, const std::vector<double>& speeds) {
    std::vector<double> slope(limit_.size());
    const std::vector<double> command = commands(sign);
    actuator_.effort(command, speeds, torque_, slope);
    return torque_;
  }
  /// A, of every joint; NaN where it is not at its largest current.
  std::vector<double> limited_currents(double sign, const std::vector<double>& speeds) {
    std::vector<double> current(limit_.size());
    std::vector<double> saturation(limit_.size());
    std::vector<double> ignored(limit_.size());
    const std::vector<double> command = commands(sign);
    actuator_.electrical(command, speeds, {ignored, current, saturation, ignored, ignored, ignored});
    for (std::size_t j = 0; j < limit_.size(); ++j) {
      const bool limits = saturation[j] == 2 && current[j] != 0;
      current[j] = limits ? std::abs(current[j]) : std::numeric_limits<double>::quiet_NaN();
    }
    return current;
  }

 private:
  [[nodiscard]] std::vector<double> commands(double sign) const {
    std::vector<double> command;
    for (const double limit : limit_) command.push_back(std::isfinite(limit) ? sign * limit : 0);
    return command;
  }
  const Actuator& actuator_;
  std::vector<double> limit_, torque_;
};

std::optional<double> stated(double rating) { return rating > 0 ? std::optional(rating) : std::nullopt; }

std::optional<double> finite(double value) { return std::isfinite(value) ? std::optional(value) : std::nullopt; }

/// rad/s, of every joint: where the torque along + comes down to 0. None: it does not.
std::vector<std::optional<double>> no_load_speeds(FullCommand& full, std::size_t joints) {
  std::vector<double> low(joints, 0.0);
  std::vector<double> high(joints, 1e-3);
  for (bool grown = true; grown;) {
    grown = false;
    const std::vector<double>& torque = full.torques(1, high);
    for (std::size_t j = 0; j < joints; ++j) {
      if (!(torque[j] > 0) || !(high[j] < kFastest)) continue;
      low[j] = high[j];
      high[j] *= 2;
      grown = true;
    }
  }
  for (int i = 0; i < kHalvings; ++i) {
    std::vector<double> middle;
    for (std::size_t j = 0; j < joints; ++j) middle.push_back(0.5 * (low[j] + high[j]));
    const std::vector<double>& torque = full.torques(1, middle);
    for (std::size_t j = 0; j < joints; ++j) (torque[j] > 0 ? low : high)[j] = middle[j];
  }
  std::vector<std::optional<double>> speeds;
  for (const double speed : high) speeds.push_back(speed < kFastest && speed > 0 ? std::optional(speed) : std::nullopt);
  return speeds;
}

double widest(const std::optional<double>& no_load, double fastest) {
  const double reached = std::isfinite(fastest) && fastest > 0 ? fastest : 1;
  return no_load ? std::clamp(reached, 1.25 * *no_load, 3 * *no_load) : std::min(reached, kFastest);
}

}  // namespace

Motors motors(const Scenario& scenario, double fastest) {
  const std::size_t joints = scenario.robot->joints.size();
  if (scenario.actuator.entry == nullptr || joints == 0) return {};
  const std::unique_ptr<Actuator> actuator = make_actuator(scenario.actuator, info(*scenario.robot));
  FullCommand full(*actuator, joints);
  const std::vector<std::optional<double>> no_load = no_load_speeds(full, joints);
  std::vector<Envelope> of_joint(joints);
  const std::vector<double> rest = full.torques(1, std::vector<double>(joints, 0.0));
  const std::span<const DriveRatings> ratings = actuator->ratings();
  for (std::size_t j = 0; j < joints; ++j) {
    of_joint[j].unit = actuator->command_unit();
    if (!ratings.empty()) {
      of_joint[j].continuous = stated(ratings[j].current_continuous);
      of_joint[j].gear_peak = stated(ratings[j].torque_peak);
      of_joint[j].gear_continuous = stated(ratings[j].torque_continuous);
      of_joint[j].speed_max = stated(ratings[j].speed);
    }
    if (!std::isfinite(full.limit(j))) continue;
    of_joint[j].command = full.limit(j);
    of_joint[j].rest = finite(rest[j]);
    if (rest[j] > 0) of_joint[j].no_load = no_load[j];
  }
  for (std::size_t i = 0; i < kSpeeds; ++i) {
    const double part = 2 * static_cast<double>(i) / (kSpeeds - 1) - 1;
    std::vector<double> speeds;
    for (std::size_t j = 0; j < joints; ++j) speeds.push_back(part * widest(of_joint[j].no_load, fastest));
    const std::vector<double> most = full.torques(1, speeds);
    const std::vector<double> least = full.torques(-1, speeds);
    const std::vector<double> current = full.limited_currents(1, speeds);
    for (std::size_t j = 0; j < joints; ++j) {
      Envelope& motor = of_joint[j];
      if (!motor.command) continue;
      motor.speed.push_back(speeds[j]);
      motor.most.push_back(most[j]);
      motor.least.push_back(least[j]);
      if (std::isfinite(current[j])) motor.current = std::max(motor.current.value_or(0), current[j]);
    }
  }
  Motors found;
  for (const Envelope& motor : of_joint) {
    const auto known = std::ranges::find(found.kinds, motor);
    found.of_joint.push_back(static_cast<std::size_t>(known - found.kinds.begin()));
    if (known == found.kinds.end()) found.kinds.push_back(motor);
  }
  return found;
}

}  // namespace gaitlab::report
