// A run and its scenario, read back from its folder alone.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording_file.h"
#include "core/scenario/scenario.h"

namespace gaitlab::app {

struct StoredScenario {
  std::string file;   ///< scenario.resolved.yaml; empty: the text comes from inside trace.h5
  std::string shown;  ///< its name in messages
  std::string text;
};

/// scenario.resolved.yaml of a run folder, or else the text inside its trace.h5 (`run` may be such a file). Throws InputError
/// if there is neither.
StoredScenario stored_scenario(const std::string& run);

/// A plugin library that has changed since the run.
struct PluginChange {
  std::string path, then, now;  ///< hashes
};
std::vector<PluginChange> changed_plugins(const StoredScenario& stored);

/// Treatment of such libraries: a run from the record refuses them, a comparison accepts and reports them.
enum class OtherPlugins { refused, taken };

/// Reads it with additional settings in the form of --set. Throws InputError with places in `shown`.
Scenario read_stored(const StoredScenario& stored, Catalog& catalog, OtherPlugins others, std::vector<std::string> sets = {});

/// A run read from its folder.
struct StoredRun {
  StoredRecording stored;
  Scenario scenario;  ///< of the recording, or if it has none, as a CSV file alone, the resolved one of the folder
};

/// Reads a run with the present plugins. Throws InputError: see read_recording and read_stored; also if a complete recording
/// does not fit the scenario.
StoredRun read_run(const std::string& run, Catalog& catalog);

}  // namespace gaitlab::app
