#include "report/verdict/hopeless.h"

#include <algorithm>
#include <cmath>

#include "core/plugin/plugin_instance.h"
#include "core/simulation/simulation.h"
#include "report/verdict/checks/checked_run.h"
#include "report/verdict/measure.h"

namespace gaitlab::report {

namespace {

constexpr double kPeriodsBefore = 2;   // after the start of the gait; no check is lost before
constexpr double kLostPeak = 1.5;      // chosen (decision 49)
constexpr double kLostShare = 5;       // chosen (decision 49)
constexpr double kSameInstant = 1e-9;  // s

/// True if a check with this margin is lost. `ran` is the part of the longest judged window that the run has completed.
bool is_lost(Lost lost, double margin, double least, double ran) {
  const double times = lost == Lost::extreme ? 1 : lost == Lost::peak ? kLostPeak : std::max(kLostShare, 1 / ran);
  return 1 - margin > times * (1 - least);  // 1 - margin = value / limit, for an upper limit
}

/// True if a period after `from` has ended since the last call of Simulation::watch, or if that call was before `from`, s.
bool is_due(double now, double from, double period) {
  const double last = now - Simulation::kWatchPeriod;
  if (!(now > from + kSameInstant)) return false;
  return !(last > from + kSameInstant) || !(period > 0) ||
         std::floor((now - from) / period) > std::floor((last - from) / period);
}

/// A recording with only the poses from `from` on, s.
Recording poses_from(const Recording& r, double from) {
  const Series t(r.poses, 0);
  std::size_t first = 0;
  while (first < t.size() && t[first] < from - kSameInstant) ++first;
  Recording last;
  last.simulated = r.simulated;
  last.poses.columns = r.poses.columns;
  const auto begin = static_cast<std::ptrdiff_t>(first * r.poses.columns.size());
  last.poses.values.assign(r.poses.values.begin() + begin, r.poses.values.end());
  return last;
}

}  // namespace

LostCheck lost_check(std::span<const NeededMargin> needed, const Scenario& scenario, const Recording& so_far) try {
  Summary summary;
  summary.gait = gait_so_far(scenario, so_far);
  const double period = summary.gait.period;
  const double from = summary.gait.start + (period > 0 ? kPeriodsBefore * period : kLeastTime);
  if (!is_due(so_far.simulated, from, period)) return {};
  const double ran = (so_far.simulated - from) / (scenario.duration - from + period);
  summary.judged = judge_from(so_far, from);
  const double before = so_far.simulated - period - Simulation::kWatchPeriod;  // the run was judged since then, or at `from`
  const Recording poses = poses_from(so_far, before > from ? before : 0);
  summary.fall = fall(scenario, poses);
  const Overlaps found = overlaps(scenario, poses);
  const CheckedRun run{.scenario = scenario, .record = so_far, .summary = summary, .overlaps = found, .evidence = {}};
  for (const NeededMargin& one : needed) {
    const auto kind = std::ranges::find_if(check_kinds(), [&](const CheckKind& k) { return k.id == one.check; });
    if (kind == check_kinds().end() || kind->lost == Lost::never) continue;
    if (kind->span == CheckSpan::window && !(period > 0)) continue;
    const Check check = judged_check(*kind, run);
    if (is_lost(kind->lost, margin_quantity(one.quantity, check), one.least, ran)) return {check.id, check.worst};
  }
  return {};
} catch (const PluginError&) {  // the same failure ends the judgement of the whole run
  return {};
}

}  // namespace gaitlab::report
