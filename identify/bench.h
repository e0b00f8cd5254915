// The bench of an identification: a scenario, and the logs that it replays.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/scenario/read_scenario.h"
#include "identify/key.h"

namespace gaitlab::identify {

/// A log, and the scenario with which it is compared.
struct BenchLog {
  std::string file;                   ///< its path
  std::string name;                   ///< name of the file without its ending
  std::string group;                  ///< logs of a group are left out together when terms are chosen
  std::string hash;                   ///< hash of its text
  bool held_out = false;              ///< true if the log is not fitted
  std::vector<std::string> sets;      ///< settings of this log, in the form of --set
  std::optional<double> efficiency;   ///< stated in the place of the bench's stall current
  std::vector<std::string> of_table;  ///< those of its row in a table
  std::vector<std::size_t> left_out;  ///< rows that are spikes, from 0
  Scenario scenario;                  ///< with the bench's values of all keys
  std::unique_ptr<ScenarioTemplate> with;
  /// True if a joint has a duty, and a motor in volts, which is compared with it.
  [[nodiscard]] bool has_duty() const;
};

/// Reads the bench for every log. `logs` are files, and tables of logs: a CSV whose first column is `file`; a column `group`
/// names groups, and every other column is a setting with a value per log. Without it, logs with equal settings are a group, or
/// each log without settings. Wherever the bench names the file of its section `measured`, the run of a log has that log; it
/// begins at the angles and speeds of the log's first row, and lasts as long as the log. A stall current, which bounds the
/// product of torque and speed, is replaced by its efficiency if the logs have no currents. With `drop_spikes`, rows that are
/// spikes (Jumps) are left out. Throws InputError with the problems of all logs.
std::vector<BenchLog> read_bench(const std::string& file, const std::vector<std::string>& sets,
                                 const std::vector<std::string>& logs, Catalog& catalog, bool drop_spikes = false);

/// Throws InputError if a log lacks the quantity, if it reverses less often in all fitted logs than there are keys, or if a
/// table of logs states a key.
void check_fit(const std::vector<BenchLog>& logs, Logged kind, const std::vector<Key>& keys);

/// Marks the held-out logs: those whose name matches one of `patterns` (with * and ?), or, without a pattern, a share of the
/// groups, drawn by `seed`. Throws InputError for a pattern without a log, and if fewer than two logs are left.
void hold_out(std::vector<BenchLog>& logs, const std::vector<std::string>& patterns, double share, std::int64_t seed);

}  // namespace gaitlab::identify
