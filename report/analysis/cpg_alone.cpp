#include "report/analysis/cpg_alone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "core/math/periods.h"
#include "core/plugin/plugin_instance.h"
#include "core/scenario/sections.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/settings_numbers.h"
#include "core/settings/writer.h"

namespace gaitlab::report {

namespace {

constexpr double kTicksOfCpg = 2000;
constexpr std::int64_t kTicksOfFeedback = 400;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

thread_local const std::atomic<bool>* stop_of_thread = nullptr;

/// The object that CpgAlone::leave stored last, and everything that it depends on.
struct Left {
  std::mutex mutex;
  std::string key;
  std::weak_ptr<const Robot> robot;
  std::optional<CpgAlone> alone;
};
Left& left_alone() {
  static auto* const made = new Left;  // never destroyed: threads may judge runs at exit
  return *made;
}

}  // namespace

StatedTimes stated_times(const Scenario& s) {
  if (s.cpg.entry == nullptr) return {};
  const PluginSelection& last = s.changes.empty() ? s.cpg : s.changes.back().cpg;
  const std::unique_ptr<Cpg> cpg = make_cpg(last, plugin_info(s));
  const auto [period, full_size, from_start] = cpg->times();
  StatedTimes made{period, full_size, cpg->states() == 0 || from_start ? full_size : 0, period > 0 || full_size > 0};
  const auto steering = [](const auto& sensor) { return sensor->is_steering(); };
  if (std::ranges::any_of(make_sensors(s), steering)) {  // it may change the set points at any time
    made.full_size = 0;
    made.by_cpg = false;
  }
  if (const std::vector<double> all = frequencies(s, last); !(period > 0) && !all.empty())
    made.period = 1 / *std::ranges::min_element(all);
  return made;
}

StopsCpgAlone::StopsCpgAlone(const std::atomic<bool>& stop) { stop_of_thread = &stop; }
StopsCpgAlone::~StopsCpgAlone() { stop_of_thread = nullptr; }
bool StopsCpgAlone::asked() { return stop_of_thread != nullptr && *stop_of_thread; }

std::vector<double> frequencies(const Scenario& s, const PluginSelection& cpg) {
  std::vector<double> all;
  const SettingsNumbers settings(cpg);
  for (const SettingsNumbers::Found& one : settings.all()) {
    if (one.unit != "Hz") continue;
    for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
      if (s.robot->joints[j].driven() && one.value[j] > 0) all.push_back(one.value[j]);
    }
  }
  return all;
}

std::string key_of_cpg(const Scenario& s) {
  const std::vector<std::string> joints = joint_names(*s.robot);
  Writer writer(joints);
  visit_settings(*s.cpg.entry, s.cpg.settings.get(), writer);
  std::string key =
      fmt::format("{} {} {} {} {}", s.cpg.entry->origin, s.cpg.entry->name, s.control_period, s.cpg_step, s.sensors.size());
  for (std::size_t j = 0; j < joints.size(); ++j) key += fmt::format(" {}", s.initial.angles[j]);
  return key + "\n" + print_yaml(writer.take()) + print_yaml(sensors_node(s, joints));
}

CpgAlone::CpgAlone(const Scenario& s, const Feedback& feedback)
    : period_(s.control_period),
      step_(s.cpg_step),
      speed_(s.robot->joints.size(), feedback.speed),
      torque_(s.robot->joints.size(), feedback.torque),
      touching_(s.robot->modules.size(), feedback.touching),
      load_(s.robot->joints.size(), feedback.load),
      setpoint_(s.robot->joints.size()),
      integrator_(0) {
  const RobotInfo robot = plugin_info(s);
  cpg_ = make_cpg(s.cpg, robot);
  channels_.assign(robot.channels.size(), feedback.speed);
  std::size_t channel = 0;
  for (auto& sensor : make_sensors(s)) {
    const auto own = [](const SensorReading& reading) { return reading.replaces == Replaces::nothing; };
    const auto count = static_cast<std::size_t>(std::ranges::count_if(sensor->readings(), own));
    if (sensor->is_steering()) steering_.emplace_back(std::move(sensor), channel);
    channel += count;
  }
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    driven_.push_back(s.robot->joints[j].driven());
    angle_.push_back(s.initial.angles[j] + feedback.angle);
  }
  state_.resize(cpg_->states());
  integrator_ = CpgIntegrator(state_.size());
  cpg_->start(state_);
}

Measured CpgAlone::measured(double t) const { return {t, period_, angle_, speed_, torque_, touching_, channels_, load_}; }

const std::vector<double>& CpgAlone::rows(std::int64_t ticks) {
  rows_.reserve(static_cast<std::size_t>(std::max(ticks, ticks_)) * driven_.size());
  for (; ticks_ < ticks && !StopsCpgAlone::asked(); ++ticks_) {
    const double t = static_cast<double>(ticks_) * period_;
    Truth truth;
    truth.tick = ticks_;
    for (const auto& [sensor, first] : steering_)
      sensor->sense(truth, {}, Out(channels_).subspan(first, sensor->readings().size()));
    cpg_->event(measured(t), state_);
    cpg_->output(t, state_, setpoint_);
    for (std::size_t j = 0; j < setpoint_.size(); ++j) {
      if (driven_[j]) rows_.push_back(setpoint_[j]);
    }
    integrator_.advance(*cpg_, state_, t, math::steps_in(period_, step_), step_, [this](double at) { return measured(at); });
  }
  return rows_;
}

CpgAlone CpgAlone::found(const Scenario& s) {
  const std::string key = key_of_cpg(s);
  Left& left = left_alone();
  {
    const std::lock_guard lock(left.mutex);
    if (left.alone && left.key == key && left.robot.lock() == s.robot) return *std::exchange(left.alone, std::nullopt);
  }
  return CpgAlone(s);
}

void CpgAlone::leave(const Scenario& s, CpgAlone alone) {
  Left& left = left_alone();
  const std::lock_guard lock(left.mutex);
  left.key = key_of_cpg(s);
  left.robot = s.robot;
  left.alone = std::move(alone);
}

std::vector<SetPointRange> set_point_ranges(const Scenario& s) {
  std::vector<SetPointRange> all;
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    if (s.robot->joints[j].driven()) all.push_back({j, kUnlimited, -kUnlimited});
  }
  if (s.cpg.entry == nullptr || all.empty()) return {};
  const double until = s.changes.empty() ? s.duration : s.changes.front().t;
  const auto ticks = static_cast<std::int64_t>(std::min(kTicksOfCpg, std::ceil(until / s.control_period)));
  CpgAlone alone(s);
  const std::vector<double>& rows = alone.rows(ticks);
  const std::vector<double> moved = CpgAlone(s, {0.1, 0.3, 0.5, 1, 2}).rows(std::min(ticks, kTicksOfFeedback));
  if (StopsCpgAlone::asked() || !std::equal(moved.begin(), moved.end(), rows.begin())) return {};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SetPointRange& one = all[i % all.size()];
    one.least = std::min(one.least, rows[i]);
    one.most = std::max(one.most, rows[i]);
    if (i >= all.size()) one.speed = std::max(one.speed, std::abs(rows[i] - rows[i - all.size()]) / s.control_period);
  }
  if (s.cpg.entry->context == nullptr) CpgAlone::leave(s, std::move(alone));
  return all;
}

}  // namespace gaitlab::report
