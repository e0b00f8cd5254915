#include "app/run_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "core/errors.h"

namespace gaitlab::app {

namespace {

/// Number with two digits: `14`, `1100`, `0.5`.
std::string two_digits(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return fmt::format("{:g}", std::round(value / unit) * unit);
}

std::string duration_text(double seconds) {
  constexpr double kMinute = 60, kHour = 3600, kDay = 86400, kYear = 365.25 * kDay;
  if (seconds < 1) return "less than 1 s";
  if (seconds < 2 * kMinute) return two_digits(seconds) + " s";
  if (seconds < 2 * kHour) return two_digits(seconds / kMinute) + " min";
  if (seconds < 2 * kDay) return two_digits(seconds / kHour) + " h";
  if (seconds < 2 * kYear) return two_digits(seconds / kDay) + " days";
  return two_digits(seconds / kYear) + " years";
}

}  // namespace

RunTime measure(Simulation& simulation, double duration) {
  constexpr double kMeasured = 0.1;  // s; the number of steps is doubled until the steps have taken this time
  struct Moment {
    double used = 0, time = 0, steps = 0;
  } before, now;
  const std::clock_t start = std::clock();
  const auto used_so_far = [&] { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; };
  // The number of steps between two looks at the clock is doubled, because reading the clock can take longer than a step. The
  // later half is used, because it is more typical. If steps suddenly become slow, as on a heap of boxes, the measurement ends
  // early.
  for (std::int64_t look = 1; !simulation.done() && now.used < kMeasured; look *= 2) {
    before = now;
    while (!simulation.done() && simulation.step_number() < look) {
      simulation.step();
      if (simulation.step_number() % 8 == 0 && used_so_far() > 2 * kMeasured) break;
    }
    now = {used_so_far(), simulation.time(), static_cast<double>(simulation.step_number())};
  }
  const double used = now.used - before.used;
  if (!(used > 0 && now.time > before.time)) return {};
  return {now.used + (duration - now.time) * used / (now.time - before.time), (now.steps - before.steps) / used};
}

RunTime measure(const Scenario& scenario) try {
  Scenario start = scenario;
  start.duration = std::min(scenario.duration, 100 * scenario.control_period);
  Simulation simulation({&start, 1});
  return measure(simulation, scenario.duration);
} catch (const InputError&) {
  return {};
} catch (const RunError& error) {
  return {.failure = error.what()};
}

std::string to_string(const RunTime& time) {
  const std::string about = time.seconds < 1 ? "" : "about ";
  return fmt::format("takes {}{} on this machine ({} steps/s)", about, duration_text(time.seconds), two_digits(time.rate));
}

}  // namespace gaitlab::app
