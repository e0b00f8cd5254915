// `gaitlab report`: what a run came to, from its folder alone.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "app/commands.h"
#include "app/stored_scenario.h"
#include "core/errors.h"
#include "core/recording/atomic_file.h"
#include "core/recording/recording_file.h"
#include "core/recording/run_files.h"
#include "core/recording/run_folder.h"
#include "report/run_figure.h"
#include "report/summary.h"
#include "report/trust.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string run;                 ///< folder
  std::optional<std::string> out;  ///< folder for summary.json and figure.svg
};

/// How long the simulation took, which only its summary knows; 0 where there is none.
double wall_time(const fs::path& run) {
  std::error_code none;
  if (!fs::exists(run / "summary.json", none)) return 0;
  const nlohmann::json summary = read_summary(run);
  const auto found = summary.find("wall_time");
  return found != summary.end() && found->is_number() ? found->get<double>() : 0;
}

int report(const ReportArguments& arguments) {
  const StoredScenario stored = stored_scenario(arguments.run);
  Catalog catalog = standard_catalog();
  const Scenario scenario = read_stored(stored, catalog, OtherPlugins::taken);
  const StoredRecording read = read_recording(arguments.run);
  const Recording& recording = read.recording;
  const std::size_t joints = scenario.robot->joints.size();
  if (read.missing.empty() && recording.joints.size() != joints) {
    throw InputError(Place{arguments.run},
                     fmt::format("the recording is of {} joints, the scenario has {}", recording.joints.size(), joints));
  }
  Summary summary = summarise(scenario, recording, wall_time(arguments.run));
  summary.build = read.origin.build;
  if (arguments.out && !read.missing.empty()) {
    throw InputError(Place{arguments.run},
                     fmt::format("summary and figure cannot be made anew: {}; simulate it again: gaitlab rerun {}",
                                 fmt::join(read.missing, "; "), arguments.run));
  }
  if (arguments.out) {
    RunFolder folder(*arguments.out, scenario.name);
    write_file(folder.path() / "figure.svg", run_figure(scenario, recording, summary));
    write_file(folder.path() / "summary.json", to_json(summary, scenario, recording));
    folder.keep();
  }
  fmt::print("{}", to_text(summary, scenario, recording));
  if (arguments.out) fmt::print("  {:<13} {}: summary.json, figure.svg\n", "files", *arguments.out);
  for (const std::string& missing : read.missing) fmt::print(stderr, "{}: note: {}\n", arguments.run, missing);
  warn_of_run(scenario, recording, summary);
  return 0;
}

}  // namespace

void warn_of_run(const Scenario& scenario, const Recording& recording, const Summary& summary) {
  if (const std::string fall = fall_warning(scenario, recording); !fall.empty())
    fmt::print(stderr, "{}: warning: {}\n", scenario.file, fall);
  const std::string where = to_string(scenario.place("physics.step"));
  const std::string warning = stability_warning(summary, scenario, recording);
  if (!warning.empty()) fmt::print(stderr, "{}: warning: {}\n", where, warning);
  if (recording.outcome != "done") return;
  for (const std::string& doubt : trust_warnings(scenario, recording)) fmt::print(stderr, "{}: warning: {}\n", where, doubt);
}

void add_report(Commands& commands) {
  add_command<ReportArguments>(commands, "report", "Print the summary of a run folder again, without simulating.", report,
                               [](CLI::App& command, ReportArguments& arguments) {
                                 command.add_option("RUN", arguments.run, "run folder")->required()->check(not_empty);
                                 command.add_option("--out", arguments.out,
                                                    "folder for summary.json and figure.svg, made anew; new or empty");
                               });
}

}  // namespace gaitlab::app
