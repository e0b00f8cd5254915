// Checks of the gait as a whole: progress, and the evidence for the word; the error bars of the others.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/settings/wording.h"
#include "report/analysis/motion.h"
#include "report/analysis/states.h"
#include "report/verdict/checks.h"
#include "report/verdict/number_texts.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

namespace {

constexpr double kLeastTravel = 0.01, kLeastTurn = 0.01;  // of the extent, and rad: per period, ten times that without one
constexpr double kSpeedsUp = 1.2;                         // of the first half's speed, where gravity drives the robot

/// Control ticks in the judged window.
struct Rows {
  std::size_t first = 0, last = 0;
};

Rows window(const CheckedRun& run, const Series& time) {
  Rows rows{0, time.size() - 1};
  while (rows.first < rows.last && time[rows.first] < run.summary.judged.from) ++rows.first;
  return rows;
}

/// m: diagonal of the box around all links and contact elements at the start; 0: not known.
double extent(const Scenario& s, const Recording& r) {
  const States states = States::at_ticks(r, *s.robot);
  if (states.size() == 0) return 0;
  Kinematics k(*s.robot);
  k.update(*s.robot, states(0));
  Vec3 least = Vec3::Constant(1e300);
  Vec3 most = -least;
  const auto take = [&](const Vec3& at) {
    least = least.cwiseMin(at);
    most = most.cwiseMax(at);
  };
  for (const Vec3& origin : k.p) take(origin);
  for (const ContactElement& element : contact_elements(*s.robot, ContactSet::all))
    take(k.p[element.link] + k.R[element.link] * element.centre);
  return (most - least).norm();
}

/// J: work of gravity in the whole run.
double gravity_work(const Scenario& s, const Motion& m) {
  const Vec3 travel(m.x.back() - m.x.front(), m.y.back() - m.y.front(), m.z.back() - m.z.front());
  return s.robot->mass * s.physics.gravity.dot(travel);
}

/// Ratio of the path speeds of the second and the first half of the window; of an odd number of periods the middle one counts
/// for both.
double speed_up(const CheckedRun& run, const Motion& m, const Rows& rows) {
  const Judged& judged = run.summary.judged;
  const double whole = judged.to - judged.from;
  const double half = judged.periods > 1
                          ? whole * std::ceil(static_cast<double>(judged.periods) / 2) / static_cast<double>(judged.periods)
                          : whole / 2;
  const auto way = [&](double from, double to) {
    double sum = 0;
    for (std::size_t k = rows.first + 1; k <= rows.last; ++k) {
      if (m.t[k] > from && m.t[k] <= to) sum += std::hypot(m.x[k] - m.x[k - 1], m.y[k] - m.y[k - 1]);
    }
    return sum;
  };
  const double before = way(judged.from, judged.from + half);
  return before > 0 ? way(judged.to - half, judged.to) / before : 1;
}

}  // namespace

void widen(const Scenario& scenario, double error, double limit, Check& made) {
  const double low = made.value * (1 - error);
  const double high = made.value * (1 + error);
  if (!(error > 0) || !(low < limit && limit < high)) return;
  made.status = CheckStatus::too_close;
  made.text += fmt::format("; by the error of the torques between {} and {} of the limit: take {}", texts::percent(low / limit),
                           texts::percent(high / limit), torque_remedy(scenario, std::max(error, kTrustedTorque)));
}

namespace checks {

void progress(const CheckedRun& run, Check& made) {
  const Scenario& s = run.scenario;
  const Recording& r = run.record;
  const Motion m = motion(r);
  made.text = "judged of a floating base on a ground";
  if (s.base != Base::floating || s.ground.kind == Ground::Kind::none) return;
  made.text = "the robot has no size, or the run has no control ticks";
  const double size = extent(s, r);
  if (!(size > 0) || m.t.size() < 3 || m.x.empty() || m.y.empty() || m.z.empty()) return;
  const Rows rows = window(run, m.t);
  const std::size_t periods = run.summary.judged.periods;
  const double per = periods > 0 ? static_cast<double>(periods) : 1;
  const double factor = periods > 0 ? 1 : 10;
  made.value = std::hypot(m.x[rows.last] - m.x[rows.first], m.y[rows.last] - m.y[rows.first]) / per;
  made.limit = factor * kLeastTravel * size;
  made.source = "chosen";
  made.from = m.t[rows.first];
  made.to = m.t[rows.last];
  const double turn = std::abs(run.summary.heading_change) * (made.to - made.from) / std::max(r.simulated, 1e-9) / per;
  const char* const each = periods > 0 ? "per period" : "in the judged time";
  made.status = made.value >= made.limit || turn >= factor * kLeastTurn ? CheckStatus::pass : CheckStatus::warn;
  made.text = fmt::format("the robot goes {:.3g} m {}{}", made.value, each,
                          made.status == CheckStatus::pass ? "" : fmt::format(", less than {:.3g} m: it stays", made.limit));
  const double fallen = gravity_work(s, m);
  double driven = 0;
  for (const JointStatistics& joint : r.joints) driven += joint.shaft;
  const double faster = speed_up(run, m, rows);
  if (!(fallen > std::max(driven, least_energy(s))) || !(faster > kSpeedsUp)) return;
  made.status = CheckStatus::fail;
  made.text = fmt::format(
      "the robot slides down: gravity does {:.3g} J of work, the motors {:.3g} J, and its speed grows {:.3g} "
      "times from the first half of the judged time to the second",
      fallen, driven, faster);
}

void evidence(const CheckedRun& run, Check& made) {
  const Evidence& found = run.evidence;
  made.value = run.summary.judged.to - run.summary.judged.from;
  made.source = "chosen";
  made.text = !found.not_trusted.empty() ? found.not_trusted
              : !found.too_short.empty() ? found.too_short
              : !found.not_borne.empty() ? found.not_borne
                                         : "judged over " + found.rests_on;
  if (found.complete()) made.status = CheckStatus::pass;
}

}  // namespace checks

}  // namespace gaitlab::report
