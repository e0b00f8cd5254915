#include <fmt/format.h>

#include <filesystem>

#include "app/app.h"
#include "core/errors.h"
#include "core/trace/csv.h"
#include "core/trace/run_files.h"

namespace gaitlab::app {

int export_run(const ExportArguments& arguments) {
  namespace fs = std::filesystem;
  const fs::path file = arguments.file;
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error))) throw InputError(Place{arguments.file}, "exists; nothing was written");
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) throw InputError(Place{arguments.file}, "cannot be written: its folder does not exist");
  const Trace trace = read_trace(arguments.run);
  write_csv(trace, file);
  fmt::print("{}: {} rows of {} columns\n", arguments.file, trace.rows(), trace.columns.size());
  return 0;
}

}  // namespace gaitlab::app
