#include "app/gait/run_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/files/spill.h"

namespace gaitlab::app {

namespace {

/// Number with two digits: `14`, `1100`, `0.5`.
std::string two_digits(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return fmt::format("{:g}", std::round(value / unit) * unit);
}

}  // namespace

std::string about(double seconds) {
  constexpr double kMinute = 60, kHour = 3600, kDay = 86400, kYear = 365.25 * kDay;
  if (seconds < 0.1) return "less than 0.1 s";
  if (seconds < 2 * kMinute) return "about " + two_digits(seconds) + " s";
  if (seconds < 2 * kHour) return "about " + two_digits(seconds / kMinute) + " min";
  if (seconds < 2 * kDay) return "about " + two_digits(seconds / kHour) + " h";
  if (seconds < 2 * kYear) return "about " + two_digits(seconds / kDay) + " days";
  return "about " + two_digits(seconds / kYear) + " years";
}

std::string time_text(double seconds, const std::string& advice) {
  return "takes " + about(seconds) + (advice.empty() ? "" : "; " + advice);
}

std::string faster_engine(std::span<const Scenario> scenarios, double seconds, const TimeOf& time_of, const ReadAgain& again) {
  constexpr double kWorthAdvice = 5;  // s
  const auto alone = [](const Scenario& s) { return s.physics.engine->lanes.size() == 1; };
  if (!(seconds > kWorthAdvice) || !std::ranges::any_of(scenarios, alone)) return "";
  // The second and third options are needed if the scenario states a step or an integrator.
  std::vector<std::string> sets;
  for (const char* set : {"physics.engine=articulated", "physics.step=auto", "physics.integrator=adaptive"}) {
    sets.emplace_back(set);
    try {
      const std::vector<Scenario> other = again(sets);
      if (!std::ranges::all_of(other, [](const Scenario& s) { return s.physics.adapts(); })) continue;
      const double then = time_of(other);
      if (!(then > 0 && then < seconds / 2)) return "";
      return fmt::format("engine articulated would take {} for the same equations, solved to physics.accuracy (--set {})",
                         about(then), fmt::join(sets, " --set "));
    } catch (const InputError&) {  // further options may make it acceptable
    }
  }
  return "";
}

void note_time(const std::string& place, const TimeOf& time_of, const ReadAgain& again) {
  const std::vector<Scenario> scenarios = again({});
  const double seconds = time_of(scenarios);
  const std::string advice = faster_engine(scenarios, seconds, time_of, again);
  if (seconds > kLongRun || !advice.empty()) say(place, "note", time_text(seconds, advice));
}

std::string faster_engine(const Scenario& scenario, double seconds, const RowsNeeded& rows, const ScenarioArguments& arguments,
                          Catalog& catalog) {
  return faster_engine(
      {&scenario, 1}, seconds, [&](std::span<const Scenario> all) { return estimated_seconds(all.front(), rows); },
      [&](const std::vector<std::string>& sets) {
        ScenarioArguments other = arguments;
        other.quiet = true;
        other.sets.insert(other.sets.end(), sets.begin(), sets.end());
        return std::vector{read(other, catalog)};
      });
}

void note_rows(const Scenario& scenario, const Simulation& simulation) {
  constexpr double kMuch = 1e8;  // bytes
  const RowsNeeded needed = simulation.rows_needed(0);
  if (!(needed.bytes() > kMuch)) return;
  const bool in_file = needed.bytes() > static_cast<double>(kMostInMemory);
  say(scenario.file, "note",
      fmt::format(
          "records {:.3g} rows of {:.0f} columns, {:.3g} MB in {}; a longer trace.period or fewer trace.columns reduce this",
          needed.rows, needed.columns, needed.bytes() / 1e6,
          in_file ? fmt::format("a temporary file in {} (TMPDIR)", spill_folder().string()) : "memory"));
}

}  // namespace gaitlab::app
