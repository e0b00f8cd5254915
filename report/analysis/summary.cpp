#include "report/analysis/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/build_id.h"
#include "core/settings/wording.h"
#include "core/simulation/start.h"
#include "core/simulation/step_advice.h"
#include "report/analysis/motion.h"

namespace gaitlab::report {

namespace {

void travel(const Recording& r, Summary& s) {
  const Motion m = motion(r);
  const Series& x = m.x;
  const Series& y = m.y;
  if (x.empty() || y.empty()) return;
  s.displacement_x = x.back() - x.front();
  s.displacement_y = y.back() - y.front();
  s.distance = std::hypot(s.displacement_x, s.displacement_y);
  s.speed = s.simulated > 0 ? s.distance / s.simulated : 0;
  for (std::size_t k = 1; k < x.size(); ++k) s.path_length += std::hypot(x[k] - x[k - 1], y[k] - y[k - 1]);
  if (!m.qw.empty()) s.heading_change = heading_change(m, 0, m.qw.size() - 1);
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
  s.limit_cycle = limit_cycle(scenario, r);
  s.gait = gait(scenario, r);
  s.stability_max = scenario.physics.step * r.worst.rate;
  s.stability_share =
      r.control_ticks > 0 ? static_cast<double>(r.control_ticks_above_1) / static_cast<double>(r.control_ticks) : 0;
  const auto contacts = contact_elements(*scenario.robot, scenario.contact.on);
  if (r.worst.rate > 0) s.stability_source = source_of(r.worst, *scenario.robot, contacts);
  s.judged = judge(r, s.limit_cycle, s.gait.period, s.gait.start);
  s.posture = posture(scenario, r, s.judged);
  s.fall = fall(scenario, r);
  s.log = log_errors(scenario, r);
  return s;
}

}  // namespace gaitlab::report
