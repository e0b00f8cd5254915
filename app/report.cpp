// `gaitlab report`: what a run came to, from its folder alone.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands.h"
#include "app/stored_scenario.h"
#include "core/errors.h"
#include "core/recording/atomic_file.h"
#include "core/recording/run_files.h"
#include "core/recording/run_folder.h"
#include "core/scenario/resolved.h"
#include "core/scenario/sections.h"
#include "report/demand.h"
#include "report/page.h"
#include "report/run_figure.h"
#include "report/summary.h"
#include "report/trust.h"
#include "report/warnings.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string run;                  ///< folder
  std::optional<std::string> out;   ///< folder for summary.json, verdict.json, figure.svg and report.html
  std::optional<std::string> page;  ///< file for a page alone
  SummaryOptions shown;
  std::vector<std::string> joints;  ///< names, of the figure
};

/// A value of the run's summary; null where there is none, or no summary that can be read.
nlohmann::json summarised(const fs::path& folder, const char* key) try {
  const nlohmann::json summary = read_summary(folder);
  const auto found = summary.find(key);
  return found != summary.end() ? *found : nlohmann::json();
} catch (const InputError&) {
  return {};
}

/// How long the simulation took, which only its summary knows; 0 where it does not.
double wall_time(const fs::path& folder) {
  const nlohmann::json value = summarised(folder, "wall_time");
  const double seconds = value.is_number() ? value.get<double>() : 0;
  return std::isfinite(seconds) && seconds >= 0 ? seconds : 0;
}

/// What a folder does not hold, told without naming it.
std::vector<std::string> told_missing(std::vector<std::string> missing, const fs::path& trace) {
  for (std::string& sentence : missing) {
    if (sentence.starts_with(trace.string())) sentence.replace(0, trace.string().size(), trace.filename().string());
  }
  return missing;
}

/// What the run's own `--demand` found, which no recording holds.
void keep_demand(report::Verdict& verdict, const fs::path& file) {
  if (kind_of(file) != fs::file_type::regular || report::take_demand(verdict, read_file(file))) return;
  fmt::print(stderr, "{}: note: is not of this recording, so that what --demand found there is left out\n", file.string());
}

int report(const ReportArguments& arguments) {
  const fs::path trace = trace_file(arguments.run);
  const fs::path folder = trace.parent_path();
  if (arguments.page) check_page(*arguments.page, folder / kPageFile);
  Catalog catalog = standard_catalog();
  auto [read, scenario] = read_run(arguments.run, catalog);
  Recording& recording = read.recording;
  draw_joints(scenario, arguments.joints);
  if (arguments.out && !read.missing.empty()) {
    throw InputError(
        SourceLocation{arguments.run},
        fmt::format(
            "summary and figure cannot be made anew: {}; a page can: --page FILE; or simulate it again: gaitlab rerun {}",
            fmt::join(read.missing, "; "), arguments.run));
  }
  // A CSV file alone does not have it.
  const nlohmann::json told = read.origin.outcome.empty() ? summarised(folder, "outcome") : nlohmann::json(recording.outcome);
  if (told.is_string()) recording.outcome = told;
  report::Summary summary = report::summarise(scenario, recording, wall_time(folder));
  summary.build = read.origin.build;
  const report::Overlaps overlaps = report::overlaps(scenario, recording);
  report::Verdict verdict = judged(scenario, recording, summary, overlaps, arguments.shown);
  if (!arguments.shown.demand) keep_demand(verdict, folder / "verdict.json");
  std::string page;
  if (arguments.out || arguments.page) {
    page = report::page(report::page_data(scenario, recording, summary, verdict, told_missing(read.missing, trace)));
  }
  if (arguments.page) write_file(*arguments.page, page);
  if (arguments.out) {
    RunFolder out(*arguments.out, scenario.name);
    write_file(out.path() / "figure.svg", report::run_figure(scenario, recording, summary));
    write_file(out.path() / "verdict.json", report::to_json(verdict));
    write_file(out.path() / kPageFile, page);
    write_file(out.path() / "summary.json", report::to_json(summary, scenario, recording));
    out.keep();
  }
  print_summary(scenario, recording, summary, verdict, arguments.shown);
  if (arguments.out) {
    fmt::print("  {:<13} {}: summary.json, verdict.json, figure.svg\n", "files", *arguments.out);
    print_page(fs::path(*arguments.out) / kPageFile);
  }
  if (arguments.page) print_page(*arguments.page);
  for (const std::string& missing : read.missing) fmt::print(stderr, "{}: note: {}\n", arguments.run, missing);
  if (recording.outcome != "done") {
    fmt::print(stderr, "{}: note: this run ended early: {}\n", arguments.run, recording.outcome);
  }
  warn_of_run(scenario, recording, summary, overlaps);
  return exit_code(verdict, arguments.shown);
}

}  // namespace

void print_summary(const Scenario& scenario, const Recording& recording, const report::Summary& summary,
                   const report::Verdict& verdict, const SummaryOptions& shown) {
  const std::string text = report::to_text(summary, scenario, recording, shown.verbose);
  const std::size_t head = text.find('\n') + 1;
  fmt::print("{}", text.substr(0, head));
  const char* title = "verdict";
  for (const std::string& line : report::to_lines(verdict)) {
    fmt::print("  {:<13} {}\n", title, line);
    title = "";
  }
  fmt::print("{}", text.substr(head));
  if (shown.joints) fmt::print("{}", report::joint_table(summary, scenario));
}

report::Verdict judged(const Scenario& scenario, const Recording& recording, const report::Summary& summary,
                       const report::Overlaps& overlaps, const SummaryOptions& shown) {
  report::Verdict verdict = report::verdict(scenario, recording, summary, overlaps);
  if (!shown.demand || Judged::limited(summary.judged.joints) == 0) return verdict;
  Catalog catalog = standard_catalog();
  const StoredScenario same{"", scenario.file + " (its demand twin)", resolved(scenario)};
  Scenario twin = read_stored(same, catalog, OtherPlugins::taken);
  if (!report::raise_limits(twin)) {
    verdict.demand_doubt = "the actuator declares no limits above 0 that could be raised";
    return verdict;
  }
  report::add_demand(verdict, scenario, summary, report::demand(twin, recording, summary));
  return verdict;
}

int exit_code(const report::Verdict& verdict, const SummaryOptions& shown) {
  if (!shown.fail_infeasible) return 0;
  return verdict.word == "failed" ? 1 : verdict.word == "infeasible" ? 3 : 0;
}

void add_shown(CLI::App& command, SummaryOptions& shown) {
  command.add_flag("--joints", shown.joints, "print a row per joint, the most loaded first");
  command.add_flag("--fail-infeasible", shown.fail_infeasible,
                   "exit code 3 where the verdict is infeasible, 1 where the run failed");
  command.add_flag("--demand", shown.demand,
                   "simulate once more without the limits of the motors where joints reach them, and tell how much is missing");
  command.add_flag("--verbose", shown.verbose, "print the energy ledger and the limit of the step, too");
}

void add_joint(CLI::App& command, std::vector<std::string>& joints) {
  command.add_option("--joint", joints, "joint to draw in figure.svg, by name; once per joint (default: the most loaded one)")
      ->allow_extra_args(false);
}

void draw_joints(Scenario& scenario, const std::vector<std::string>& joints) {
  std::vector<Problem> problems;
  for (const std::string& name : joints) {
    if (const std::string wrong = no_joint(name, joint_names(*scenario.robot)); !wrong.empty())
      problems.push_back({SourceLocation{"--joint " + name}, wrong});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  if (!joints.empty()) scenario.figure.joints = joints;
}

void warn_of_run(const Scenario& scenario, const Recording& recording, const report::Summary& summary,
                 const report::Overlaps& overlaps) {
  if (const std::string fall = report::fall_warning(scenario, recording); !fall.empty())
    fmt::print(stderr, "{}: warning: {}\n", scenario.file, fall);
  const std::string where = to_string(scenario.place("physics.step"));
  const std::string warning = report::stability_warning(summary, scenario, recording);
  if (!warning.empty()) fmt::print(stderr, "{}: warning: {}\n", where, warning);
  for (const report::Warning& doubt : report::run_warnings(scenario, recording, overlaps))
    fmt::print(stderr, "{}: warning: {}\n", to_string(doubt.place), doubt.text);
  if (recording.outcome != "done") return;
  for (const std::string& doubt : report::trust_warnings(scenario, recording))
    fmt::print(stderr, "{}: warning: {}\n", where, doubt);
}

void add_report(Commands& commands) {
  add_command<ReportArguments>(
      commands, "report", "Print the summary of a run folder again, without simulating.", report,
      [](CLI::App& command, ReportArguments& arguments) {
        command.add_option("RUN", arguments.run, "run folder")->required()->check(not_empty);
        command.add_option("--out", arguments.out,
                           "folder for summary.json, verdict.json, figure.svg and report.html, made anew; new or empty");
        command.add_option("--page", arguments.page, "file for the page alone; new, or the run's report.html")
            ->check(not_empty);
        add_joint(command, arguments.joints);
        command.get_option("--joint")->needs("--out");
        add_shown(command, arguments.shown);
      });
}

}  // namespace gaitlab::app
