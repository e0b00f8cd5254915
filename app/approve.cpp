// Blesses the run of a scenario as it is now: shows what changed, makes or keeps the bands, writes the golden.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>

#include "app/app.h"
#include "app/golden_report.h"
#include "app/golden_runs.h"
#include "core/errors.h"
#include "core/trace/golden.h"
#include "core/trace/golden_compare.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;

constexpr int kEnsemble = 4;           // runs
constexpr double kWidestBand = 0.002;  // of the range; the smallest mutant that has to be seen moves a torque by 0.4 %

std::string reason(const ApproveArguments& arguments) {
  std::string text = arguments.reason.value_or("");
  if (text.find_first_not_of(" \t\r\n") != std::string::npos) return text;
  throw InputError(Place{"--reason"}, fmt::format("is {}; say in a sentence why these numbers are right: it is kept in the "
                                                  "golden's history",
                                                  arguments.reason ? "empty" : "missing"));
}

/// The golden that is there. One that cannot be read is replaced: what else is approve for.
std::optional<Golden> golden_before(const fs::path& folder) {
  if (!fs::exists(folder / "golden.json")) return {};
  try {
    return read_golden(folder);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n{}: note: it is replaced, and its history is lost\n", error.what(), folder.string());
    return {};
  }
}

/// A golden holds finite numbers only.
void check_finite(const GoldenRun& run, const std::string& which) {
  const Trace& trace = run.trace;
  for (std::size_t at = 0; at < trace.values.size(); ++at) {
    if (std::isfinite(trace.values[at])) continue;
    const std::size_t columns = trace.columns.size();
    throw RunError(fmt::format("{}: {} is not finite at t = {:.6g} s; nothing was written", which,
                               trace.columns[at % columns].name, trace.at(at / columns, 0)));
  }
  for (const Number& number : run.numbers) {
    if (!std::isfinite(number.value))
      throw RunError(fmt::format("{}: {} is not finite; nothing was written", which, number.name));
  }
}

/// The scenario itself; with bands to make also its ensemble and the run with half the step.
struct Runs {
  std::vector<GoldenRun> all;
  [[nodiscard]] const GoldenRun& base() const { return all.front(); }
};

Runs simulate(const Scenario& scenario, bool calibrate, int jobs) {
  std::vector<Scenario> scenarios{scenario};
  std::vector<std::string> names{scenario.file};
  for (int i = 0; calibrate && i < kEnsemble; ++i) {
    scenarios.push_back(perturbed(scenario, i));
    names.push_back(fmt::format("{}, start {} of {} moved by 1e-7 rad", scenario.file, i + 1, kEnsemble));
  }
  if (calibrate) {
    scenarios.push_back(scenario);
    scenarios.back().physics.step /= 2;
    names.push_back(scenario.file + ", half the step");
  }
  Runs runs;
  std::vector<Outcome> outcomes = golden_runs(scenarios, jobs);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    try {
      if (outcomes[i].error) std::rethrow_exception(outcomes[i].error);
    } catch (const RunError& error) {
      throw RunError(fmt::format("{}: {}; nothing was written", names[i], error.what()));
    }
    check_finite(outcomes[i].run, names[i]);
    runs.all.push_back(std::move(outcomes[i].run));
  }
  return runs;
}

/// A band so wide would let a changed motor pass.
void check_widest(const Golden& golden, const Scenario& scenario) {
  std::size_t widest = 0;
  for (std::size_t i = 1; i < golden.bands.size(); ++i) {
    if (golden.bands[i].width() > golden.bands[widest].width()) widest = i;
  }
  const Band& band = golden.bands[widest];
  if (band.width() <= kWidestBand) return;
  throw InputError(Place{scenario.file},
                   fmt::format("the band of {} would be {} of its range, more than {}: {}; shorten the run{}, so that less "
                               "grows from nothing. Nothing was written",
                               golden.run.trace.columns[widest].name, percent(band.width()), percent(kWidestBand), parts(band),
                               band.halving > band.ensemble ? " or take a smaller step" : ""));
}

void keep_bands(const Golden& before, const GoldenDifference& change, const fs::path& folder, Golden& golden) {
  if (!change.findings.empty() || before.numbers.size() != golden.numbers.size()) {
    throw InputError(Place{folder.string()},
                     "its bands are those of another form of run (see above); make new ones with --calibrate. "
                     "Nothing was written");
  }
  golden.bands = before.bands;
  golden.number_bands = before.number_bands;
}

/// What a pair of eyes should see before it is blessed.
void show_change(const GoldenDifference& change, const Golden& before) {
  fmt::print("since approval {} ({}):\n", before.history.size(), before.history.back().reason);
  const std::string text = differences(change, Shown::worst);
  fmt::print("{}", text.empty() ? "  nothing has changed\n" : text);
}

std::uintmax_t size_of(const fs::path& folder) {
  return fs::file_size(folder / "golden.json") + fs::file_size(folder / "trace.golden");
}

void tell(const Golden& golden, const fs::path& folder, bool calibrated) {
  const auto widest = [](const std::vector<Band>& bands) {
    const auto narrower = [](const Band& a, const Band& b) { return a.width() < b.width(); };
    return static_cast<std::size_t>(std::max_element(bands.begin(), bands.end(), narrower) - bands.begin());
  };
  fmt::print("{}: approval {}: {} of {}, {}, {:.0f} kB; bands {}\n", folder.string(), golden.history.back().number,
             plural(golden.bands.size() - 1, "column"), plural(golden.run.trace.rows(), "row"),
             plural(golden.numbers.size(), "number"), std::ceil(static_cast<double>(size_of(folder)) / 1000),
             calibrated ? "made" : "kept");
  const auto line = [](const std::string& name, const Band& band) {
    fmt::print("  widest band: {} {} = {}\n", name, percent(band.width()), parts(band));
  };
  const std::size_t column = widest(golden.bands);
  line(golden.run.trace.columns[column].name, golden.bands[column]);
  const std::size_t number = widest(golden.number_bands);
  line(golden.numbers[number].name, golden.number_bands[number]);
}

}  // namespace

int approve(const ApproveArguments& arguments) {
  const std::string why = reason(arguments);
  Catalog catalog = standard_catalog();
  const Scenario scenario = read({arguments.file, {}, {}, true}, catalog);
  const fs::path folder = golden_folder(arguments.file);
  const std::optional<Golden> before = golden_before(folder);
  const bool calibrates = arguments.calibrate || !before;
  const Runs runs = simulate(scenario, calibrates, arguments.jobs);

  Golden golden;
  golden.origin = golden_origin(scenario);
  RoundedTrace rounded = unpack(pack(runs.base().trace), folder);
  golden.rounding = mean_squares(runs.base().trace, rounded.trace);
  golden.run = {runs.base().trace, std::move(rounded.precision)};
  golden.numbers = runs.base().numbers;
  if (before) {
    const GoldenDifference change = compare(*before, runs.base());
    show_change(change, *before);
    if (!calibrates) keep_bands(*before, change, folder, golden);
    golden.history = before->history;
  }
  golden.history.push_back({static_cast<std::int64_t>(golden.history.size()) + 1, why, golden.origin.build});
  if (calibrates) {
    Bands bands = calibrate(runs.base(), golden.run.precision, std::span(runs.all).subspan(1, kEnsemble), runs.all.back());
    golden.bands = std::move(bands.columns);
    golden.number_bands = std::move(bands.numbers);
  }
  check_widest(golden, scenario);
  write_golden(golden, folder);
  tell(golden, folder, calibrates);
  return 0;
}

}  // namespace gaitlab::app
