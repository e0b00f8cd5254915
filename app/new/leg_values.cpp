#include "app/new/leg_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scenario/sensor_section.h"
#include "core/settings/wording.h"
#include "cpg/stance.h"
#include "report/verdict/leg_sag.h"

namespace gaitlab::app {

namespace {

constexpr double kSag = 0.01;  // rad

/// The section `controller`, with the module's gains times `factor`.
std::string controller_text(const Scenario& one, double period, double factor, double sags) {
  const std::vector<report::PositionLoop> loops = report::position_loops(one);
  if (std::ranges::any_of(loops, [](const report::PositionLoop& loop) { return std::string(loop.key) != "Kp"; })) return "";
  const auto gain = [&](const report::PositionLoop& loop) { return fmt::format("{:.3g}", loop.Kp * factor / loop.per_key); };
  const std::string common = gain(loops.front());
  std::string others;
  for (const report::PositionLoop& loop : loops) {
    if (gain(loop) == common) continue;
    others += fmt::format(", \"*/{}\": {}", one.robot->joints[loop.joint].name.substr(3), gain(loop));
  }
  return fmt::format("controller:\n  period: {}            # s: the legs sag by {:.2g} rad under the robot\n  Kp: {}\n\n",
                     number_text(period), sags, others.empty() ? common : "{default: " + common + others + "}");
}

}  // namespace

std::optional<LegValues> leg_values(const Scenario& one, double share) {
  const RobotInfo robot = plugin_info(one);
  if (robot.legs.empty() || one.actuator.entry == nullptr) return {};
  std::vector<cpg::LegKinematics> legs;
  for (const Leg& leg : robot.legs) legs.emplace_back(robot, leg);
  const std::vector<double> q = cpg::stance_of(robot, legs, 0);
  double height = 0;
  for (const cpg::LegKinematics& leg : legs) height = std::max(height, vector_of(robot.up).dot(leg.hip(q) - leg.foot(q)));
  if (!(height > 0)) return {};

  LegValues values;
  constexpr std::array kPeriods{0.015, 0.01, 0.005, 0.002, 0.001};  // s
  const double usual = one.control_period;
  const std::optional<report::LegSag> yields = report::leg_sag(one, robot, q);
  const double sags = yields ? yields->angle : 0;
  const auto holds = [&](double period) { return period <= usual && sags * period / usual <= kSag; };
  const auto longest = std::ranges::find_if(kPeriods, holds);
  const double period = longest == kPeriods.end() ? kPeriods.back() : *longest;
  if (period < usual) values.controller = controller_text(one, period, usual / period, sags * period / usual);

  const char* const gait = legs.size() % 2 == 1 ? "wave" : legs.size() < 6 ? "trot" : "tripod";
  const double frequency = (legs.size() < 6 ? 0.35 : 0.1) * std::sqrt(one.physics.gravity.norm() / height);
  constexpr double kPeriodsRun = 6;  // two to start, and four that are judged
  values.what = std::string("a ") + gait;
  values.cpg = fmt::format(
      "  type: legs               # others: gaitlab list cpg\n"
      "  frequency: {:.2g}           # Hz\n"
      "  model:\n"
      "    gait: {}             # gaitlab explain cpg legs\n"
      "    stride: {:.2g}          # m, way of the body in a cycle\n"
      "    lift: {:.2g}            # m, of a foot in its swing\n",
      frequency, gait, share * 0.3 * height, 0.1 * height);
  values.duration = number_text(std::ceil(kPeriodsRun / frequency));
  return values;
}

}  // namespace gaitlab::app
