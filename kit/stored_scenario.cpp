#include "kit/stored_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/files/file_kind.h"
#include "core/files/spill.h"
#include "core/recording/run_files.h"
#include "core/scenario/buses.h"
#include "core/scenario/plugin_files.h"
#include "core/scenario/read_scenario.h"
#include "core/settings/node.h"
#include "core/simulation/probes.h"

namespace gaitlab::kit {

namespace {

namespace fs = std::filesystem;

/// Entries of `plugins:` in a resolved scenario, each with path and hash. Empty if the text has another form, which the reader
/// of the scenario reports.
std::vector<PluginFile> recorded_plugins(const StoredScenario& stored) {
  Problems ignored;
  const std::optional<Node> root = parse_yaml(stored.text, stored.shown, ignored);
  const Node* plugins = root ? root->find("plugins") : nullptr;
  std::vector<PluginFile> files;
  for (const Node& item : plugins != nullptr ? plugins->items : std::vector<Node>()) {
    const Node* path = item.find("path");
    const Node* hash = item.find("hash");
    if (path != nullptr && hash != nullptr) files.push_back({path->text, hash->text});
  }
  return files;
}

}  // namespace

StoredTrace& OpenedRun::trace() {
  if (!trace_) {
    trace_ = read_trace(run_);
    trace_->beside.clear();  // may be as large as the trace
  }
  return *trace_;
}

StoredScenario OpenedRun::scenario() {
  const fs::path yaml = fs::path(run_) / "scenario.resolved.yaml";
  std::error_code none;
  if (fs::exists(yaml, none)) return {yaml.string(), read_file(yaml, kMostJson), true};
  const fs::path file = trace_file(run_);
  if (file.extension() == ".h5") return {file.string() + " (its scenario)", trace().origin.scenario};
  throw InputError(SourceLocation{file.string()},
                   "a CSV trace does not contain its scenario, and there is no file " + yaml.string());
}

std::vector<PluginChange> changed_plugins(const StoredScenario& stored, const Catalog& catalog) {
  std::vector<PluginChange> changed;
  const std::string folder = fs::path(stored.shown).parent_path().string();
  for (const PluginFile& file : recorded_plugins(stored)) {
    const std::string now = file_hash(plugin_path(file, folder, catalog));
    if (!now.empty() && now != file.hash) changed.push_back({file.path, file.hash, now});
  }
  return changed;
}

Scenario read_stored(const StoredScenario& stored, Catalog& catalog, OtherPlugins others, std::vector<std::string> sets) {
  if (others == OtherPlugins::taken && !changed_plugins(stored, catalog).empty()) {
    nlohmann::json paths = nlohmann::json::array();  // JSON, which is valid YAML and quotes any character of a path
    for (const PluginFile& file : recorded_plugins(stored)) paths.push_back(file.path);
    sets.push_back("plugins=" + paths.dump());
  }
  if (stored.is_file) expect_kind(stored.shown, FileKind::scenario);
  return read_record(stored.text, stored.shown, sets, catalog);
}

namespace {

/// Throws InputError if the recording does not fit the scenario, which only happens for files that were exchanged or changed.
void check_fit(const std::string& run, const Scenario& scenario, const Recording& recording) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(SourceLocation{run},
                     "its recording does not fit its scenario: " + what +
                         "; one of the two files belongs to another run: restore the right file, or simulate again");
  };
  const std::size_t joints = scenario.robot->joints.size();
  if (recording.joints.size() != joints) refuse(fmt::format("{} joints, {} in the scenario", recording.joints.size(), joints));
  const std::size_t columns = recording.poses.columns.size();
  if (columns != pose_columns(joints).size()) refuse(fmt::format("{} columns of poses, of {} joints", columns, joints));
  if (recording.ticks.columns.size() != tick_columns(joints).size()) {
    refuse(fmt::format("{} columns of ticks, of {} joints", recording.ticks.columns.size(), joints));
  }
  if (const std::vector<MotorBus> all = buses(scenario); recording.ticks.rows() > 0 && recording.buses() != all.size()) {
    refuse(all.empty()              ? "the scenario has no supply"
           : recording.buses() == 0 ? "there is no table of the scenario's supply"
                                    : fmt::format("{} supplies, of {} in the scenario", recording.buses(), all.size()));
  }
  const bool contact = recording.worst.source == Stability::Source::contact;
  const std::size_t places = contact ? contact_elements(*scenario.robot, scenario.contact.on).size() : joints;
  if (recording.worst.rate > 0 && recording.worst.index >= places) {
    refuse(fmt::format("stability.index is {}, but the scenario has only {} {}", recording.worst.index, places,
                       contact ? "contact elements" : "joints"));
  }
  bool whole = recording.has_states(*scenario.robot);
  for (const char* column : {"com.x", "com.y", "com.z"}) whole = whole && !recording.series(column).empty();
  for (std::size_t j = 0; j < joints && scenario.actuator.entry != nullptr; ++j) {
    if (!scenario.robot->joints[j].driven()) continue;
    for (const char* quantity : {"setpoint", "torque"}) whole = whole && !recording.joint(j, quantity).empty();
  }
  if (!whole && recording.rows() > 0) refuse("columns that every recording contains are missing");
}

/// Adds units and definitions to the columns of a CSV file, which does not contain them.
void name_units(const Scenario& scenario, Trace& trace) {
  const auto bare = [](const Column& column) { return column.definition.empty(); };
  if (std::ranges::none_of(trace.columns, bare)) return;
  const ColumnList known = Probes::known(scenario);
  trace.columns.change([&](std::vector<Column>& columns) {
    for (Column& column : columns) {
      const std::size_t same = known.find(column.name);
      if (bare(column) && same < known.size()) column = known[same];
    }
  });
}

}  // namespace

StoredRun read_run(const std::string& run, Catalog& catalog) {
  StoredRecording stored = read_recording(run);
  const std::string& inside = stored.origin.scenario;  // empty if the recording is a CSV file alone
  const StoredScenario text =
      inside.empty() ? OpenedRun(run).scenario() : StoredScenario{stored.tables.string() + " (its scenario)", inside};
  Scenario scenario = read_stored(text, catalog, OtherPlugins::taken);
  if (stored.missing.empty()) check_fit(run, scenario, stored.recording);
  name_units(scenario, stored.recording.trace);
  return {std::move(stored), std::move(scenario)};
}

Scenario with_row_stride(const Scenario& scenario, std::size_t stride) {
  Scenario seen = scenario;
  seen.trace.period *= static_cast<double>(stride);
  return seen;
}

void note_row_stride(const Scenario& seen, std::size_t stride) {
  if (stride <= 1) return;
  say(seen.file, "note",
      fmt::format(
          "figure and page use only one row in {}, {:.3g} s apart, because all rows need more than {:.3g} MB; the trace has "
          "all rows",
          stride, seen.trace.period, static_cast<double>(kMostInMemory) / 1e6));
}

}  // namespace gaitlab::kit
