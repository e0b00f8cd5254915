// `gaitlab swap`, which compares CPGs in the same scenarios: by a table, a figure for each scenario, and numbers as CSV and
// JSON.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/gait/run_time.h"
#include "app/shell/stop_on_signal.h"
#include "app/swap/swapped.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/recording/run_folder.h"
#include "core/settings/shell_word.h"
#include "core/simulation/batch_limits.h"
#include "golden/report.h"
#include "report/figures/paper/paper_figure.h"
#include "report/figures/run/coincide.h"
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

/// Content of the figure: a joint, its curves from a time on, and the CPGs whose curves coincide.
struct SwapShown {
  std::size_t joint = 0;                   ///< the most loaded one under the first CPG
  bool driven = false;                     ///< true if the joint has a motor; otherwise it is not drawn
  double from = 0;                         ///< s
  std::vector<std::string> coincide = {};  ///< names of the CPGs of each group
};

SwapShown swap_shown(const std::vector<Swapped>& all) {
  constexpr double kShownSeconds = 8;
  const Scenario& first = *all.front().scenario;
  SwapShown shown{.joint = all.front().summary.most_loaded()};
  shown.driven = report::has_motors(first) && first.robot->joints[shown.joint].driven();
  std::vector<std::string> names;
  std::vector<std::vector<double>> time;
  for (const Swapped& one : all) {
    shown.from = std::max(shown.from, one.record.simulated - kShownSeconds);
    names.push_back(one.cpg);
    time.push_back(report::row_times(one.record));
  }
  if (!shown.driven) return shown;
  std::vector<report::RunCurves> curves;
  for (const char* quantity : {"setpoint", "torque"}) {
    curves.push_back({shown.from});
    for (const Swapped& one : all) curves.back().values.push_back(one.record.joint(shown.joint, quantity).values());
  }
  for (const std::vector<std::size_t>& group : report::coinciding(time, curves))
    shown.coincide.push_back(report::run_names(group, names));
  return shown;
}

std::string figure(const std::vector<Swapped>& all, const SwapShown& shown) {
  const Scenario& first = *all.front().scenario;
  report::Recipe recipe = report::screen_recipe(fmt::format("{} under {}", first.name, golden::plural(all.size(), "CPG")));
  std::vector<report::PaperRun> runs;
  double end = 0;
  for (const Swapped& one : all) {
    if (one.record.rows() > 0) runs.push_back({one.cpg, *one.scenario, one.record});
    end = std::max(end, one.record.simulated);
  }
  const auto add = [&](const std::string& title, const std::string& column, double from, const char* label = "") {
    report::PanelRecipe panel;
    panel.title = title;
    panel.left = {.columns = {column}, .label = label};
    panel.from = from;
    panel.height = 50;
    if (!runs.empty() && end > from) recipe.panels.push_back(std::move(panel));
  };
  if (shown.driven) {
    const std::string joint = fmt::format("joint {} ({})", shown.joint, first.robot->joints[shown.joint].name);
    std::string coincide;
    for (const std::string& group : shown.coincide) coincide += "; coincide: " + group;
    add("set point of " + joint + coincide, fmt::format("joint.{}.setpoint", shown.joint), shown.from);
    add("torque of " + joint, fmt::format("joint.{}.torque", shown.joint), shown.from);
  }
  add("x of the centre of mass", "com.x", 0, "x (m)");
  return report::figure_svg(recipe, runs);
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

void print_coinciding(const std::vector<Swapped>& all, const SwapShown& shown) {
  const Scenario& first = *all.front().scenario;
  for (const std::string& group : shown.coincide) {
    fmt::print("coincide within {:g} % of their range: {} (set point and torque of {}, {:g} to {:g} s)\n",
               100 * report::kCoincide, group, first.robot->joints[shown.joint].name, shown.from, first.duration);
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
void write_swap(const std::vector<Swapped>& all, const SwapShown& drawn, const std::filesystem::path& folder, bool pages) {
  const std::vector<report::NamedRun> runs = named_runs(all);
  write_file(folder / "overlay.svg", figure(all, drawn));
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
  const SwapShown drawn = swap_shown(all);
  fmt::print("{}: {:g} s under each\n{}", first.name, first.duration, report::swap_table(named_runs(all)));
  print_verdicts(all);
  print_coinciding(all, drawn);
  write_swap(all, drawn, folder.path(), arguments.report);
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
    write_swap(of, swap_shown(of), own, arguments.report);
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
      commands, "swap", "Run scenarios under several CPGs, and write one table, one figure, CSV and JSON.", swap_cpgs,
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
