// The check `progress`: the robot travels or turns by its own motors.
#include "core/model/extent.h"
#include "core/settings/wording.h"
#include "report/analysis/motion.h"
#include "report/analysis/states.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

namespace {

// Least travel, as a share of the robot's extent, and least turn, rad. Both are per period; without a period they are ten times
// as large.
constexpr double kLeastTravel = 0.01, kLeastTurn = 0.01;
constexpr const char* kTimes = "times";  // unit of a ratio of speeds
constexpr double kSpeedsUp = 1.2;        // ratio of speeds of second and first half above which gravity drives the robot

/// Indices of control ticks in the judged window.
struct Rows {
  std::size_t first = 0, last = 0;
};

Rows window(const CheckedRun& run, const Series& time) {
  Rows rows{0, time.size() - 1};
  while (rows.first < rows.last && time[rows.first] < run.summary.judged.from) ++rows.first;
  return rows;
}

/// Diagonal of the box around all links and contact elements at the start, m; 0 if not known.
double extent(const Scenario& s, const Recording& r) {
  const States states = States::at_ticks(r, *s.robot);
  return states.size() == 0 ? 0 : gaitlab::extent(*s.robot, states(0));
}

/// Two intervals of equal length, each of whole periods. The second one ends at the end of the run.
struct Halves {
  double from = 0, length = 0;  ///< s, start of the first interval; length of both; length 0 if the run contains fewer than two
                                ///< periods
};

/// The two halves of the judged window. With an odd number of periods the middle one belongs to both halves. A single period is
/// compared with the preceding one. If the run has no limit cycle, a drop at the start is left out.
Halves halves(const CheckedRun& run) {
  constexpr double kMissing = 1e-3;  // share of a period that may be missing from a whole one
  const Judged& judged = run.summary.judged;
  const double start = judged.periods > 0 ? judged.from : std::max(judged.from, left_out_start(judged.to));
  const double window = judged.to - start;
  const double period = judged.periods > 0 ? window / static_cast<double>(judged.periods) : run.summary.gait.period;
  const double unit = period > 0 ? period : window / 2;
  const double held = std::max(2.0, std::floor(window / unit + kMissing));
  const double from = judged.to - held * unit;
  return from >= -kMissing * unit ? Halves{from, std::ceil(held / 2) * unit} : Halves{};
}

/// Work of gravity along the ground from the start of the first half on, J. It is computed from the heights of the ground below
/// the robot, because a drop onto the ground, for example at the start, is not a slide.
double gravity_work(const Scenario& s, const Recording& r, const Motion& m, const Halves& of) {
  std::size_t first = 0;
  while (first + 1 < m.t.size() && m.t[first] < of.from) ++first;
  const auto way = [&](const Series& one) { return one.back() - one[first]; };
  Vec3 all(way(m.x), way(m.y), 0);
  const States states = States::at_ticks(r, *s.robot);
  if (!s.ground.is_plane() && states.size() == m.t.size())
    all.z() = surface_height(s, states(states.size() - 1)) - surface_height(s, states(first));
  return s.robot->mass * s.physics.gravity.dot(all);
}

/// Path speed in the second half / path speed in the first half.
double speed_up(const Motion& m, const Halves& of, double end) {
  const auto way = [&](double from, double to) {
    double sum = 0;
    for (std::size_t k = 1; k < m.t.size(); ++k) {
      if (m.t[k] > from && m.t[k] <= to) sum += std::hypot(m.x[k] - m.x[k - 1], m.y[k] - m.y[k - 1]);
    }
    return sum;
  };
  const double before = way(of.from, of.from + of.length);
  return before > 0 ? way(end - of.length, end) / before : 1;
}

/// Makes the check fail if gravity pulls the robot down a slope of its ground.
void judge_slide(const CheckedRun& run, const Motion& m, Check& made) {
  const Scenario& s = run.scenario;
  const Halves two = halves(run);
  const double fallen = gravity_work(s, run.record, m, two);
  double driven = 0;
  for (const JointStatistics& joint : run.record.joints) driven += joint.shaft;
  if (!run.evidence.not_borne.empty()) return;  // a falling robot does not slide
  const double faster = speed_up(m, two, run.summary.judged.to);
  if (!(fallen > std::max(driven, least_energy(s))) || !(faster > kSpeedsUp)) return;
  made.criteria = {{made.value, made.limit, made.unit, true}, {faster, kSpeedsUp, kTimes}};
  made.value = faster;
  made.limit = kSpeedsUp;
  made.unit = kTimes;
  made.least = false;
  made.margin = made.criteria.back().margin();
  made.can_fail = true;
  made.status = CheckStatus::fail;
  made.text = fmt::format(
      "the robot slides down: gravity does {:.3g} J of work, the motors {:.3g} J, and its speed grows {:.3g} "
      "times from the first half of the judged time to the second",
      fallen, driven, faster);
}

}  // namespace

std::vector<CheckKind> checks::progress() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    const Scenario& s = run.scenario;
    const Recording& r = run.record;
    const Motion m = motion(r);
    made.text = "judged only for a floating base on a ground";
    if (s.base != Base::floating || !s.ground.exists()) return;
    made.text = "the robot has no size, or the run has no control ticks";
    const double size = extent(s, r);
    if (!(size > 0) || m.t.size() < 3 || m.x.empty() || m.y.empty() || m.z.empty()) return;
    const Rows rows = window(run, m.t);
    const std::size_t periods = run.summary.judged.periods;
    const double per = periods > 0 ? static_cast<double>(periods) : 1;
    const double factor = periods > 0 ? 1 : 10;
    made.value = std::hypot(m.x[rows.last] - m.x[rows.first], m.y[rows.last] - m.y[rows.first]) / per;
    const double asked = s.limits.progress;
    made.limit = (asked > 0 ? asked : factor * kLeastTravel) * size;
    made.source = threshold("progress", asked, 0);
    made.from = m.t[rows.first];
    made.to = m.t[rows.last];
    const double turn = m.qw.empty() ? 0 : std::abs(heading_change(m, rows.first, rows.last)) / per;
    const char* const each = periods > 0 ? "per period" : "in the judged time";
    const bool goes = made.value >= made.limit || (asked == 0 && turn >= factor * kLeastTurn);
    made.status = goes                             ? CheckStatus::pass
                  : asked > 0                      ? CheckStatus::fail
                  : run.evidence.not_shown.empty() ? CheckStatus::warn
                                                   : CheckStatus::not_judged;
    made.text = fmt::format("the robot goes {:.3g} m {}{}", made.value, each,
                            goes ? "" : fmt::format(", less than {:.3g} m", made.limit));
    made.can_fail = asked > 0;
    judge_slide(run, m, made);
  };
  return {
      {"progress", CheckGroup::run, "m", "Goes somewhere",
       "travel of the centre of mass per period (without periods: in the window)",
       "below limits.progress of the robot's extent (diagonal of the box around links and contact elements at the start) if "
       "that is set; or the robot slides down its ground faster and faster: gravity does more work along the ground than the "
       "motors",
       "below a hundredth of the robot's extent (without periods: a tenth), if the robot hardly turns either",
       CheckSpan::window, "limits.progress", "limits.progress, if standing still is to count as a failure", judge, true}};
}

}  // namespace gaitlab::report
