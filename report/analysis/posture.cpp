#include "report/analysis/posture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "report/analysis/motion.h"

namespace gaitlab::report {

namespace {

constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

/// Value at time t, linear between rows, constant beyond the first and the last row.
double at_time(const Series& time, const Series& value, double t) {
  std::size_t next = 0;
  while (next + 1 < time.size() && time[next] < t) ++next;
  if (next == 0 || !(t < time[next])) return value[next];
  const double share = (t - time[next - 1]) / (time[next] - time[next - 1]);
  return value[next - 1] + share * (value[next] - value[next - 1]);
}

}  // namespace

Posture posture(const Scenario& scenario, const Recording& r, const Judged& judged) {
  Posture found;
  const Motion m = motion(r);
  if (m.t.empty() || m.z.empty() || m.qx.empty() || m.qy.empty()) return found;
  const Series force = ground_load(scenario, r);
  const double weight = scenario.robot->mass * scenario.physics.gravity.norm();
  std::size_t rows = 0;
  std::size_t airborne = 0;
  double borne = 0;    // N, sum over the ticks
  double upright = 1;  // least cosine of the tilt
  for (std::size_t row = 0; row < m.t.size(); ++row) {
    if (!(m.t[row] > judged.from) || m.t[row] > judged.to) continue;
    const double load = force.empty() ? 0 : force[row];
    airborne += load < kAirborne * weight ? 1 : 0;
    borne += load;
    found.height_min = rows == 0 ? m.z[row] : std::min(found.height_min, m.z[row]);
    found.height_max = rows == 0 ? m.z[row] : std::max(found.height_max, m.z[row]);
    // World z component of the turned z axis.
    upright = std::min(upright, 1 - 2 * (m.qx[row] * m.qx[row] + m.qy[row] * m.qy[row]));
    ++rows;
  }
  if (rows == 0) return found;
  found.tilt_max = std::acos(std::clamp(upright, -1.0, 1.0));
  if (force.empty() || !(weight > 0)) return found;
  found.airborne_share = static_cast<double>(airborne) / static_cast<double>(rows);
  found.borne_share = borne / (weight * static_cast<double>(rows));
  return found;
}

double cycle_speed(const Recording& r, const Judged& judged) {
  const Motion m = motion(r);
  if (judged.periods == 0 || m.t.empty() || m.x.empty() || m.y.empty() || !(judged.to > judged.from)) return kNoFigure;
  const auto way = [&](const Series& s) { return at_time(m.t, s, judged.to) - at_time(m.t, s, judged.from); };
  const double dx = way(m.x);
  const double dy = way(m.y);
  return std::sqrt(dx * dx + dy * dy) / (judged.to - judged.from);
}

}  // namespace gaitlab::report
