#include "report/analysis/look_ahead.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <mutex>
#include <optional>
#include <string>

#include "core/errors.h"
#include "core/scenario/change_section.h"
#include "core/scenario/sections.h"
#include "report/analysis/cpg_alone.h"
#include "report/analysis/motion.h"

namespace gaitlab::report {

namespace {

constexpr double kFarEnough = 120;           // s: two periods of a slow gait, after its start
constexpr double kLongerThanTheRun = 5;      // factor on the run's duration
constexpr std::int64_t kMostTicks = 20000;   // most ticks after the run, or in the search for a period; they take about 0.1 s
constexpr std::int64_t kMostOfRun = 200000;  // most ticks of a run
constexpr std::int64_t kMostRows = 4000;     // largest number of rows in the search for a period
constexpr double kSameSetPoint = 1e-5;       // rad; recorded set points are single precision
constexpr double kNoBound = std::numeric_limits<double>::infinity();

using Ahead = std::shared_ptr<const LookAhead>;

/// A result, and the data that it depends on. The result is null if feedback changes the set points.
struct Kept {
  std::string key;
  std::weak_ptr<const Robot> robot;
  Ahead ahead;
};

struct Store {
  std::mutex mutex;
  std::deque<Kept> last;
};
Store& store() {
  static auto* const made = new Store;  // never destroyed: threads may judge runs at exit
  return *made;
}

std::optional<Ahead> kept(const std::string& key, const Scenario& s) {
  Store& all = store();
  const std::lock_guard lock(all.mutex);
  const auto at =
      std::ranges::find_if(all.last, [&](const Kept& one) { return one.key == key && one.robot.lock() == s.robot; });
  return at == all.last.end() ? std::nullopt : std::optional(at->ahead);
}

void keep(Kept one) {
  constexpr std::size_t kMost = 16;
  Store& all = store();
  const std::lock_guard lock(all.mutex);
  all.last.push_front(std::move(one));
  if (all.last.size() > kMost) all.last.pop_back();
}

/// True if feedback changed no recorded set point: all are equal to the set points of the CPG `alone`. The set point in a row
/// was in force just before the time of the row.
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

/// Cycle at the end of the first `ticks` rows of the CPG alone.
MotionCycle cycle_of(const std::vector<double>& alone, std::size_t columns, std::int64_t ticks, double period) {
  // The search first takes every tick, for fast gaits, and then the whole duration, for slow gaits.
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

/// Numbers of ticks of the CPG alone.
struct Lengths {
  std::int64_t run = 0;    ///< during the run
  std::int64_t after = 0;  ///< after the run, if no other period is found
  std::int64_t most = 0;   ///< largest number in the search for a period, including the run
};

/// Number of ticks, at most kMostTicks.
std::int64_t ticks_of(double seconds, const Scenario& s) {
  return static_cast<std::int64_t>(std::min(std::ceil(seconds / s.control_period), static_cast<double>(kMostTicks)));
}

Lengths lengths(const Scenario& s, double simulated, double period, double stated) {
  Lengths of{static_cast<std::int64_t>(std::ceil(simulated / s.control_period)) + 1};
  const double known = period > 0 ? period : stated;
  of.after = ticks_of(known > 0 ? kPeriodsNeeded * known : simulated, s);
  of.most = std::max(of.run + of.after, ticks_of(std::max(kFarEnough, kLongerThanTheRun * simulated), s));
  return of;
}

std::vector<std::pair<double, double>> after_run(const Scenario& s, const std::vector<double>& alone, std::int64_t run,
                                                 std::int64_t last) {
  std::vector<std::pair<double, double>> all;
  const std::vector<bool> free = turning_freely(*s.robot);
  for (std::size_t c = 0; c < free.size(); ++c) {
    all.push_back(extremes(alone, free.size(), c, static_cast<std::size_t>(run) - 1, static_cast<std::size_t>(last), free[c],
                           s.control_period));
  }
  return all;
}

}  // namespace

std::vector<bool> turning_freely(const Robot& robot) {
  std::vector<bool> all;
  for (const Joint& joint : robot.joints) {
    if (joint.driven()) all.push_back(joint.turns_freely());
  }
  return all;
}

std::pair<double, double> extremes(const std::vector<double>& rows, std::size_t columns, std::size_t column, std::size_t first,
                                   std::size_t last, bool rates, double spacing) {
  std::pair<double, double> found = rates ? std::pair(0.0, 0.0) : std::pair(kNoBound, -kNoBound);
  for (std::size_t k = first + (rates ? 1 : 0); k < last; ++k) {
    const double here = rows[k * columns + column];
    const double value = rates ? (here - rows[(k - 1) * columns + column]) / spacing : here;
    found = {std::min(found.first, value), std::max(found.second, value)};
  }
  return found;
}

std::shared_ptr<const LookAhead> look_ahead(const Scenario& s, const Recording& r, double period, double stated) try {
  const std::vector<Series> recorded = set_points(s, r);
  if (recorded.empty() || s.cpg.entry->context != nullptr || last_change(s, r.simulated) > 0) return {};
  const Lengths of = lengths(s, r.simulated, period, stated);
  if (of.run > kMostOfRun) return {};
  const std::string key = fmt::format("{} {}", r.simulated, key_of_cpg(s));
  if (const std::optional<Ahead> before = kept(key, s)) {
    return *before && recorded_so(s, r, (*before)->in_run, recorded) ? *before : nullptr;
  }
  LookAhead made;
  CpgAlone cpg = CpgAlone::found(s);
  for (std::int64_t ticks = of.run + of.after;; ticks = std::min(2 * ticks, of.most)) {
    const std::vector<double>& alone = cpg.rows(ticks);
    if (StopsCpgAlone::asked()) return {};
    if (!recorded_so(s, r, alone, recorded)) {
      keep({key, s.robot, nullptr});
      return {};
    }
    if (!(period > 0)) made.cycle = cycle_of(alone, recorded.size(), ticks, s.control_period);
    if (!(period > 0) && !made.cycle.found && ticks < of.most) continue;
    const std::int64_t after = made.cycle.found ? ticks_of(kPeriodsNeeded * made.cycle.period, s) : of.after;
    made.after_run = after_run(s, alone, of.run, std::min(of.run + after, ticks));
    made.until = static_cast<double>(ticks) * s.control_period;
    made.in_run = cpg.take();
    made.in_run.resize(static_cast<std::size_t>(of.run) * recorded.size());
    std::shared_ptr<const LookAhead> found = std::make_shared<const LookAhead>(std::move(made));
    keep({key, s.robot, found});
    return found;
  }
} catch (const PluginError&) {  // a CPG may fail after the end of the run
  return {};
}

}  // namespace gaitlab::report
