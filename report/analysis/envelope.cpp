#include "report/analysis/envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/laws/dc_motor.h"
#include "core/laws/joint_friction.h"
#include "core/plugin/robot_info.h"
#include "core/recording/motor_limit.h"
#include "core/scenario/built_robot.h"
#include "core/settings/settings_numbers.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kSpeeds = 121;  // points of a curve; odd, so that speed 0 is among them
constexpr double kFastest = 1e5;      // rad/s: above any joint speed
constexpr double kSlowest = 1e-6;     // rad/s: a motor that reaches less does not turn its joint
constexpr int kHalvings = 60;         // until the interval of the bisection is empty

/// Torque of every joint at its speed under the largest positive command, N m.
std::vector<double> most_at(const AvailableTorque& available, const std::vector<double>& speeds) {
  std::vector<double> most(speeds.size());
  std::vector<double> least(speeds.size());
  available.at(speeds, most, least);
  return most;
}

/// Current of every joint under the largest positive command, A; NaN if it is not limited by the largest current.
std::vector<double> limited_currents(const AvailableTorque& available, const std::vector<double>& speeds) {
  std::vector<double> current(speeds.size());
  std::vector<double> saturation(speeds.size());
  std::vector<double> ignored(speeds.size());
  available.actuator().electrical(available.commands(), speeds, {ignored, current, saturation, ignored, ignored, ignored});
  for (std::size_t j = 0; j < speeds.size(); ++j) {
    const bool limits = motor_limit(saturation[j]) == MotorLimit::current && current[j] != 0;
    current[j] = limits ? std::abs(current[j]) : std::numeric_limits<double>::quiet_NaN();
  }
  return current;
}

std::optional<double> stated(double rating) { return rating > 0 ? std::optional(rating) : std::nullopt; }

std::optional<double> finite(double value) { return std::isfinite(value) ? std::optional(value) : std::nullopt; }

/// Speed of every joint at which the torque under the largest positive command falls to 0, rad/s. Nothing if it does not fall
/// to 0.
std::vector<std::optional<double>> no_load_speeds(const AvailableTorque& available, std::size_t joints) {
  std::vector<double> low(joints, 0.0);
  std::vector<double> high(joints, 1e-3);
  for (bool grown = true; grown;) {
    grown = false;
    const std::vector<double> torque = most_at(available, high);
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
    const std::vector<double> torque = most_at(available, middle);
    for (std::size_t j = 0; j < joints; ++j) (torque[j] > 0 ? low : high)[j] = middle[j];
  }
  std::vector<std::optional<double>> speeds;
  for (const double speed : high) speeds.push_back(speed < kFastest && speed > kSlowest ? std::optional(speed) : std::nullopt);
  return speeds;
}

double widest(const std::optional<double>& no_load, double fastest) {
  const double reached = std::isfinite(fastest) && fastest > 0 ? fastest : 1;
  return no_load ? std::clamp(reached, 1.25 * *no_load, 3 * *no_load) : std::min(reached, kFastest);
}

}  // namespace

AvailableTorque::AvailableTorque(const Scenario& scenario) : actuator_(make_motors(scenario)) {
  if (actuator_ == nullptr) return;
  for (const double limit : actuator_->command_limit()) {
    known_.push_back(std::isfinite(limit));
    most_.push_back(std::isfinite(limit) ? limit : 0);
    least_.push_back(-most_.back());
  }
}

void AvailableTorque::at(In speed, Out most, Out least) const {
  if (actuator_ == nullptr) return;
  std::vector<double> slope(speed.size());
  actuator_->effort(most_, speed, most, slope);
  actuator_->effort(least_, speed, least, slope);
  const DcMotor* const motors = actuator_->dc_motors();
  for (std::size_t j = 0; motors != nullptr && j < speed.size(); ++j) {
    if (speed[j] != 0) continue;  // at rest, the loss of the gear helps to hold
    most[j] = motors[j].on(-1, most_[j], 0).torque;
    least[j] = motors[j].on(1, least_[j], 0).torque;
  }
  const std::span<const JointFriction> friction = actuator_->friction();
  for (std::size_t j = 0; j < friction.size(); ++j) {
    most[j] += friction_along(friction[j], speed[j], 1);
    least[j] -= friction_along(friction[j], speed[j], -1);
  }
}

namespace {

/// Adds the envelopes at kSpeeds speeds.
void add_speeds(const AvailableTorque& available, double fastest, std::vector<Envelope>& of_joint) {
  const std::size_t joints = of_joint.size();
  for (std::size_t i = 0; i < kSpeeds; ++i) {
    const double part = 2 * static_cast<double>(i) / (kSpeeds - 1) - 1;
    std::vector<double> speeds;
    for (std::size_t j = 0; j < joints; ++j) speeds.push_back(part * widest(of_joint[j].no_load, fastest));
    std::vector<double> most(joints);
    std::vector<double> least(joints);
    available.at(speeds, most, least);
    const std::vector<double> current = limited_currents(available, speeds);
    for (std::size_t j = 0; j < joints; ++j) {
      Envelope& motor = of_joint[j];
      if (!motor.command) continue;
      motor.speed.push_back(speeds[j]);
      motor.most.push_back(most[j]);
      motor.least.push_back(least[j]);
      if (std::isfinite(current[j])) motor.current = std::max(motor.current.value_or(0), current[j]);
    }
  }
}

}  // namespace

Motors motors(const Scenario& scenario, double fastest) try {
  const std::size_t joints = scenario.robot->joints.size();
  if (scenario.actuator.entry == nullptr || joints == 0) return {};
  const AvailableTorque available(scenario);
  const std::vector<std::optional<double>> no_load = no_load_speeds(available, joints);
  std::vector<Envelope> of_joint(joints);
  const std::vector<double> at_rest(joints, 0.0);
  const std::vector<double> rest = most_at(available, at_rest);
  std::vector<double> motor(joints);
  std::vector<double> unused(joints);
  available.actuator().effort(available.commands(), at_rest, motor, unused);
  const std::span<const DriveRatings> ratings = available.actuator().ratings();
  const DcMotor* const dc = available.actuator().dc_motors();
  const SettingsNumbers settings(scenario.actuator);
  const SettingsNumbers::Found* const sheet = settings.find("stall_torque");
  const SettingsNumbers::Found* const voltage = settings.find("voltage");
  for (std::size_t j = 0; j < joints; ++j) {
    of_joint[j].unit = available.actuator().command_unit();
    if (!ratings.empty()) {
      of_joint[j].continuous = stated(ratings[j].current_continuous);
      of_joint[j].gear_peak = stated(ratings[j].torque_peak);
      of_joint[j].gear_continuous = stated(ratings[j].torque_continuous);
      of_joint[j].speed_max = stated(ratings[j].speed);
    }
    if (dc != nullptr && dc[j].R > 0) {
      const double stall = dc[j].efficiency * dc[j].load * dc[j].Kt * dc[j].gear * dc[j].u_max / dc[j].R;
      const double supply = sheet == nullptr ? 1 : std::min(1.0, dc[j].u_max / voltage->value[j]);
      of_joint[j].stall = finite(sheet == nullptr ? stall : sheet->value[j] * supply);
    }
    if (!available.known(j)) continue;
    of_joint[j].command = available.commands()[j];
    of_joint[j].rest = finite(motor[j]);
    of_joint[j].holds = finite(rest[j]);
    if (rest[j] > 0) of_joint[j].no_load = no_load[j];
  }
  add_speeds(available, fastest, of_joint);
  Motors found;
  for (const Envelope& motor : of_joint) {
    const auto known = std::ranges::find(found.kinds, motor);
    found.of_joint.push_back(static_cast<std::size_t>(known - found.kinds.begin()));
    if (known == found.kinds.end()) found.kinds.push_back(motor);
  }
  return found;
} catch (const PluginError&) {  // a plugin that throws may have ended the run, and then the run reports it; the envelope is not
                                // known
  return {{Envelope()}, std::vector<std::size_t>(scenario.robot->joints.size(), 0)};
}

}  // namespace gaitlab::report
