// `gaitlab approve` prints the changes of a run, makes or keeps the bands, and writes the golden.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <system_error>

#include "app/shell/commands.h"
#include "app/shell/progress.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/recording/column_names.h"
#include "core/settings/shell_word.h"
#include "core/simulation/batch_limits.h"
#include "golden/advice.h"
#include "golden/cases.h"
#include "golden/compare.h"
#include "golden/golden.h"
#include "golden/report.h"
#include "golden/runs.h"
#include "golden/starts.h"

namespace gaitlab::app {

using namespace golden;

namespace {

struct ApproveArguments {
  std::string file;
  std::optional<std::string> reason;
  bool calibrate = false;  ///< true: make new bands; this is also done without a golden, and for a run outside its bands
  std::vector<std::string> columns =
      {};                ///< patterns of the golden's columns; empty: those of the golden before, or the usual ones
  bool replace = false;  ///< true: begin a new history and ignore an existing golden
  int jobs = 1;          ///< threads
};

namespace fs = std::filesystem;

constexpr int kEnsemble = 4;  // number of runs from which bands are made

/// Reason of the approval. Empty if there is none, or if the word is an option that was meant to follow --reason.
std::string reason(const ApproveArguments& arguments) {
  std::string text = arguments.reason.value_or("");
  return text.starts_with("--") || text.find_first_not_of(" \t\r\n") == std::string::npos ? "" : text;
}

InputError no_reason(const ApproveArguments& arguments) {
  return {SourceLocation{"--reason"},
          fmt::format("is {}; expected a sentence for the golden's history: why these numbers are right. Nothing was written",
                      !arguments.reason                     ? "missing"
                      : arguments.reason->starts_with("--") ? fmt::format("'{}', which is an option", *arguments.reason)
                                                            : "empty")};
}

/// Checks that the golden can be written at `folder`. It is called before the runs, which take minutes.
void check_target(const fs::path& folder) {
  const fs::file_type kind = kind_of(folder);
  if (kind == fs::file_type::directory || kind == fs::file_type::not_found) {
    const fs::path parent = folder.parent_path().empty() ? "." : folder.parent_path();
    const fs::path& target = kind == fs::file_type::directory ? folder : parent;
    if (::access(target.c_str(), W_OK | X_OK) == 0) return;
    throw InputError(SourceLocation{target.string()}, "cannot be written: " + std::generic_category().message(errno));
  }
  throw InputError(SourceLocation{folder.string()}, "is a file, but a golden is a folder; move this file away");
}

/// The existing golden, or nothing if it is missing or is to be replaced. Files that a killed first approval has left are
/// ignored.
std::optional<Golden> golden_before(const fs::path& folder, bool replace) {
  const auto there = [&](const char* file) { return kind_of(folder / file) != fs::file_type::not_found; };
  if (replace || (!there("golden.json") && !there("trace.golden"))) return {};
  try {
    return read_golden(folder);
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    problems.front().text += "; the golden is unchanged. gaitlab approve --replace makes a new golden with a new history";
    throw InputError(std::move(problems));
  }
}

/// Name of a column in messages, for example `m7/passive torque`.
std::string label(const GoldenRun& run, const std::string& column) { return readable_column(column, {run.joints, {}}); }

/// Throws if the trace of a run contains a number that is not finite, which a golden cannot store.
void check_finite(const GoldenRun& run, const std::string& which) {
  const Trace& trace = run.trace;
  for (std::size_t at = 0; at < trace.values.size(); ++at) {
    if (std::isfinite(trace.values[at])) continue;
    const std::size_t columns = trace.columns.size();
    throw RunError(fmt::format("{}: {} is not finite at t = {:.6g} s; nothing was written", which,
                               label(run, trace.columns[at % columns].name), trace.at(at / columns, 0)));
  }
  for (const GoldenNumber& number : run.numbers) {
    if (!std::isfinite(number.value))
      throw RunError(fmt::format("{}: {} is not finite; nothing was written", which, readable_number(number.name)));
  }
}

/// Runs the scenarios. Throws if one of them fails, before anything is written. `names` are the names of the runs in messages.
std::vector<GoldenRun> simulate(const std::vector<Scenario>& scenarios, const std::vector<std::string>& names, int jobs,
                                bool judged = false) {
  std::vector<GoldenRun> runs;
  std::vector<golden::Attempt> outcomes;
  {
    Progress progress(false);
    outcomes = golden_runs(scenarios, jobs, std::ref(progress), judged);
  }
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    try {
      if (outcomes[i].error) std::rethrow_exception(outcomes[i].error);
    } catch (const RunError& error) {
      throw RunError(fmt::format("{}: {}; nothing was written", names[i], error.what()));
    }
    check_finite(outcomes[i].run, names[i]);
    runs.push_back(std::move(outcomes[i].run));
  }
  return runs;
}

std::size_t widest_of(const std::vector<Band>& bands) {
  const auto narrower = [](const Band& a, const Band& b) { return a.width() < b.width(); };
  return static_cast<std::size_t>(std::max_element(bands.begin(), bands.end(), narrower) - bands.begin());
}

struct Calibration {
  Bands bands;
  GoldenRun halved;
};

/// Bands made from runs with several initial states and from a run with half the step.
Calibration bands_around(const GoldenRun& base, const Scenario& scenario, int jobs) {
  std::vector<Scenario> scenarios;
  std::vector<std::string> names;
  const int members = base.starts == 1 ? kEnsemble : 0;  // means over starts have their own deviations
  for (int i = 0; i < members; ++i) {
    scenarios.push_back(perturbed(scenario, i));
    names.push_back(fmt::format("{}, start {} of {} moved by 1e-7 rad", scenario.file, i + 1, members));
  }
  scenarios.push_back(scenario);
  scenarios.back().physics.refine(finer_by(scenario.physics));
  names.push_back(scenario.file + (scenario.physics.adapts() ? ", a finer accuracy" : ", half the step"));
  std::vector<GoldenRun> runs = simulate(scenarios, names, jobs);
  Bands bands = calibrate(base, std::span(runs).first(runs.size() - 1), runs.back());
  return {std::move(bands), std::move(runs.back())};
}

/// Throws if a band is so wide that it would not detect a changed motor.
void check_widest(const Calibration& made, const Scenario& scenario, int jobs) {
  const std::vector<Band>& bands = made.bands.columns;
  const std::size_t widest = widest_of(bands);
  if (bands[widest].width() <= kWidestColumn) return;
  Progress progress(false);
  const std::string remedy = narrower_columns(bands, scenario, made.halved, jobs, std::ref(progress));
  throw InputError(SourceLocation{scenario.file},
                   fmt::format("the band of {} would be {} of its {}, more than {}: {}; {}. Nothing was written",
                               label(made.halved, made.halved.trace.columns[widest].name), percent(bands[widest].width()),
                               bands[widest].constant > 0 ? "natural scale" : "range", percent(kWidestColumn),
                               parts(bands[widest]), remedy));
}

/// Prints the changes that the user should see before the run becomes the reference.
void show_change(const Golden& before, const GoldenProvenance& now, const GoldenRun& run, const GoldenDifference& change) {
  const std::string text =
      origin_changes(before.origin, now, kAllSettings) + verdict_change(before, run) + differences(change, Shown::changed);
  fmt::print("{}", since_approval(before));
  fmt::print("{}", text.empty() ? "  nothing has changed\n" : text);
}

/// True if the bands can be kept: the run is within its bands, and the golden contains equally many numbers.
bool can_keep(const Golden& before, const GoldenDifference& change, const Golden& now) {
  return change.passed() && before.numbers.size() == now.numbers.size();
}

std::uintmax_t golden_size(const fs::path& folder) {
  return fs::file_size(folder / "golden.json") + fs::file_size(folder / "trace.golden");
}

void tell(const Golden& golden, const GoldenRun& run, const fs::path& folder, bool calibrated) {
  fmt::print("{}: approval {}: {} of {}, {}, {:.0f} kB; bands {}\n", folder.string(), golden.history.back().number,
             plural(golden.bands.size() - 1, "column"), plural(golden.run.trace.rows(), "row"),
             plural(golden.numbers.size(), "number"), std::ceil(static_cast<double>(golden_size(folder)) / 1000),
             calibrated ? "made" : "kept");
  const auto line = [](const std::string& name, const Band& band) {
    fmt::print("  widest band: {} {} = {}\n", name, percent(band.width()), parts(band));
  };
  if (golden.starts > 1) {
    fmt::print(
        "  numbers are means over {} starts that differ by up to 1e-3 rad; no column is compared, because a sensor has a "
        "resolution\n",
        golden.starts);
  } else {
    const std::size_t column = widest_of(golden.bands);
    line(label(run, golden.run.trace.columns[column].name), golden.bands[column]);
  }
  const std::size_t number = widest_of(golden.number_bands);
  line(readable_number(golden.numbers[number].name), golden.number_bands[number]);
}

void check_law(const Scenario& scenario) {
  const ContactModel& contact = scenario.contact.model();
  if (contact.converges) return;
  throw InputError(scenario.place("contact.law"),
                   fmt::format("contact.law: {} has no goldens, because its torques do not converge with the step, so that a "
                               "band around them has no meaning. Approve the same scenario with contact.law: penalty",
                               contact.text));
}

/// Refuses --columns for a golden of means over starts, because such a golden contains only numbers.
void check_columns(const GoldenRun& base, const ApproveArguments& arguments) {
  if (base.starts == 1 || arguments.columns.empty()) return;
  throw InputError(SourceLocation{"--columns"}, "a sensor has a resolution, so that this golden holds numbers and no columns");
}

/// Golden of this run, still without bands and history.
Golden golden_of(const GoldenRun& base, const Scenario& scenario, const fs::path& folder) {
  Golden golden;
  golden.origin = golden_origin(scenario);
  RoundedTrace rounded = unpack(pack(base.trace), folder);
  golden.rounding = mean_squares(base.trace, rounded.trace);
  golden.run = {base.trace, std::move(rounded.precision)};
  golden.numbers = golden_numbers(base);
  golden.verdict = base.verdict.value();
  golden.starts = base.starts;
  return golden;
}

int approve(const ApproveArguments& arguments) {
  const std::string why = reason(arguments);
  const fs::path folder = own_golden(arguments.file);
  Catalog catalog = standard_catalog();
  Scenario scenario = read({arguments.file, {}, {}, true}, catalog);
  const bool more_accurate = take_golden_accuracy(scenario);
  check_target(folder);
  check_law(scenario);
  const std::optional<Golden> before = golden_before(folder, arguments.replace);
  if (why.empty() && !before) throw no_reason(arguments);
  const std::vector<std::string> selected = arguments.columns.empty() && before ? before->selected : arguments.columns;
  const Scenario traced = with_golden_columns(scenario, selected);
  GoldenRun base = simulate({traced}, {scenario.file}, arguments.jobs, true).front();
  check_columns(base, arguments);
  Golden golden = golden_of(base, scenario, folder);
  golden.selected = selected;
  bool calibrates = arguments.calibrate || !before;
  if (before) {
    const GoldenDifference change = compare(*before, base);
    show_change(*before, golden.origin, base, change);
    check_own(*before, folder, scenario, change);
    calibrates = calibrates || !can_keep(*before, change, golden);
    golden.history = before->history;
    golden.bands = before->bands;
    golden.number_bands = before->number_bands;
  }
  if (why.empty()) throw no_reason(arguments);
  golden.history.push_back({static_cast<std::int64_t>(golden.history.size()) + 1, why, golden.origin.build});
  if (calibrates) {
    base.numbers = golden.numbers;
    Calibration made = bands_around(base, traced, arguments.jobs);
    check_widest(made, traced, arguments.jobs);
    golden.bands = std::move(made.bands.columns);
    golden.number_bands = std::move(made.bands.numbers);
  }
  if (before && calibrates) fmt::print("{}", band_changes(*before, golden, base.joints));
  write_golden(golden, folder);
  tell(golden, base, folder, calibrates);
  if (more_accurate) {
    say(scenario.file, "note",
        fmt::format("the golden is a run with physics.accuracy: {}, because the scenario states none",
                    scenario.physics.accuracy));
  }
  say(wide_numbers(golden, scenario));
  return 0;
}

/// The file to approve. A scenario that comes with the program is refused.
std::string own_scenario(const std::string& word) {
  const std::string file = named_file(word);
  if (file == word) return word;
  throw InputError(
      SourceLocation{word},
      fmt::format("comes with gaitlab, but a golden is written beside its scenario; copy the scenario first: cp {} .",
                  shell_word(file)));
}

}  // namespace

void add_approve(Commands& commands) {
  add_command<ApproveArguments>(
      commands, "approve", "Record the scenario's present torques as its reference (golden), with tolerance bands.", approve,
      [](CLI::App& command, ApproveArguments& arguments) {
        command.add_option("SCENARIO", arguments.file, "scenario file (YAML)")->required()->transform(own_scenario);
        command.add_option("--reason", arguments.reason, "why these numbers are right; kept in the golden");
        command.add_flag("--calibrate", arguments.calibrate,
                         "compute new bands from further runs, even if this run is within the old bands");
        command
            .add_option("--columns", arguments.columns,
                        "columns of the trace that the golden holds, by names or patterns such as 'joint.*.torque'; default: "
                        "those of the present golden, or torque, current and angle of the joints and the pose of the base, if "
                        "trace.columns has them")
            ->expected(1)
            ->allow_extra_args(false)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        command.add_flag("--replace", arguments.replace,
                         "replace a golden that cannot be read or belongs to another scenario; the old history is lost");
        command.add_option("-j,--jobs", arguments.jobs, "threads (default 1)")->check(CLI::Range(1, kMostThreads));
      });
}

}  // namespace gaitlab::app
