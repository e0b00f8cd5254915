#include <fmt/format.h>

#include <filesystem>

#include "app/commands.h"
#include "core/errors.h"
#include "core/recording/atomic_file.h"
#include "core/recording/csv.h"
#include "core/recording/run_files.h"
#include "interchange/mjcf.h"
#include "interchange/urdf.h"

namespace gaitlab::app {

namespace {

struct ExportArguments {
  ScenarioArguments source;  ///< file: run folder or trace file (csv), scenario (mjcf, urdf)
  std::string format;        ///< csv, mjcf, urdf
  std::string file;          ///< to write; must not exist
};

void export_run(const ExportArguments& arguments) {
  if (!arguments.source.sets.empty()) {
    throw InputError(SourceLocation{"--set " + arguments.source.sets.front()},
                     "a recorded run cannot be changed; expected --to mjcf or urdf");
  }
  const Trace trace = read_trace(arguments.source.file);
  write_csv(trace, arguments.file);
  fmt::print("{}: {} rows of {} columns\n", arguments.file, trace.rows(), trace.columns.size());
}

void export_robot(const ExportArguments& arguments) {
  std::error_code none;
  if (std::filesystem::is_directory(arguments.source.file, none)) {
    throw InputError(
        SourceLocation{arguments.source.file},
        fmt::format("is a folder; --to {} takes a scenario, of a run folder its scenario.resolved.yaml", arguments.format));
  }
  Catalog catalog = standard_catalog();
  const Scenario scenario = read(arguments.source, catalog);
  write_file(arguments.file, arguments.format == "mjcf" ? to_mjcf(scenario) : to_urdf(scenario));
  fmt::print("{}: {} bodies, {} joints\n", arguments.file, scenario.robot->bodies.size(), scenario.robot->joints.size());
}

int export_to(const ExportArguments& arguments) {
  check_new(arguments.file);
  (arguments.format == "csv" ? export_run : export_robot)(arguments);
  return 0;
}

}  // namespace

void add_export(Commands& commands) {
  add_command<ExportArguments>(
      commands, "export", "Write the trace of a run, or the robot of a scenario, in another format.", export_to,
      [](CLI::App& command, ExportArguments& arguments) {
        command.add_option("SOURCE", arguments.source.file, "csv: run folder or trace file; mjcf, urdf: scenario file")
            ->required();
        command.add_option("--to", arguments.format, "csv; mjcf (MuJoCo), urdf")
            ->required()
            ->check(CLI::IsMember({"csv", "mjcf", "urdf"}));
        command.add_option("FILE", arguments.file, "file to write; must not exist")->required();
        command.add_option("--set", arguments.source.sets, "key.path=value in the scenario")
            ->expected(1)
            ->allow_extra_args(false)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
      });
}

}  // namespace gaitlab::app
