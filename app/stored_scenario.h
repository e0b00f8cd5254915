// A run and its scenario, read back from its folder alone.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording_file.h"
#include "core/scenario/scenario.h"

namespace gaitlab::app {

struct StoredScenario {
  std::string file;   ///< scenario.resolved.yaml; empty: the text comes from inside trace.h5
  std::string shown;  ///< what messages call it
  std::string text;
};

/// scenario.resolved.yaml of a run folder, or else the text inside its trace.h5 (`run` may be such a file). InputError:
/// neither.
StoredScenario stored_scenario(const std::string& run);

/// A plugin library that is not the file it was.
struct PluginChange {
  std::string path, then, now;  ///< hashes
};
std::vector<PluginChange> changed_plugins(const StoredScenario& stored);

/// What to do with such libraries: a run from the record refuses them, a comparison with it takes them and says so.
enum class OtherPlugins { refused, taken };

/// Reads it, with more settings, as for --set. InputError with places in `shown`.
Scenario read_stored(const StoredScenario& stored, Catalog& catalog, OtherPlugins others, std::vector<std::string> sets = {});

/// A run as it lies in its folder.
struct StoredRun {
  StoredRecording stored;
  Scenario scenario;  ///< of the recording; where that holds none, as a CSV file alone, the resolved one of the folder
};

/// Reads it, with whatever plugins are there now. InputError: see read_recording and read_stored; a recording that cannot be
/// one of the scenario (where nothing of it is missing).
StoredRun read_run(const std::string& run, Catalog& catalog);

}  // namespace gaitlab::app
