#include "core/recording/run_files.h"

#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/files/file_kind.h"
#include "core/files/json_place.h"
#include "core/files/shallow_json.h"
#include "core/recording/csv.h"

namespace gaitlab {

namespace fs = std::filesystem;

fs::path trace_file(const fs::path& run) {
  const SourceLocation place{run.string()};
  std::error_code error;
  const fs::file_status status = fs::status(run, error);
  if (!fs::exists(status)) throw InputError(place, "there is no such run folder or trace file");
  if (!fs::is_directory(status)) {
    if (run.extension() == ".h5" || run.extension() == ".csv") return run;
    throw InputError(place, "is neither a run folder nor a trace file (.h5, .csv)" + but_it_is(run.string()));
  }
  for (const char* name : {"trace.h5", "trace.csv"}) {
    if (fs::exists(run / name, error)) return run / name;
  }
  throw InputError(place, "holds neither trace.h5 nor trace.csv: it is not a run folder");
}

StoredTrace read_trace(const fs::path& run) {
  const fs::path file = trace_file(run);
  return file.extension() == ".h5" ? read_h5(file) : StoredTrace{file, read_csv(file), {}, {}};
}

nlohmann::json read_summary(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  const std::string text = read_file(file, kMostJson);
  try {
    bool deep = false;  // true for deep nesting, of which copies would overflow the stack
    nlohmann::json summary = nlohmann::json::parse(text, [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
      return !(deep = deep || depth > kDeepestJson);
    });
    if (deep) throw InputError(SourceLocation{file.string()}, "is nested deeper than any summary");
    if (!summary.is_object())
      throw InputError(SourceLocation{file.string(), 1, 1}, "holds no JSON object: it is not a summary");
    return summary;
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(json_place(file.string(), text, error.byte), "is not JSON from here on: it is truncated or damaged");
  } catch (const nlohmann::json::exception&) {  // a number is outside the range of a double
    throw InputError(SourceLocation{file.string()}, "holds a number that is outside the range of a double");
  }
}

}  // namespace gaitlab
