#include "golden/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/recording/column_names.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/wording.h"
#include "core/simulation/step_advice.h"
#include "golden/report.h"
#include "golden/runs.h"
#include "golden/starts.h"

namespace gaitlab::golden {

namespace {

constexpr double kMargin = 0.9;       // factor below 1, because the measured order may differ at other steps
constexpr double kLeastOrder = 0.25;  // below this order, a finer step hardly helps
constexpr std::size_t kMostExplained = 3;

double widest(const std::vector<Band>& bands, double Band::*part) {
  double most = 0;
  for (const Band& band : bands) most = std::max(most, band.*part);
  return most;
}

/// Largest number 1, 2, 2.5 or 5 times a power of ten that is at most `limit`.
double round_below(double limit) {
  const double decade = std::pow(10, std::floor(std::log10(limit)));
  for (const double mantissa : {5.0, 2.5, 2.0}) {
    if (mantissa * decade <= limit) return mantissa * decade;
  }
  return decade;
}

/// Width of the widest band that results from halving the step.
double halving_band(const GoldenRun& base, const GoldenRun& halved) {
  return widest(calibrate(base, {}, halved).columns, &Band::halving);
}

std::string setting_text(double setting) { return fmt::format("{:.12g}", setting); }

/// Text such as `physics.step: 5e-05 (...)` with the setting that should pass. It is computed from the bands at the scenario's
/// setting and at a finer setting.
std::string finer_setting(const Scenario& scenario, double band, double finer_band) {
  const Physics& physics = scenario.physics;
  const bool adapts = physics.adapts();
  const double by = finer_by(physics);
  const char* key = adapts ? "physics.accuracy" : "physics.step";
  const double now = adapts ? physics.accuracy : physics.step;
  const std::string finer = setting_text(now / by);
  if (finer_band <= kWidestColumn) return fmt::format("{}: {} (there the band is {})", key, finer, percent(finer_band));
  const std::string seen = fmt::format("at {} the band is {}", finer, percent(finer_band));
  double order = std::log(band / finer_band) / std::log(by);
  if (!(order > kLeastOrder)) return fmt::format("a shorter run, because a smaller {} hardly helps ({})", key, seen);
  if (physics.integrator->order > 0) order = std::min<double>(order, physics.integrator->order);
  const double wanted = now * std::pow(kMargin * kWidestColumn / band, 1 / order);
  const double nice = adapts ? round_below(wanted) : usable_step(scenario, wanted);
  if (nice == 0) return fmt::format("a {} of at most {:.2g} ({})", key, wanted, seen);
  return fmt::format("{}: {} ({}, so its order is {:.2g})", key, setting_text(nice), seen, order);
}

/// The scenario with given steps and the integrator `extrapolated`. Nothing if the engine lacks this integrator, or if the
/// scenario's integrator has the same order.
std::optional<Scenario> extrapolated(const Scenario& scenario) {
  const Integrator* other = scenario.physics.engine->integrator("extrapolated");
  if (other == nullptr || scenario.physics.integrator->order >= other->order) return {};
  Scenario made = scenario;
  if (scenario.physics.adapts()) made.physics.step = usable_step(scenario, scenario.physics.engine->step);
  if (made.physics.step == 0) return {};
  made.physics.adaptive_step = false;
  made.physics.integrator = other;
  return made;
}

std::vector<std::size_t> wide(const Golden& golden) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < golden.numbers.size(); ++i) {
    if (golden.number_bands[i].width() > kWideNumber) found.push_back(i);
  }
  std::stable_sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
    return golden.number_bands[a].width() > golden.number_bands[b].width();
  });
  return found;
}

/// Reason for the width of a number's band, and the remedy.
std::string explanation(const GoldenNumber& number, const Band& band, const Scenario& scenario) {
  if (band.ensemble > band.halving && quantised(scenario)) {
    return fmt::format(
        "the band is {} standard errors of the difference of two means over {} starts; a longer run has less spread. If a "
        "sensor has noise of the deviation resolution/sqrt(12) in place of its resolution, the golden needs only one run",
        kStandardErrors, kStarts);
  }
  if (band.ensemble > band.halving) {
    return fmt::format(
        "starts that differ by 1e-7 rad change this number by {}, and the band is ten times this change; shorten the run, in "
        "which small differences grow",
        percent(band.ensemble / kEnsembleFactor));
  }
  const bool adapts = scenario.physics.adapts();
  std::string text =
      fmt::format("{} changes this number by {}, and the band is three times this change; ",
                  adapts ? "a tenth of physics.accuracy" : "half the step", percent(band.halving / kHalvingFactor));
  text += adapts ? "make physics.accuracy smaller" : "take a smaller step";
  if (!number.at_start) return text;
  return text + fmt::format(
                    "; the peak occurs at the start (t = {:.3g} s), not in the gait: if the first set points are far from "
                    "initial.angles, other initial angles may help",
                    *number.at_start);
}

/// Text with the step at which integrator `extrapolated` should pass, computed from its band at `step`. "" if no step suffices.
std::string extrapolated_setting(const Scenario& scenario, double step, double band) {
  const bool passes = band <= kWidestColumn;
  // The order of this integrator is 2, but intermittent contacts reduce it.
  const double smaller = passes ? step : usable_step(scenario, kMargin * kWidestColumn / band * step);
  if (smaller == 0) return "";
  return fmt::format("physics.integrator: extrapolated with physics.step: {} ({} the band is {})", setting_text(smaller),
                     passes ? "there" : "at " + setting_text(step), percent(band));
}

}  // namespace

double finer_by(const Physics& physics) { return physics.adapts() ? 10 : 2; }

std::string narrower_columns(const std::vector<Band>& columns, const Scenario& scenario, const GoldenRun& halved, int jobs,
                             const std::function<void(double)>& progress) {
  if (widest(columns, &Band::ensemble) > kWidestColumn) return "shorten the run, in which small differences grow";
  std::vector<Scenario> scenarios{scenario};
  scenarios.front().physics.refine(finer_by(scenario.physics) * finer_by(scenario.physics));
  if (const std::optional<Scenario> other = extrapolated(scenario)) {
    scenarios.insert(scenarios.end(), 2, *other);
    scenarios.back().physics.refine(2);
  }
  const std::vector<Attempt> runs = golden_runs(scenarios, jobs, progress);
  const std::string own = runs[0].error
                              ? "a smaller step"
                              : finer_setting(scenario, widest(columns, &Band::halving), halving_band(halved, runs[0].run));
  if (runs.size() == 1 || runs[1].error || runs[2].error) return "take " + own;
  const std::string other = extrapolated_setting(scenario, scenarios[1].physics.step, halving_band(runs[1].run, runs[2].run));
  if (other.empty()) return "take " + own;
  // Order 2 is the cheaper remedy if the steps are given.
  return "take " + (scenario.physics.adapts() ? own + ", or " + other : other + ", or " + own);
}

std::string wide_numbers(const Golden& golden, const Scenario& scenario) {
  const std::vector<std::size_t> found = wide(golden);
  const std::vector<double> scale = scales(golden.numbers);
  std::string text;
  for (std::size_t k = 0; k < std::min(found.size(), kMostExplained); ++k) {
    const GoldenNumber& number = golden.numbers[found[k]];
    const Band& band = golden.number_bands[found[k]];
    const double most = number.value + std::copysign(band.width() * scale[found[k]], number.value);
    const auto with_its_unit = [&](double value) {
      return fmt::format("{:.3g}{}{}", value, number.unit.empty() ? "" : " ", number.unit);
    };
    text += fmt::format("{}: warning: the band of {} is {}: {} would pass gaitlab test, although {} was approved; {}\n",
                        scenario.file, readable_number(number.name), percent(band.width()), with_its_unit(most),
                        with_its_unit(number.value), explanation(number, band, scenario));
  }
  if (found.size() > kMostExplained) {
    text += fmt::format("{}: warning: ... and {} with bands above {}\n", scenario.file,
                        plural(found.size() - kMostExplained, "more number"), percent(kWideNumber));
  }
  return text;
}

std::string wide_number_names(const Golden& golden) {
  const std::vector<std::size_t> found = wide(golden);
  std::vector<std::string> names;
  names.reserve(found.size());
  for (const std::size_t i : found) {
    names.push_back(fmt::format("{} {}", readable_number(golden.numbers[i].name), percent(golden.number_bands[i].width())));
  }
  return joined(names);
}

}  // namespace gaitlab::golden
