#include "report/analysis/gait_period.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "core/plugin/plugin_instance.h"
#include "core/scenario/change_section.h"
#include "core/simulation/simulation.h"
#include "report/analysis/cpg_alone.h"
#include "report/analysis/motion.h"

namespace gaitlab::report {

namespace {

constexpr double kFarEnough = 120;          // s: two periods of a slow gait, after its start
constexpr double kLongerThanTheRun = 5;     // factor on the run's duration
constexpr std::int64_t kMostTicks = 20000;  // simulated ticks of the CPG alone, which take about 0.1 s
constexpr std::int64_t kMostRows = 4000;    // largest number of rows in the search for a period
constexpr double kSameSetPoint = 1e-5;      // rad; recorded set points are single precision

/// Least frequency of a driven joint in the CPG's settings, Hz; 0 if there is none.
double least_frequency(const Scenario& s) {
  const std::vector<double> all = frequencies(s, s.changes.empty() ? s.cpg : s.changes.back().cpg);
  return all.empty() ? 0 : *std::min_element(all.begin(), all.end());
}

/// True if feedback changed no recorded set point: all are equal to those of the CPG `alone`. The set point in a row was in
/// force just before the time of the row.
bool recorded_so(const Scenario& s, const Recording& r, const std::vector<double>& alone, const std::vector<Series>& recorded) {
  const Series t = motion(r).t;
  for (std::size_t row = 1; row < t.size(); ++row) {
    const auto tick = static_cast<std::size_t>(std::max(0.0, std::ceil(t[row] / s.control_period - 1e-6) - 1));
    for (std::size_t c = 0; c < recorded.size(); ++c) {
      const std::size_t at = tick * recorded.size() + c;
      if (at >= alone.size() || !(std::abs(recorded[c][row] - alone[at]) <= kSameSetPoint)) return false;
    }
  }
  return true;
}

/// Cycle of the CPG without its robot, simulated for longer than the run. Nothing if feedback changes the set points, or if
/// this cannot be found out.
std::optional<MotionCycle> cycle_alone(const Scenario& s, const Recording& r) try {
  const std::vector<Series> recorded = set_points(s, r);
  const double seconds = std::max(kFarEnough, kLongerThanTheRun * r.simulated);
  const auto ticks = std::min(kMostTicks, static_cast<std::int64_t>(seconds / s.control_period));
  if (recorded.empty() || static_cast<double>(ticks) * s.control_period < kLongerThanTheRun * r.simulated) return {};
  const std::vector<double> alone = set_points_alone(s, ticks);
  if (!recorded_so(s, r, alone, recorded)) return {};
  // Fast gaits need every tick, slow ones the whole duration.
  for (const std::int64_t every : {std::int64_t{1}, (ticks + kMostRows - 1) / kMostRows}) {
    std::vector<double> rows;
    for (std::int64_t k = std::max<std::int64_t>(0, ticks - kMostRows * every); k < ticks; k += every) {
      const auto from = alone.begin() + k * static_cast<std::ptrdiff_t>(recorded.size());
      rows.insert(rows.end(), from, from + static_cast<std::ptrdiff_t>(recorded.size()));
    }
    const MotionCycle found = find_limit_cycle(rows, recorded.size(), static_cast<double>(every) * s.control_period);
    if (found.found) return found;
  }
  return MotionCycle();
} catch (const PluginError&) {  // a CPG may fail after the end of the run
  return {};
}

}  // namespace

double set_point_period(const Scenario& s, const Recording& r) {
  if (s.cpg.entry == nullptr) return 0;
  if (const MotionCycle seen = set_point_cycle(s, r); seen.found) return seen.period;
  const double since = last_change(s, r.simulated);
  if (since > 0) {  // the CPG alone starts as the run does
    const double frequency = least_frequency(s);
    return frequency > 0 && (r.simulated - since) * frequency < kPeriodsNeeded ? 1 / frequency : 0;
  }
  if (const std::optional<MotionCycle> alone = cycle_alone(s, r)) return alone->found ? alone->period : 0;
  const double frequency = least_frequency(s);
  return frequency > 0 && r.simulated * frequency < kPeriodsNeeded ? 1 / frequency : 0;
}

}  // namespace gaitlab::report
