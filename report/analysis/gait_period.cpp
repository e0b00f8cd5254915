#include "report/analysis/gait_period.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/plugin/plugin_instance.h"
#include "core/scenario/change_section.h"
#include "core/scenario/sections.h"
#include "core/settings/writer.h"
#include "core/simulation/simulation.h"
#include "report/analysis/cpg_alone.h"
#include "report/analysis/motion.h"

namespace gaitlab::report {

namespace {

constexpr double kFarEnough = 120;          // s: two periods of a slow gait, after its start
constexpr double kLongerThanTheRun = 5;     // factor on the run's duration
constexpr std::int64_t kMostTicks = 20000;  // simulated ticks of the CPG alone, which take about 0.1 s
constexpr std::int64_t kMostRows = 4000;    // largest number of rows in the search for a period
constexpr double kTwice = 2;                // least length of the CPG alone, in lengths of the run
constexpr double kTwoPeriods = 2.25;        // and in periods: the search compares the last two
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

/// The CPG of a scenario without its robot, for longer than a run. The last ones are kept, because many runs of a table, and
/// the judgements of one run, have the same CPG.
struct LookAhead {
  std::string key;
  std::weak_ptr<const Robot> robot;
  std::shared_ptr<const std::vector<double>> alone;  ///< set points until the end of the run
  std::optional<MotionCycle> cycle;                  ///< nothing before the search
};

struct LookAheads {
  std::mutex mutex;
  std::deque<LookAhead> last;
};
LookAheads& look_aheads() {
  static auto* const made = new LookAheads;  // never destroyed: threads may judge runs at exit
  return *made;
}

/// All that the CPG alone depends on, except for the robot.
std::string look_ahead_key(const Scenario& s, const Recording& r) {
  const std::vector<std::string> joints = joint_names(*s.robot);
  Writer writer(joints);
  visit_settings(*s.cpg.entry, s.cpg.settings.get(), writer);
  std::string key = fmt::format("{} {} {} {} {} {}", s.cpg.entry->origin, s.cpg.entry->name, s.control_period, s.cpg_step,
                                s.sensors.size(), r.simulated);
  for (std::size_t j = 0; j < joints.size(); ++j) key += fmt::format(" {}", s.initial.angles[j]);
  return key + "\n" + print_yaml(writer.take());
}

std::optional<LookAhead> kept_look_ahead(const std::string& key, const Scenario& s) {
  LookAheads& all = look_aheads();
  const std::lock_guard lock(all.mutex);
  const auto at =
      std::ranges::find_if(all.last, [&](const LookAhead& one) { return one.key == key && one.robot.lock() == s.robot; });
  return at == all.last.end() ? std::nullopt : std::optional(*at);
}

void keep_look_ahead(LookAhead one) {
  constexpr std::size_t kMost = 16;
  LookAheads& all = look_aheads();
  const std::lock_guard lock(all.mutex);
  all.last.push_front(std::move(one));
  if (all.last.size() > kMost) all.last.pop_back();
}

/// Cycle at the end of the first `ticks` rows of the CPG alone.
MotionCycle cycle_of(const std::vector<double>& alone, std::size_t columns, std::int64_t ticks, double period) {
  // Fast gaits need every tick, slow ones the whole duration.
  for (const std::int64_t every : {std::int64_t{1}, (ticks + kMostRows - 1) / kMostRows}) {
    std::vector<double> rows;
    for (std::int64_t k = std::max<std::int64_t>(0, ticks - kMostRows * every); k < ticks; k += every) {
      const auto from = alone.begin() + k * static_cast<std::ptrdiff_t>(columns);
      rows.insert(rows.end(), from, from + static_cast<std::ptrdiff_t>(columns));
    }
    const MotionCycle found = find_limit_cycle(rows, columns, static_cast<double>(every) * period);
    if (found.found || every == (ticks + kMostRows - 1) / kMostRows) return found;
  }
  return {};
}

/// Cycle of the CPG without its robot, simulated for longer than the run: first for as long as its least frequency needs, then
/// for twice as long, up to the limits above. Nothing if feedback changes the set points, or if this cannot be found out.
std::optional<MotionCycle> cycle_alone(const Scenario& s, const Recording& r) try {
  const std::vector<Series> recorded = set_points(s, r);
  const double seconds = std::max(kFarEnough, kLongerThanTheRun * r.simulated);
  const auto most = std::min(kMostTicks, static_cast<std::int64_t>(seconds / s.control_period));
  if (recorded.empty() || static_cast<double>(most) * s.control_period < kLongerThanTheRun * r.simulated) return {};
  LookAhead found{look_ahead_key(s, r), s.robot, {}, {}};
  if (const std::optional<LookAhead> before = kept_look_ahead(found.key, s)) found = *before;
  if (found.alone && !recorded_so(s, r, *found.alone, recorded)) return {};
  if (found.cycle) return found.cycle;
  const double frequency = least_frequency(s);
  const double first = std::max(kTwice * r.simulated, frequency > 0 ? kTwoPeriods / frequency : 0) / s.control_period;
  for (auto ticks = static_cast<std::int64_t>(std::min(std::ceil(first) + 1, static_cast<double>(most)));;
       ticks = std::min(2 * ticks, most)) {
    std::vector<double> alone = set_points_alone(s, ticks);
    if (StopsCpgAlone::asked()) return {};
    found.cycle = cycle_of(alone, recorded.size(), ticks, s.control_period);
    if (!found.alone) {
      const double rows = std::ceil(r.simulated / s.control_period) + 1;
      alone.resize(std::min(alone.size(), static_cast<std::size_t>(rows) * recorded.size()));
      found.alone = std::make_shared<const std::vector<double>>(std::move(alone));
      if (!recorded_so(s, r, *found.alone, recorded)) {
        found.cycle.reset();
        keep_look_ahead(found);
        return {};
      }
    }
    if (!found.cycle->found && ticks < most) continue;
    keep_look_ahead(found);
    return found.cycle;
  }
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
  // Code of another language, such as Python, takes long, and may wait for a user: it is not called beyond the run.
  if (s.cpg.entry->context == nullptr) {
    if (const std::optional<MotionCycle> alone = cycle_alone(s, r)) return alone->found ? alone->period : 0;
  }
  const double frequency = least_frequency(s);
  return frequency > 0 && r.simulated * frequency < kPeriodsNeeded ? 1 / frequency : 0;
}

}  // namespace gaitlab::report
