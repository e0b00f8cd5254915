// A scenario under several CPGs: one table, one figure, and the numbers for other programs.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/commands.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/recording/run_folder.h"
#include "core/simulation/batch.h"
#include "golden/report.h"
#include "report/coincide.h"
#include "report/page.h"
#include "report/swap_page.h"

namespace gaitlab::app {

namespace {

struct SwapArguments : ScenarioArguments {
  std::string cpgs;                ///< types, with commas between
  std::optional<std::string> out;  ///< folder of figure and numbers
  int jobs = 1;                    ///< threads
  bool report = false;             ///< also a page of every run, and one of all
};

constexpr double kShown = 8;  // s, of set point and torque: their last

struct Swapped {
  std::string cpg;
  std::optional<Scenario> scenario = {};
  std::vector<std::string> notes = {};
  Recording record = {};
  report::Summary summary = {};
  report::Verdict verdict = {};
};

/// The CPG that the scenario has, which keeps what --set says of its model.
std::string own_cpg(const SwapArguments& arguments, Catalog& catalog) {
  auto quiet = static_cast<const ScenarioArguments&>(arguments);
  quiet.quiet = true;
  const Scenario scenario = read(quiet, catalog);
  return scenario.cpg.entry == nullptr ? "" : std::string(scenario.cpg.entry->name);
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> names(1);
  for (const char c : list) {
    if (c == ',') {
      names.emplace_back();
    } else {
      names.back() += c;
    }
  }
  return names;
}

/// The scenario under each CPG; what is wrong with any of them is told of all at once.
std::vector<Swapped> read_all(const SwapArguments& arguments, Catalog& catalog) {
  std::vector<Swapped> all;
  std::vector<Problem> problems;
  const std::string own = own_cpg(arguments, catalog);
  for (const std::string& cpg : split(arguments.cpgs)) {
    if (cpg.empty()) {
      problems.push_back({SourceLocation{"--cpg"},
                          fmt::format("has an empty name in '{}'; expected types with commas between", arguments.cpgs)});
      break;
    }
    const auto same = [&](const Swapped& other) { return other.cpg == cpg; };
    if (std::any_of(all.begin(), all.end(), same)) {
      problems.push_back({SourceLocation{"--cpg"}, fmt::format("names '{}' twice", cpg)});
      continue;
    }
    Swapped swapped{cpg};
    auto with = static_cast<const ScenarioArguments&>(arguments);
    with.quiet = true;  // notes are told once all names are read
    if (cpg != own) {
      const auto of_model = [](const std::string& set) { return set.starts_with("cpg.model"); };
      for (const std::string& set : with.sets) {
        if (of_model(set)) swapped.notes.push_back(fmt::format("{}: dropped --set {}", cpg, set));
      }
      std::erase_if(with.sets, of_model);
      with.sets.push_back("cpg.type=" + cpg);
    }
    try {
      swapped.scenario = read(with, catalog);
      swapped.notes.insert(swapped.notes.end(), swapped.scenario->notes.begin(), swapped.scenario->notes.end());
    } catch (const InputError& error) {
      for (Problem problem : error.problems()) {
        if (problem.place.file == "--set cpg.type=" + cpg) problem.place = SourceLocation{"--cpg"};  // what the user wrote
        const auto alike = [&](const Problem& p) {
          return p.text == problem.text && to_string(p.place) == to_string(problem.place);
        };
        if (std::none_of(problems.begin(), problems.end(), alike)) problems.push_back(problem);
      }
    }
    all.push_back(std::move(swapped));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  for (const Swapped& swapped : all) {
    for (const std::string& note : swapped.notes) {
      if (!arguments.quiet) fmt::print(stderr, "{}: note: {}\n", arguments.file, note);
    }
  }
  return all;
}

void run_all(std::vector<Swapped>& all, int jobs) {
  std::vector<Scenario> scenarios;
  for (const Swapped& one : all) scenarios.push_back(*one.scenario);
  run_batch(scenarios, {.threads = jobs}, [&](std::size_t i, Recording&& recording) {
    all[i].record = std::move(recording);
    all[i].summary = report::summarise(*all[i].scenario, all[i].record, 0);
    all[i].verdict =
        report::verdict(*all[i].scenario, all[i].record, all[i].summary, report::overlaps(*all[i].scenario, all[i].record));
  });
}

std::vector<report::NamedRun> named_runs(const std::vector<Swapped>& all) {
  std::vector<report::NamedRun> runs;
  for (const Swapped& one : all) runs.push_back({one.cpg, {*one.scenario, one.record, one.summary}});
  return runs;
}

// ---- the figure

/// Set point and torque of the joint that is the most loaded under the first CPG, where something drives it; and the travel.
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
  setpoint.from = torque.from = std::max(0.0, first.duration - kShown);
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
    const auto first = std::ranges::find(one.verdict.checks, report::CheckStatus::fail, &report::Check::status);
    fmt::print("{}: {}{}\n", one.cpg, one.verdict.word, first == one.verdict.checks.end() ? "" : ": " + first->text);
  }
}

/// A page of every run, CPG.html, and swap.html, which leads to them.
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

int swap_cpgs(const SwapArguments& arguments) {
  Catalog catalog = standard_catalog();
  std::vector<Swapped> all = read_all(arguments, catalog);
  const Scenario& first = *all.front().scenario;
  RunFolder folder(arguments.out, "swap-" + first.name);
  run_all(all, arguments.jobs);
  const std::vector<report::NamedRun> runs = named_runs(all);
  const report::CurvesInput shown = figure(all);
  fmt::print("{}: {:g} s under each\n{}", first.name, first.duration, report::swap_table(runs));
  print_verdicts(all);
  print_coinciding(all, shown);
  write_file(folder.path() / "overlay.svg", report::curves_svg(shown));
  write_file(folder.path() / "swap.csv", report::swap_csv(runs));
  write_file(folder.path() / "swap.json", report::swap_json(runs));
  if (arguments.report) write_pages(all, folder.path());
  folder.keep();
  fmt::print("figure: {}\n", (folder.path() / "overlay.svg").string());
  fmt::print("numbers: {}, swap.json\n", (folder.path() / "swap.csv").string());
  if (arguments.report) fmt::print("pages: {}, and one per CPG\n", (folder.path() / "swap.html").string());
  const bool broke_off = std::any_of(all.begin(), all.end(), [](const Swapped& s) { return s.summary.outcome != "done"; });
  return broke_off ? 1 : 0;
}

}  // namespace

void add_swap(Commands& commands) {
  add_command<SwapArguments>(
      commands, "swap", "Run a scenario under several CPGs: one table, one figure, CSV and JSON.", swap_cpgs,
      [](CLI::App& command, SwapArguments& arguments) {
        add_scenario(command, arguments);
        command
            .add_option("--cpg", arguments.cpgs,
                        "types of the CPGs, separated by commas; their common keys are kept, `model` gets its defaults")
            ->required();
        command.add_option("--out", arguments.out, "folder of figure and numbers (default runs/swap-NAME); new or empty");
        command.add_flag("--report", arguments.report,
                         "also write a page per CPG, and swap.html, which shows them side by side");
        command.add_option("-j,--jobs", arguments.jobs, "threads (default 1)")->check(CLI::Range(1, 1024));
      });
}

}  // namespace gaitlab::app
