// Output, warnings and exit code of every command with a run.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <new>
#include <sstream>
#include <utility>

#include "app/shell/commands.h"
#include "app/shell/progress.h"
#include "app/shell/stop_on_signal.h"
#include "core/errors.h"
#include "core/scenario/chosen_friction.h"
#include "core/scenario/resolved.h"
#include "core/scenario/sections.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/shell_word.h"
#include "core/settings/wording.h"
#include "kit/run_warnings.h"
#include "kit/stored_scenario.h"
#include "report/analysis/summary.h"
#include "report/verdict/demand.h"
#include "report/verdict/frictionless.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/numbers/summary_text.h"
#include "report/verdict/screen.h"

namespace gaitlab::app {

namespace {

/// Text without control characters. They are removed because the outcome of a recorded run comes from an unknown source.
std::string printed(const std::string& text) {
  std::string all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    all += one_line(text.substr(at, end - at)) + (end < text.size() ? "\n" : "");
    at = end + 1;
  }
  return all;
}

/// Text of a table without control characters, and with a dash for each unknown number.
std::string printed_table(const std::string& text) { return report::texts::without_nan(printed(text)); }

}  // namespace

void print_lines(const std::vector<report::ScreenLine>& lines) {
  const char* const no_color = std::getenv("NO_COLOR");
  const bool coloured = isatty(fileno(stdout)) != 0 && (no_color == nullptr || *no_color == '\0');
  const auto painted = [&](const std::string& text, report::Tone tone) {
    if (!coloured || tone == report::Tone::plain) return text;
    const int colour = tone == report::Tone::good ? 32 : tone == report::Tone::bad ? 31 : 33;
    return fmt::format("\033[{}m{}\033[0m", colour, text);
  };
  constexpr std::size_t kIndent = 12;  // two blanks, the title and a blank
  const std::size_t columns = terminal_columns(STDOUT_FILENO, std::numeric_limits<std::size_t>::max());
  for (const report::ScreenLine& line : lines) {
    std::string title = line.title;
    std::istringstream parts(wrapped(printed(line.text), 0, columns - kIndent));
    for (std::string part; std::getline(parts, part); title.clear())
      fmt::print("  {:<9} {}\n", title, painted(part, line.tone));
  }
}

void print_fitted(const std::string& text) {
  fmt::print("{}", isatty(STDOUT_FILENO) == 0 ? text : wrapped(text, 0, terminal_columns(STDOUT_FILENO)));
}

void print_summary(const Scenario& scenario, const Recording& recording, const report::Summary& summary,
                   const report::Verdict& verdict, const SummaryOptions& shown) {
  const report::RunData run{scenario, recording, summary};
  for (const std::string& line : report::texts::simulated(run)) fmt::print("{}\n", printed(line));
  constexpr std::size_t kFew = 4;  // largest number of lines for checks of one status
  print_lines(report::first_screen(run, verdict, shown.verbose ? verdict.checks.size() : kFew,
                                   terminal_columns(STDOUT_FILENO, report::kColumns)));
  if (shown.verbose) fmt::print("{}", printed_table(report::to_text(summary, scenario, recording)));
  if (shown.joints) fmt::print("{}", printed_table(report::joint_table(summary, scenario)));
}

void print_retry(const ScenarioArguments& arguments, const report::Verdict& verdict) {
  if (verdict.retry.empty()) return;
  std::string command = "gaitlab run " + shell_word(arguments.file);
  if (arguments.seed) command += " --seed " + shell_word(*arguments.seed);
  const auto replaced = [&](const std::string& set) {
    const auto key = [](const std::string& one) { return one.substr(0, one.find('=')); };
    return std::ranges::any_of(verdict.retry, [&](const std::string& other) { return key(other) == key(set); });
  };
  for (const std::string& set : arguments.sets) command += replaced(set) ? "" : " --set " + shell_word(set);
  for (const std::string& set : verdict.retry) command += " --set " + shell_word(set);
  fmt::print("  {:<9} {}\n", "judge by", printed(command));  // in one line, to be copied
}

void take_demand(const Scenario& scenario, const Recording& recording, const report::Summary& summary, report::Verdict& verdict,
                 bool quiet) {
  if (Judged::limited(summary.judged.joints) == 0) {
    verdict.demand_doubt = "no motor reaches a limit, so that this run shows all that the gait demands";
    verdict.supply_demand = report::supply_demand(scenario, recording, summary.judged);
    return;
  }
  Catalog catalog = standard_catalog();  // the plugins of the run are already loaded
  const StoredScenario same{scenario.file + " (its demand twin)", resolved(scenario, FilePaths::whole)};
  Scenario twin = read_stored(same, catalog, OtherPlugins::taken);
  if (!report::raise_limits(twin)) {
    verdict.demand_doubt = "the limits of the actuator cannot be raised: it declares none, or one of them is 0";
    return;
  }
  Progress progress(quiet);
  report::add_demand(verdict, scenario, summary, report::demand(twin, recording, summary, std::ref(progress)));
}

void take_word_without_friction(const Scenario& scenario, report::Verdict& verdict, bool quiet) {
  const auto unknown = [&](const std::string& why) {
    if (!quiet) say(scenario.file, "note", "the word without this friction is not known: " + why);
  };
  if (verdict.word != Word::infeasible || !verdict.unstable.empty()) return;
  try {
    const std::vector<std::string> sets = without_chosen_friction(scenario);
    if (sets.empty()) return;
    Catalog catalog = standard_catalog();  // the plugins of the run are already loaded
    const StoredScenario same{scenario.file + " (without chosen friction)", resolved(scenario, FilePaths::whole)};
    const Scenario twin = read_stored(same, catalog, OtherPlugins::taken, sets);
    if (!quiet) say(scenario.file, "note", "infeasible; simulated again without the chosen friction of its servos");
    Progress progress(quiet);
    verdict.without_friction = report::word_of(twin, std::ref(progress), stopped());
  } catch (const InputError& error) {  // for example a step that is too long without the inertia of the rotors
    unknown(error.problems().front().text);
  } catch (const std::bad_alloc&) {
    unknown("out of memory");
  } catch (const PluginError& error) {
    unknown(error.what());
  }
}

int exit_code(const report::Verdict& verdict, const SummaryOptions& shown) {
  if (!shown.fail_infeasible) return 0;
  if (verdict.word == Word::failed) return 1;
  const auto fails = [](const report::Draw& draw) { return draw.word != Word::feasible; };
  return verdict.word != Word::feasible || std::ranges::any_of(verdict.draws, fails) ? 3 : 0;
}

void add_shown(CLI::App& command, SummaryOptions& shown) {
  command.add_flag("--joints", shown.joints, "print a row per joint, the most loaded first");
  command.add_flag("--fail-infeasible", shown.fail_infeasible,
                   "exit code 3 unless the verdict (and that of every draw) is feasible, 1 if the run failed");
  command.add_flag("--demand", shown.demand,
                   "if joints reach limits of their motors, simulate again without these limits and print how much is missing");
  command.add_flag("--verbose", shown.verbose,
                   "also print all numbers of the run, the energy ledger and the limit of the step");
}

void add_joint(CLI::App& command, std::vector<std::string>& joints) {
  command
      .add_option("--joint", joints,
                  "joint to draw in figure.svg, by name or pattern ('m3/*'); once per joint (default: the most loaded one)")
      ->allow_extra_args(false);
}

void draw_joints(Scenario& scenario, const std::vector<std::string>& joints) {
  if (joints.empty()) return;
  const std::vector<std::string> known = joint_names(*scenario.robot);
  std::vector<Problem> problems;
  for (const std::string& name : joints) {
    if (const std::string wrong = no_joint(name, known, "joint", scenario.groups); !wrong.empty())
      problems.push_back({SourceLocation{"--joint " + name}, wrong});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  scenario.figure.joints = joints_meant(joints, known, scenario.groups);
}

void warn_of_run(const Scenario& scenario, const Recording& recording, const report::Verdict& verdict) {
  for (const report::Warning& one : run_warnings(scenario, recording, verdict)) say(to_string(one.place), "warning", one.text);
}

}  // namespace gaitlab::app
