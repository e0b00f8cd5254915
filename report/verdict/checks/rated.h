// Values of joints against the ratings of their motors and gears.
#pragma once
#include <tuple>

#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

inline constexpr double kNever = std::numeric_limits<double>::infinity();
inline constexpr double kNoTime = std::numeric_limits<double>::quiet_NaN();

/// Sets Check::first to the end of the first row after row `after` in which any driven joint is `beyond`, and Check::first_part
/// to that joint. Changes neither if there is none.
template <class Beyond>
void find_first(const CheckedRun& run, std::size_t after, TickColumn column, const Beyond& beyond, Check& made) {
  const Series t(run.record.ticks, 0);
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    const Series values = run.record.tick(j, column);
    if (values.empty() || !run.judges(j, made.span)) continue;
    for (std::size_t k = after + 1; k < t.size() && !(t[k] >= made.first); ++k) {
      if (!beyond(j, values[k])) continue;
      made.first = t[k];
      made.first_part = run.joint(j);
      break;
    }
  }
}

/// Value of a joint, its limit, and the time of the value in s. NaN if not known; an infinite or 0 limit is not stated.
struct JointRated {
  double value, limit, time;
};

/// Judges the joint with the least margin. `none` is the text if no joint has a limit. Returns the error bars of all joints
/// with a limit.
template <class Rate>
std::vector<ErrorBar> rated(const CheckedRun& run, Check& made, TickColumn column, const char* none, double pass, double warn,
                            Rate rate) {
  std::vector<ErrorBar> bars;
  if (left_open(made, run.unknown(column))) return bars;
  bool faulty = !run.faults.empty();
  double worst = -1;
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    if (!run.judges(j, made.span)) continue;
    faulty = false;
    const JointRated of = rate(j);
    if (!std::isfinite(of.limit) || !(of.limit > 0)) continue;
    const double share = of.value / of.limit;
    bars.push_back(ErrorBar::around(run.joint(j), share, run.torque_error(j)));
    if (share > (std::isfinite(warn) ? warn : pass)) ++made.parts;
    if (share <= kLarger * worst) continue;
    worst = share;
    made.value = of.value;
    made.limit = of.limit;
    name_joint(made, run, j);
    std::tie(made.from, made.to) = row_before(run.record, of.time);
  }
  made.text = faulty ? kAllFaulty : none;
  if (worst < 0) return bars;
  made.status = graded(worst, pass, warn);
  made.source = run.motor_source;
  made.text.clear();
  return bars;
}

}  // namespace gaitlab::report
