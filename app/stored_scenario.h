// The scenario of a run, read back from its folder alone.
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

/// The scenario that the recording of a run holds; where it holds none, as a CSV file alone, stored_scenario.
StoredScenario scenario_of(const std::string& run, const StoredRecording& read);

/// A plugin library that is not the file it was.
struct PluginChange {
  std::string path, then, now;  ///< hashes
};
std::vector<PluginChange> changed_plugins(const StoredScenario& stored);

/// What to do with such libraries: a run from the record refuses them, a comparison with it takes them and says so.
enum class OtherPlugins { refused, taken };

/// Reads it. InputError with places in `shown`.
Scenario read_stored(const StoredScenario& stored, Catalog& catalog, OtherPlugins others);

}  // namespace gaitlab::app
