// `gaitlab rerun`, which repeats a run from its folder alone; with --verify it compares the traces and lists changes since the
// run.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/shell/commands.h"
#include "app/shell/progress.h"
#include "core/build_id.h"
#include "core/errors.h"
#include "core/recording/compare.h"
#include "core/recording/run_files.h"
#include "core/scenario/resolved.h"
#include "core/settings/changed_settings.h"
#include "core/simulation/simulation.h"
#include "kit/stored_scenario.h"

namespace gaitlab::app {

namespace {

struct RerunArguments {
  std::string run;                 ///< run folder, or trace.h5 file
  bool verify = false;             ///< compare with the recorded trace and write nothing
  std::optional<std::string> out;  ///< folder of the new run, as in RunArguments
  bool quiet = false;
  PluginArguments plugins;
};

namespace fs = std::filesystem;

constexpr double kTolerance = 1e-9;  // RMS difference / range of the column
constexpr std::size_t kColumnsShown = 10;

/// The trace of the recorded run with its origin, as far as it is recorded, and data of summary.json.
struct Past : StoredTrace {
  std::optional<Outcome> ended = {};  ///< outcome in summary.json; nothing without this file
  std::string summary_hash = {};      ///< hash of the trace to which summary.json belongs, or ""
};

bool is_there(const fs::path& file) {
  std::error_code none;  // a file that cannot be accessed counts as missing
  return fs::exists(file, none);
}

Past read_past(const fs::path& run, StoredTrace trace) {
  Past past{std::move(trace)};
  if (past.trace.rows() == 0 || past.trace.columns.front().name != "t") {
    throw InputError(SourceLocation{past.file.string()},
                     "is not the trace of a run: it has no rows, or its first column is not t");
  }
  if (!is_there(run / "summary.json")) return past;
  const nlohmann::json summary = read_summary(run);
  const auto text = [&](const char* key) {
    const auto at = summary.find(key);
    return at != summary.end() && at->is_string() ? at->get<std::string>() : std::string();
  };
  if (!text("outcome").empty()) past.ended = Outcome::of(text("outcome"));
  past.summary_hash = text("trace_hash");
  if (past.origin.build.empty()) past.origin.build = text("build");
  return past;
}

double last_time(const Trace& trace) { return trace.at(trace.rows() - 1, 0); }

/// True if the run ended early. Without a summary (the program was killed while it wrote, or `run` is a trace file) the time of
/// the last row decides.
bool ended_early(const Past& past, const Scenario& scenario) {
  if (past.ended) return !past.ended->done();
  return last_time(past.trace) < scenario.duration - 0.5 * scenario.physics.step;
}

/// Results of the repeated run. If the recorded run ended early, the repeated run ends at the last recorded row.
struct Again {
  Trace trace;
  std::string failure;
};

Again run_again(const Scenario& scenario, const Past& past, bool early) {
  Again again;
  Simulation simulation({&scenario, 1});
  Progress progress(false);
  try {
    const double until = last_time(past.trace) + 0.5 * scenario.physics.step;
    while (early && !simulation.done() && simulation.time() < until) simulation.step();
    if (!early) simulation.run(std::ref(progress));
  } catch (const SimulationError& error) {
    again.failure = error.what();
  }
  again.trace = simulation.take_recording(0).trace;
  const std::size_t rows = early ? std::min(past.trace.rows(), again.trace.rows()) : again.trace.rows();
  again.trace.values.resize(rows * again.trace.columns.size());
  return again;
}

/// Sentences on the changes since the run was recorded.
std::vector<std::string> changes(const StoredScenario& stored, const Past& past, const Scenario& scenario, const Again& again,
                                 const Catalog& catalog) {
  std::vector<std::string> found;
  if (past.origin.build.empty()) {
    found.push_back(fmt::format("build: not recorded; now {}", build_id()));
  } else if (past.origin.build != build_id()) {
    found.push_back(fmt::format("build: then {}, now {}", past.origin.build, build_id()));
  }
  const std::vector<PluginChange> plugins = changed_plugins(stored, catalog);
  for (const PluginChange& plugin : plugins) {
    found.push_back(fmt::format("plugin {}: the file has changed: hash then {}, now {}", plugin.path, plugin.then, plugin.now));
  }
  if (!past.origin.scenario.empty() && past.origin.scenario != stored.text) {
    found.push_back(fmt::format("scenario: {} differs from the scenario in {}:\n    {}", stored.shown,
                                past.file.filename().string(),
                                fmt::join(changed_settings(past.origin.scenario, stored.text), "\n    ")));
  }
  const std::string now = resolved(scenario);
  if (plugins.empty() && now != stored.text) {  // the resolved scenario contains the plugins' hashes
    found.push_back(fmt::format("scenario: this program resolves it differently:\n    {}",
                                fmt::join(changed_settings(stored.text, now), "\n    ")));
  }
  if (!past.summary_hash.empty() && past.summary_hash != hash(past.trace)) {
    found.push_back(fmt::format("trace: {} is not the trace from which summary.json was computed{}",
                                past.file.filename().string(),
                                past.summary_hash == hash(again.trace) ? "; the repeated run gives that trace" : ""));
  }
  return found;
}

void print_worst_columns(const TraceDifference& difference) {
  std::vector<ColumnDifference> worst;
  for (const ColumnDifference& d : difference.columns) {
    if (!(d.relative_rms <= kTolerance)) worst.push_back(d);
  }
  if (worst.empty()) return;  // the difference is already in the list of changes
  std::stable_sort(worst.begin(), worst.end(), [](const auto& a, const auto& b) { return a.relative_rms > b.relative_rms; });
  fmt::print("  {} of {} columns are beyond {} of their range:\n", worst.size(), difference.columns.size(), kTolerance);
  for (std::size_t i = 0; i < std::min(worst.size(), kColumnsShown); ++i) {
    const std::string from = worst[i].first_divergence ? fmt::format(", from t = {:.6g} s", *worst[i].first_divergence) : "";
    fmt::print("    {}: RMS {:.3g} of its range{}\n", worst[i].label, worst[i].relative_rms, from);
  }
  if (worst.size() > kColumnsShown) fmt::print("    ... and {} more\n", worst.size() - kColumnsShown);
}

/// Compares the traces and prints the result. Returns true if they are bit-equal or within the tolerance.
bool judge(const std::string& run, const Scenario& scenario, const Trace& then, const Again& again) {
  const std::string size = fmt::format("{} rows of {} columns", then.rows(), then.columns.size());
  if (hash(then) == hash(again.trace)) {
    fmt::print("{}: bit-equal: {}, trace hash {}\n", one_line(run), size, hash(then));
    return true;
  }
  CompareOptions options;
  options.divergence = kTolerance;
  for (const Joint& joint : scenario.robot->joints) options.names.joints.push_back(joint.name);
  const TraceDifference difference = compare(then, again.trace, options);
  double worst = 0;
  std::size_t equal = 0;
  for (const ColumnDifference& d : difference.columns) {
    worst = std::max(worst, d.relative_rms);
    equal += d.equal ? 1 : 0;
  }
  if (difference.findings.empty() && worst <= kTolerance) {
    fmt::print(
        "{}: within {} of range, not bit-equal: {}, the worst RMS is {:.3g} of its column's range, {} columns are equal\n",
        one_line(run), kTolerance, size, worst, equal);
    return true;
  }
  fmt::print("{}: differs (A: the recorded run, B: the repeated run)\n", one_line(run));
  for (const std::string& finding : difference.findings) fmt::print("  {}\n", finding);
  if (!again.failure.empty()) fmt::print("  the repeated run {}\n", again.failure);
  print_worst_columns(difference);
  return false;
}

int verify(const std::string& run, const PluginArguments& plugins) {
  OpenedRun recorded(run);
  const StoredScenario stored = recorded.scenario();
  const Past past = read_past(run, std::move(recorded.trace()));
  Catalog catalog = careful_catalog(plugins);
  const Scenario scenario = read_stored(stored, catalog, OtherPlugins::taken);
  const bool early = ended_early(past, scenario);
  const Again again = run_again(scenario, past, early);
  const bool same = judge(run, scenario, past.trace, again);
  if (early) {
    fmt::print("  the recorded run ended early ({}): compared up to its last row, t = {:.6g} s\n",
               past.ended ? past.ended->text() : "the reason is unknown, because the record has no summary",
               last_time(past.trace));
  }
  const std::vector<std::string> changed = changes(stored, past, scenario, again, catalog);
  for (const std::string& line : changed) fmt::print("  {}\n", line);
  if (!same && changed.empty()) {
    fmt::print("  build, plugins and scenario are those of the recorded run{}\n",  // here the build is that of the recorded run
               build_is_of_commit()
                   ? "; possible causes: a library that is not in the build id, the machine, or a defect of gaitlab"
                   : ", as far as the build id of a changed source tree shows");
  }
  return same && (!early || past.ended) ? 0 : 4;
}

/// Format of the recorded trace, or h5 if there is none.
std::string format_of(const fs::path& run) { return is_there(run / "trace.csv") && !is_there(run / "trace.h5") ? "csv" : "h5"; }

int rerun(const RerunArguments& arguments) {
  if (arguments.verify) return verify(arguments.run, arguments.plugins);
  RunArguments as;
  as.out = arguments.out;
  as.quiet = arguments.quiet;
  as.format = format_of(arguments.run);
  as.no_page = true;
  Catalog catalog = careful_catalog(arguments.plugins);
  return run(read_stored(OpenedRun(arguments.run).scenario(), catalog, OtherPlugins::refused), as);
}

}  // namespace

void add_rerun(Commands& commands) {
  add_command<RerunArguments>(commands, "rerun", "Run the scenario of a run folder again, from the folder alone.", rerun,
                              [](CLI::App& command, RerunArguments& arguments) {
                                command.add_option("RUN", arguments.run, "run folder, or its trace.h5")->required();
                                add_trust(command, arguments.plugins);
                                CLI::Option* out_option = command.add_option("--out", arguments.out, "run folder, as for run");
                                command
                                    .add_flag("--verify", arguments.verify,
                                              "write nothing; compare with the recorded trace; exit code 4 if it differs")
                                    ->excludes(out_option);
                                command.add_flag("--quiet", arguments.quiet, "print no progress and no summary");
                              });
}

}  // namespace gaitlab::app
