// `gaitlab remedy`: search for the changes that make a gait feasible. A scenario is run first; a run folder is read.
#include "report/remedy/remedy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <new>

#include "app/gait/judged_run.h"
#include "app/shell/commands.h"
#include "app/shell/progress.h"
#include "app/shell/stop_on_signal.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/scenario/resolved.h"
#include "core/settings/wording.h"
#include "core/simulation/batch_limits.h"
#include "kit/stored_scenario.h"
#include "report/page/page.h"
#include "report/remedy/remedy_text.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;

struct RemedyArguments : RunArguments {
  PluginArguments plugins;  ///< plugins that a run folder may load
};

/// Throws InputError if an option for new runs is given with the folder of a run.
void check_options(const RunArguments& arguments) {
  const auto refuse = [&](const char* option) {
    throw InputError(
        SourceLocation{option},
        fmt::format("is for a scenario, but {} is a run; the remedy of a run is written into its folder", arguments.file));
  };
  if (arguments.out) refuse("--out");
  if (!arguments.sets.empty()) refuse("--set");
  if (arguments.seed) refuse("--seed");
}

int remedy_of_run(const RemedyArguments& arguments) {
  check_options(arguments);
  Catalog catalog = careful_catalog(arguments.plugins);
  JudgedRun run = judged_run(arguments.file, catalog, {}, arguments.shown);
  Scenario scenario = run.read.scenario;
  scenario.trace.period = run.period;
  print_summary(run.read.scenario, run.recording(), run.summary, run.verdict, arguments.shown);
  warn(run);
  const StopOnSignal stop(StopOnSignal::Second::is_ignored);
  const Remedied remedied = take_remedy(scenario, run.verdict, arguments);
  if (remedied.json.empty()) return 1;
  const fs::path folder = run.folder();
  if (!remedied.complete && fs::exists(folder / kRemedyFile)) {
    say((folder / kRemedyFile).string(), "note", "is an earlier remedy and is kept");
    print_lines(remedied.lines);
    return 1;
  }
  write_file(folder / kRemedyFile, remedied.json, Existing::replaced);
  if (!arguments.no_page) {
    const fs::path page = folder / kPageFile;
    write_file(page, report::page(run.page_data()), check_page(page.string(), page));
  }
  if (!arguments.quiet) print_lines(remedied.lines);
  if (!arguments.no_page && !arguments.quiet) print_page(folder / kPageFile);
  return remedied.complete ? exit_code(run.verdict, arguments.shown) : 1;
}

/// Names of the settings of a remedy.
std::vector<std::string> setting_names() {
  std::vector<std::string> names;
  for (const report::RemedyKey& key : report::remedy_keys()) names.emplace_back(key.name);
  return names;
}

void check_names(const std::vector<std::string>& by) {
  const std::vector<std::string> known = setting_names();
  for (const std::string& name : by) {
    if (std::ranges::count(known, name) == 0)
      throw InputError(SourceLocation{"--by"}, fmt::format("setting '{}' is unknown{}", name, offer(name, known, "settings")));
  }
}

int remedy(const RemedyArguments& arguments) {
  check_names(arguments.by);
  RemedyArguments asked = arguments;
  asked.remedy = true;
  const bool is_run = kind_of(asked.file) == fs::file_type::directory || fs::path(asked.file).extension() == ".h5";
  return is_run ? remedy_of_run(asked) : run(asked);
}

}  // namespace

Remedied take_remedy(const Scenario& scenario, report::Verdict& verdict, const RunArguments& arguments) try {
  if (!arguments.remedy) return {};
  Catalog catalog = standard_catalog();  // the plugins of the run are already loaded
  const StoredScenario same{scenario.file + " (its remedy)", resolved(scenario, FilePaths::whole)};
  const auto search = [&] {
    Progress progress(arguments.quiet);
    const report::RemedyTask task{
        scenario,
        verdict,
        [&](const std::vector<std::string>& sets) { return read_stored(same, catalog, OtherPlugins::taken, sets); },
        arguments.map,
        arguments.by,
        {arguments.jobs, 0},
        std::ref(progress)};
    return report::remedy(task, stopped());
  };
  const report::Remedy made = search();
  const std::string json = report::to_json(made);
  verdict.remedy = report::shown_remedy(json, made.scenario, verdict.word);
  if (made.interrupted) {
    say("gaitlab remedy", "error", "interrupted; the run is complete, and its remedy covers the runs so far");
  } else if (arguments.map && !made.map) {
    say("--map", "note", "the map is left out, because frequency or amplitude cannot be changed in this scenario");
  }
  return {report::remedy_lines(made), json, !made.interrupted};
} catch (const InputError& error) {
  say(error.what());
  return {.complete = false};
} catch (const std::bad_alloc&) {
  say("gaitlab remedy", "error", "not searched: out of memory");
  return {.complete = false};
} catch (const RunError& error) {  // also PluginError
  say("gaitlab remedy", "error", error.what());
  return {.complete = false};
}

void add_remedy(Commands& commands) {
  add_command<RemedyArguments>(
      commands, "remedy", "Search single settings that would make a gait feasible; for a feasible gait, search its reserves.",
      remedy, [](CLI::App& command, RemedyArguments& arguments) {
        add_scenario(command, arguments, named_file_or_run);
        offering(command.get_option("SCENARIO"), "scenario file (YAML), or a run folder", {});
        command.add_option("--out", arguments.out, "run folder (default runs/NAME, then NAME-2 ...); new or empty");
        command.add_flag("--no-report", arguments.no_page, "write no report.html");
        command.add_flag("--map", arguments.map, "also draw the verdict over frequency and amplitude, 13 x 13 runs");
        command
            .add_option("--by", arguments.by,
                        fmt::format("only this setting, once per setting: {}", fmt::join(setting_names(), ", ")))
            ->allow_extra_args(false);
        command.add_option("-j,--jobs", arguments.jobs, "threads (default 1)")->check(CLI::Range(1, kMostThreads));
        add_trust(command, arguments.plugins);
        add_shown(command, arguments.shown);
      });
}

}  // namespace gaitlab::app
