#include "report/analysis/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/build_id.h"
#include "core/settings/wording.h"
#include "core/simulation/start.h"
#include "core/simulation/step_advice.h"
#include "report/analysis/fall.h"

namespace gaitlab::report {

namespace {

/// Turn about world z from one tick to the next: the twist of the rotation between them. Defined however far the base is
/// pitched.
double twist(const Quat& before, const Quat& now) {
  const Quat turn = now * before.conjugate();
  return std::remainder(2 * math::atan2(turn.z(), turn.w()), 2 * std::numbers::pi);
}

void travel(const Recording& r, Summary& s) {
  const Series x = r.series("com.x");
  const Series y = r.series("com.y");
  if (x.empty() || y.empty()) return;
  s.displacement_x = x.back() - x.front();
  s.displacement_y = y.back() - y.front();
  s.distance = std::hypot(s.displacement_x, s.displacement_y);
  s.speed = s.simulated > 0 ? s.distance / s.simulated : 0;
  for (std::size_t k = 1; k < x.size(); ++k) s.path_length += std::hypot(x[k] - x[k - 1], y[k] - y[k - 1]);
  const std::array turn{r.series("base.qw"), r.series("base.qx"), r.series("base.qy"), r.series("base.qz")};
  const auto at = [&](std::size_t k) { return Quat(turn[0][k], turn[1][k], turn[2][k], turn[3][k]); };
  for (std::size_t k = 1; k < turn[0].size(); ++k) s.heading_change += twist(at(k - 1), at(k));
}

void transport(const Scenario& scenario, const Recording& r, Summary& s) {
  double electrical = 0;
  double mechanical = 0;
  for (const JointStatistics& joint : r.joints) {
    electrical += joint.electrical;
    mechanical += joint.shaft_positive;
  }
  const double work = scenario.robot->mass * scenario.physics.gravity.norm() * s.distance;
  if (!(work > 0)) return;
  s.cost_electrical = electrical / work;
  s.cost_mechanical = mechanical / work;
}

MotionCycle cycle(const Scenario& scenario, const Recording& r, const Summary& s) {
  const std::size_t n = scenario.robot->joints.size();
  if (n == 0) return {};
  // The last row may lie off the grid of trace periods.
  const auto ticks = static_cast<std::size_t>(std::floor(s.simulated / scenario.trace.period + 1e-9)) + 1;
  std::vector<Series> columns;
  for (const char* quantity : {"angle", "setpoint"}) {
    for (std::size_t j = 0; j < n; ++j) {
      if (const Series one = r.joint(j, quantity); !one.empty()) columns.push_back(one);
    }
  }
  std::vector<double> all;
  all.reserve(r.rows() * columns.size());
  for (std::size_t k = 0; k < std::min(ticks, r.rows()); ++k) {
    for (const Series& column : columns) all.push_back(column[k]);
  }
  return find_limit_cycle(all, columns.size(), scenario.trace.period);
}

}  // namespace

Summary travelled(const Recording& r) {
  Summary s;
  s.simulated = r.simulated;
  travel(r, s);
  return s;
}

Summary summarise(const Scenario& scenario, const Recording& r, double wall_time) {
  Summary s;
  s.wall_time = wall_time;
  s.build = build_id();
  s.outcome = r.outcome;
  s.simulated = r.simulated;
  travel(r, s);
  transport(scenario, r, s);
  s.limit_cycle = cycle(scenario, r, s);
  s.stability_max = scenario.physics.step * r.worst.rate;
  s.stability_share =
      r.control_ticks > 0 ? static_cast<double>(r.control_ticks_above_1) / static_cast<double>(r.control_ticks) : 0;
  const auto contacts = contact_elements(*scenario.robot, scenario.contact.on);
  if (r.worst.rate > 0) s.stability_source = source_of(r.worst, *scenario.robot, contacts);
  s.judged = judge(r, s.limit_cycle);
  s.posture = posture(scenario, r, s.judged);
  return s;
}

}  // namespace gaitlab::report
