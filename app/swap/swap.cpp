// `gaitlab swap`, which runs scenarios under several CPGs: a table, a figure for each scenario, and the numbers as CSV and
// JSON.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/gait/run_time.h"
#include "app/shell/stop_on_signal.h"
#include "app/study/study_text.h"
#include "app/swap/swapped.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/recording/run_folder.h"
#include "core/simulation/batch_limits.h"
#include "golden/report.h"
#include "report/figures/run/coincide.h"
#include "report/figures/run/figure.h"
#include "report/page/page.h"
#include "report/page/swap_page.h"

namespace gaitlab::app {

namespace {

std::vector<report::NamedRun> named_runs(const std::vector<Swapped>& all) {
  std::vector<report::NamedRun> runs;
  for (const Swapped& one : all) runs.push_back({one.cpg, {*one.scenario, one.record, one.summary}});
  return runs;
}

// ---- the figure

/// Figure of the travel and, if the most loaded joint under the first CPG has a motor, of its set point and torque.
report::CurvesInput figure(const std::vector<Swapped>& all) {
  const Scenario& first = *all.front().scenario;
  report::CurvesInput input;
  input.title = fmt::format("{} under {}", first.name, golden::plural(all.size(), "CPG"));
  report::CurvesPanel setpoint{"set point"};
  report::CurvesPanel torque{"torque"};
  report::CurvesPanel travel{"travel of the centre of mass along x (m)"};
  const std::size_t joint = all.front().summary.most_loaded();
  const bool driven = report::has_motors(first) && first.robot->joints[joint].driven();
  if (driven) {
    const std::string where = fmt::format(" of joint {} ({})", joint, first.robot->joints[joint].name);
    setpoint.title += where + " (rad)";
    torque.title += where + " (N m)";
  }
  setpoint.from = torque.from = std::max(0.0, first.duration - report::kShownSeconds);
  for (const Swapped& swapped : all) {
    const Recording& r = swapped.record;
    input.names.push_back(swapped.cpg);
    std::vector<double>& time = input.time.emplace_back();
    std::vector<double>& way = travel.values.emplace_back();
    const Series x = r.series("com.x");
    for (std::size_t k = 0; k < x.size(); ++k) {
      time.push_back(std::min(static_cast<double>(k) * first.trace.period, swapped.summary.simulated));
      way.push_back(x[k] - x.front());
    }
    if (!driven) continue;
    setpoint.values.push_back(r.joint(joint, "setpoint").values());
    torque.values.push_back(r.joint(joint, "torque").values());
  }
  if (driven) {
    input.panels = {setpoint, torque};
    input.coincide = report::coinciding(input.time, input.panels);
  }
  input.panels.push_back(travel);
  return input;
}

void print_verdicts(const std::vector<Swapped>& all) {
  for (const Swapped& one : all) {
    const std::string why = one.verdict.why();
    fmt::print("{}: {}{}\n", one.cpg, name_of(one.verdict.word), why.empty() ? "" : ": " + why);
  }
}

/// Writes a page CPG.html for every run, and swap.html with links to them.
void write_pages(const std::vector<Swapped>& all, const std::filesystem::path& folder) {
  std::vector<report::SwapEntry> entries;
  for (const Swapped& one : all) {
    entries.push_back({{one.cpg, {*one.scenario, one.record, one.summary}}, one.verdict, one.cpg + ".html"});
    write_file(folder / entries.back().page,
               report::page(report::page_data(*one.scenario, one.record, one.summary, one.verdict, {})));
  }
  write_file(folder / "swap.html", report::swap_page(all.front().scenario->name, entries));
}

void print_coinciding(const std::vector<Swapped>& all, const report::CurvesInput& shown) {
  const Scenario& first = *all.front().scenario;
  for (const std::vector<std::size_t>& group : shown.coincide) {
    fmt::print("coincide within {:g} % of their range: {} (set point and torque of {}, {:g} to {:g} s)\n",
               100 * report::kCoincide, report::run_names(group, shown.names),
               first.robot->joints[all.front().summary.most_loaded()].name, shown.panels.front().from, first.duration);
  }
}

/// Command line that repeats this command.
std::string again(const SwapArguments& arguments) {
  std::string line = "gaitlab swap";
  const auto add = [&](const std::string& word) { line += " " + shell_word(word); };
  for (const std::string& file : arguments.files) add(file);
  line += " --cpg " + shell_word(arguments.cpgs);
  for (const std::string& set : arguments.sets) line += " --set " + shell_word(set);
  if (arguments.seed) line += " --seed " + shell_word(*arguments.seed);
  if (arguments.out) line += " --out " + shell_word(*arguments.out);
  if (arguments.report) line += " --report";
  if (arguments.jobs > 1) line += fmt::format(" -j {}", arguments.jobs);
  return line;
}

/// Runs all scenarios as run_swapped does. If the program was stopped, prints a message and returns false.
bool run_or_tell(const std::vector<Swapped*>& all, const SwapArguments& arguments) {
  if (run_swapped(all, arguments.jobs, arguments.quiet)) return true;
  say(fmt::format("{}: interrupted: nothing is written; run it again with\n{}\n", arguments.files.front(), again(arguments)));
  return false;
}

bool any_broke_off(const std::vector<Swapped>& all) {
  return std::ranges::any_of(all, [](const Swapped& s) { return !s.summary.outcome.done(); });
}

/// Prints the estimated time of all runs if it is long, and the faster engine.
void note_time(const SwapArguments& arguments, Catalog& catalog) {
  if (arguments.quiet) return;
  const auto time_of = [&](std::span<const Scenario> runs) {
    double sum = 0;
    for (const Scenario& run : runs) sum += estimated_seconds(run);
    return sum / std::min(static_cast<double>(arguments.jobs), static_cast<double>(runs.size()));
  };
  app::note_time(arguments.files.front(), time_of, [&](const std::vector<std::string>& sets) {
    std::vector<Scenario> scenarios;
    SwapArguments one = arguments;
    one.quiet = true;
    one.sets.insert(one.sets.end(), sets.begin(), sets.end());
    for (const std::string& file : arguments.files) {
      one.file = file;
      for (Swapped& run : read_swapped(one, catalog)) scenarios.push_back(std::move(*run.scenario));
    }
    return scenarios;
  });
}

/// Writes the files of one scenario: figure, numbers and, with `pages`, the pages.
void write_swap(const std::vector<Swapped>& all, const report::CurvesInput& shown, const std::filesystem::path& folder,
                bool pages) {
  const std::vector<report::NamedRun> runs = named_runs(all);
  write_file(folder / "overlay.svg", report::curves_svg(shown));
  write_file(folder / "swap.csv", report::swap_csv(runs));
  write_file(folder / "swap.json", report::swap_json(runs));
  if (pages) write_pages(all, folder);
}

int swap_one(const SwapArguments& arguments, Catalog& catalog) {
  std::vector<Swapped> all = read_swapped(arguments, catalog);
  const Scenario& first = *all.front().scenario;
  const StopOnSignal stop(StopOnSignal::Second::is_ignored);
  RunFolder folder(arguments.out, "swap-" + first.name);
  std::vector<Swapped*> runs;
  for (Swapped& one : all) runs.push_back(&one);
  note_time(arguments, catalog);
  if (!run_or_tell(runs, arguments)) return 1;
  const report::CurvesInput shown = figure(all);
  fmt::print("{}: {:g} s under each\n{}", first.name, first.duration, report::swap_table(named_runs(all)));
  print_verdicts(all);
  print_coinciding(all, shown);
  write_swap(all, shown, folder.path(), arguments.report);
  folder.keep();
  fmt::print("figure: {}\n", (folder.path() / "overlay.svg").string());
  fmt::print("numbers: {}, swap.json\n", (folder.path() / "swap.csv").string());
  if (arguments.report) fmt::print("pages: {}, and one per CPG\n", (folder.path() / "swap.html").string());
  return any_broke_off(all) ? 1 : 0;
}

/// Runs in the order of the CPGs, then of the scenarios.
std::vector<report::MatrixRun> matrix_runs(const std::vector<std::vector<Swapped>>& all) {
  std::vector<report::MatrixRun> runs;
  for (std::size_t c = 0; c < all.front().size(); ++c) {
    for (const std::vector<Swapped>& of : all) {
      const Swapped& one = of[c];
      runs.push_back({{one.cpg, {*one.scenario, one.record, one.summary}}, one.scenario->name, one.verdict});
    }
  }
  return runs;
}

int swap_matrix(const SwapArguments& arguments, Catalog& catalog) {
  std::vector<std::vector<Swapped>> all = read_matrix(arguments, catalog);
  const StopOnSignal stop(StopOnSignal::Second::is_ignored);
  RunFolder folder(arguments.out, "swap-matrix");
  std::vector<Swapped*> each;
  for (std::vector<Swapped>& of : all) {
    for (Swapped& one : of) each.push_back(&one);
  }
  note_time(arguments, catalog);
  if (!run_or_tell(each, arguments)) return 1;
  const std::vector<report::MatrixRun> runs = matrix_runs(all);
  fmt::print("{} in {}\n{}", golden::plural(all.front().size(), "CPG"), golden::plural(all.size(), "scenario"),
             report::matrix_table(runs));
  for (const std::vector<Swapped>& of : all) {
    const std::filesystem::path own = folder.path() / of.front().scenario->name;
    std::filesystem::create_directory(own);
    write_swap(of, figure(of), own, arguments.report);
  }
  write_file(folder.path() / "swap.csv", report::matrix_csv(runs));
  write_file(folder.path() / "swap.json", report::matrix_json(runs));
  folder.keep();
  fmt::print("numbers: {}, swap.json\n", (folder.path() / "swap.csv").string());
  fmt::print("of each scenario: {}, swap.csv, swap.json{}\n", (folder.path() / "NAME/overlay.svg").string(),
             arguments.report ? ", swap.html and a page per CPG" : "");
  return std::ranges::any_of(all, any_broke_off) ? 1 : 0;
}

int swap_cpgs(const SwapArguments& given) {
  Catalog catalog = standard_catalog();
  SwapArguments arguments = given;
  arguments.file = arguments.files.front();
  return arguments.files.size() == 1 ? swap_one(arguments, catalog) : swap_matrix(arguments, catalog);
}

}  // namespace

void add_swap(Commands& commands) {
  add_command<SwapArguments>(
      commands, "swap", "Run scenarios under several CPGs: one table, one figure, CSV and JSON.", swap_cpgs,
      [](CLI::App& command, SwapArguments& arguments) {
        add_scenario(command, arguments);
        command.remove_option(command.get_option("SCENARIO"));
        offering(command.add_option("SCENARIO", arguments.files),
                 "scenario files (YAML), or names of {}; for several the table shows every CPG in every scenario",
                 {.kinds = {"scenarios"}})
            ->required()
            ->transform(named_file);
        offering(command.add_option("--cpg", arguments.cpgs),
                 "types of the CPGs ({}), separated by commas; their common keys are kept, `model` gets its defaults",
                 {.kinds = {"cpg"}, .files = false, .several = true})
            ->required();
        command.add_option(
            "--out", arguments.out,
            "folder of figure and numbers (default runs/swap-NAME, for several scenarios runs/swap-matrix); new or empty");
        command.add_flag("--report", arguments.report,
                         "also write a page per CPG, and swap.html, which shows them side by side");
        command.add_option("-j,--jobs", arguments.jobs, "threads (default 1)")->check(CLI::Range(1, kMostThreads));
      });
}

}  // namespace gaitlab::app
