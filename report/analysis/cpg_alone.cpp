#include "report/analysis/cpg_alone.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/periods.h"
#include "core/plugin/plugin_instance.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/settings_numbers.h"
#include "core/simulation/cpg_integrator.h"

namespace gaitlab::report {

namespace {

constexpr double kTicksOfCpg = 2000;
constexpr std::int64_t kTicksOfFeedback = 400;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

thread_local const std::atomic<bool>* stop_of_thread = nullptr;

}  // namespace

StatedTimes stated_times(const Scenario& s) {
  if (s.cpg.entry == nullptr) return {};
  const PluginSelection& last = s.changes.empty() ? s.cpg : s.changes.back().cpg;
  const std::unique_ptr<Cpg> cpg = make_cpg(last, plugin_info(s));
  const auto [period, full_size] = cpg->times();
  StatedTimes made{period, full_size, cpg->states() == 0 ? full_size : 0};
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

std::vector<double> set_points_alone(const Scenario& s, std::int64_t ticks, const Feedback& feedback) {
  const RobotInfo robot = plugin_info(s);
  const std::unique_ptr<Cpg> cpg = make_cpg(s.cpg, robot);
  const std::size_t joints = s.robot->joints.size();
  std::vector<double> angle;
  for (std::size_t j = 0; j < joints; ++j) angle.push_back(s.initial.angles[j] + feedback.angle);
  const std::vector<double> speed(joints, feedback.speed);
  const std::vector<double> torque(joints, feedback.torque);
  const std::vector<double> channels(robot.channels.size(), feedback.speed);
  const std::vector<double> touching(s.robot->modules.size(), feedback.touching);
  const auto measured = [&](double t) { return Measured{t, s.control_period, angle, speed, torque, touching, channels}; };
  std::vector<double> state(cpg->states());
  std::vector<double> setpoint(joints);
  CpgIntegrator integrator(state.size());
  cpg->start(state);
  std::vector<double> all;
  all.reserve(static_cast<std::size_t>(ticks) * joints);
  for (std::int64_t k = 0; k < ticks && !StopsCpgAlone::asked(); ++k) {
    const double t = static_cast<double>(k) * s.control_period;
    cpg->event(measured(t), state);
    cpg->output(t, state, setpoint);
    for (std::size_t j = 0; j < joints; ++j) {
      if (s.robot->joints[j].driven()) all.push_back(setpoint[j]);
    }
    integrator.advance(*cpg, state, t, math::steps_in(s.control_period, s.cpg_step), s.cpg_step, measured);
  }
  return all;
}

std::vector<SetPointRange> set_point_ranges(const Scenario& s) {
  std::vector<SetPointRange> all;
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    if (s.robot->joints[j].driven()) all.push_back({j, kUnlimited, -kUnlimited});
  }
  if (s.cpg.entry == nullptr || all.empty()) return {};
  const double until = s.changes.empty() ? s.duration : s.changes.front().t;
  const auto ticks = static_cast<std::int64_t>(std::min(kTicksOfCpg, std::ceil(until / s.control_period)));
  const std::vector<double> rows = set_points_alone(s, ticks);
  const std::vector<double> moved = set_points_alone(s, std::min(ticks, kTicksOfFeedback), {0.1, 0.3, 0.5, 1});
  if (StopsCpgAlone::asked() || !std::equal(moved.begin(), moved.end(), rows.begin())) return {};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SetPointRange& one = all[i % all.size()];
    one.least = std::min(one.least, rows[i]);
    one.most = std::max(one.most, rows[i]);
    if (i >= all.size()) one.speed = std::max(one.speed, std::abs(rows[i] - rows[i - all.size()]) / s.control_period);
  }
  return all;
}

}  // namespace gaitlab::report
