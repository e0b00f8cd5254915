#include <fmt/format.h>

#include <filesystem>

#include "app/app.h"
#include "core/errors.h"
#include "core/trace/atomic_file.h"
#include "core/trace/csv.h"
#include "core/trace/run_files.h"
#include "interchange/mjcf.h"
#include "interchange/urdf.h"

namespace gaitlab::app {

namespace {

void check_new(const std::string& name) {
  namespace fs = std::filesystem;
  const fs::path file = name;
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error))) throw InputError(Place{name}, "exists; nothing was written");
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) throw InputError(Place{name}, "cannot be written: its folder does not exist");
}

void export_run(const ExportArguments& arguments) {
  if (!arguments.source.sets.empty()) {
    throw InputError(Place{"--set " + arguments.source.sets.front()},
                     "a recorded run cannot be changed; expected --to mjcf or urdf");
  }
  const Trace trace = read_trace(arguments.source.file);
  write_csv(trace, arguments.file);
  fmt::print("{}: {} rows of {} columns\n", arguments.file, trace.rows(), trace.columns.size());
}

void export_robot(const ExportArguments& arguments) {
  Catalog catalog = standard_catalog();
  const Scenario scenario = read(arguments.source, catalog);
  write_file(arguments.file, arguments.format == "mjcf" ? to_mjcf(scenario) : to_urdf(scenario));
  fmt::print("{}: {} bodies, {} joints\n", arguments.file, scenario.robot->bodies.size(), scenario.robot->joints.size());
}

}  // namespace

int export_to(const ExportArguments& arguments) {
  check_new(arguments.file);
  (arguments.format == "csv" ? export_run : export_robot)(arguments);
  return 0;
}

}  // namespace gaitlab::app
