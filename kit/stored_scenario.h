// A recorded run and its scenario, read from the run folder alone.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/recording/recording_file.h"
#include "core/scenario/scenario.h"

namespace gaitlab::kit {

struct StoredScenario {
  std::string shown;  ///< name of the file in messages
  std::string text;
  bool is_file = false;  ///< true if `text` is the content of the file `shown`, scenario.resolved.yaml
};

/// A run folder, or a trace file, whose trace is read once, when it is first needed.
class OpenedRun {
 public:
  explicit OpenedRun(std::string run) : run_(std::move(run)) {}
  /// The trace without the tables beside it. Throws the InputErrors of read_trace.
  StoredTrace& trace();
  /// scenario.resolved.yaml or, if it is missing, the text inside trace.h5. Throws InputError if neither contains a scenario.
  [[nodiscard]] StoredScenario scenario();

 private:
  std::string run_;
  std::optional<StoredTrace> trace_;
};

/// A plugin library whose file has changed since the run.
struct PluginChange {
  std::string path, then, now;  ///< path, hash in the record, and present hash
};
std::vector<PluginChange> changed_plugins(const StoredScenario& stored, const Catalog& catalog);

/// Treatment of changed plugins: a rerun refuses them; a comparison accepts the present libraries.
enum class OtherPlugins { refused, taken };

/// Reads the recorded scenario; `sets` are additional settings in the form of --set. Throws InputError whose places name the
/// file as `stored.shown`.
Scenario read_stored(const StoredScenario& stored, Catalog& catalog, OtherPlugins others, std::vector<std::string> sets = {});

/// A run read from its folder.
struct StoredRun {
  StoredRecording stored;
  Scenario scenario;  ///< from the recording, or from scenario.resolved.yaml if the recording is a CSV file alone
};

/// Reads a run with the present plugin libraries. Throws the InputErrors of read_recording and read_stored, and one if a
/// complete recording does not fit the scenario.
StoredRun read_run(const std::string& run, Catalog& catalog);

/// The scenario for readers of every `stride`-th row, with a trace period that is `stride` times as long.
Scenario with_row_stride(const Scenario& scenario, std::size_t stride);
/// Prints a note that only every `stride`-th row is used, if `stride` is above 1.
void note_row_stride(const Scenario& seen, std::size_t stride);

}  // namespace gaitlab::kit
