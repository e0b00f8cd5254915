#include "identify/bench.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "core/files/atomic_file.h"
#include "core/files/csv_table.h"
#include "core/files/hash.h"
#include "core/laws/dc_motor.h"
#include "core/math/philox.h"
#include "core/math/random.h"
#include "core/model/pattern.h"
#include "core/scenario/built_robot.h"
#include "core/settings/settings_numbers.h"
#include "core/settings/wording.h"
#include "identify/log_check.h"

namespace gaitlab::identify {

namespace {

namespace fs = std::filesystem;

/// A log as the user names it: its file, its group, and the settings of its row in a table.
struct Entry {
  std::string file, group;
  std::vector<std::string> sets;
  SourceLocation place;
};

/// Text of a scalar in YAML, whatever its characters.
std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

std::string absolute(const fs::path& path) { return fs::absolute(path).lexically_normal().string(); }

/// Paths of all scalars of a tree that have a text, such as `cpg.model.file`.
void find_text(const Node& node, const std::string& text, const std::string& path, std::vector<std::string>& found) {
  if (node.kind == Node::Kind::scalar && node.text == text) found.push_back(path);
  for (std::size_t i = 0; i < node.keys.size(); ++i)
    find_text(node.items[i], text, path.empty() ? node.keys[i].first : path + "." + node.keys[i].first, found);
}

/// The logs of a table, or nothing if the file is a log.
std::vector<Entry> entries_of(const std::string& file) {
  const std::string text = read_file(file, kMostJson);
  std::vector<Entry> entries;
  try {
    const CsvTable table(text);
    if (table.names()[0] != "file") return {Entry{file, "", {}, {file}}};
    const std::vector<std::string> files = table.texts("file");
    for (std::size_t row = 0; row < files.size(); ++row) {
      Entry entry{(fs::path(file).parent_path() / files[row]).string(), "", {}, {file, table.line(row), 1}};
      for (const std::string& key : table.names()) {
        const std::string value = table.texts(key)[row];
        if (key == "group") {
          entry.group = value;
        } else if (key != "file" && !value.empty()) {
          entry.sets.push_back(key + "=" + value);
        }
      }
      entries.push_back(std::move(entry));
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(SourceLocation{file}, error.what());
  }
  return entries;
}

/// Keys of the bench that name the file of its section `measured`.
std::vector<std::string> keys_of_log(const Node& bench) {
  const Node* const measured = bench.find(kMeasuredSection);
  const Node* const file = measured == nullptr ? nullptr : measured->find("file");
  if (file == nullptr) {
    throw InputError(
        measured == nullptr ? bench.place : measured->place,
        "the bench has no measured.file; expected a section measured with the file of a log and its columns, such as "
        "measured: {file: log.csv, columns: {m0/hinge: {angle: angle}}}");
  }
  std::vector<std::string> keys;
  find_text(bench, file->text, "", keys);
  return keys;
}

/// Count of reversals by more than a share of the span of the values.
std::size_t reversals(const std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto [low, high] = std::ranges::minmax(values);
  const double least = share * (high - low);
  std::size_t count = 0;
  double extreme = values[0];
  int way = 0;
  for (const double value : values) {
    if (std::abs(value - extreme) > least && (way == 0 || (value > extreme) != (way > 0))) {
      if (way != 0) ++count;
      way = value > extreme ? 1 : -1;
      extreme = value;
    } else if ((way > 0 && value > extreme) || (way < 0 && value < extreme)) {
      extreme = value;
    }
  }
  return count;
}

/// Settings of the start of a run: angles and speeds of the log's first row, and its length.
std::vector<std::string> start_of(const Scenario& scenario) {
  const MeasuredLog& log = *scenario.measured.log;
  std::vector<std::string> sets{"duration=" + number_text(log.t.back())};
  for (const MeasuredLog::OfJoint& joint : log.joints) {
    const std::string& name = scenario.robot->joints[joint.joint].name;
    for (const auto& [kind, key] : {std::pair(Logged::angle, "angles"), std::pair(Logged::speed, "speeds")}) {
      const std::vector<double>& values = joint.of(kind);
      if (!values.empty()) sets.push_back(fmt::format("initial.{}.{}={}", key, name, number_text(values[0])));
    }
  }
  return sets;
}

/// Efficiency to be stated instead of a stall current; nothing if the bench has none, or the logs have currents.
std::optional<double> freed_efficiency(const Scenario& scenario) {
  const SettingsNumbers numbers(scenario.actuator);
  const SettingsNumbers::Found* const stall = numbers.find("stall_current");
  const auto logged = [](const MeasuredLog::OfJoint& joint) { return !joint.of(Logged::current).empty(); };
  if (stall == nullptr || !(stall->value[0] > 0) || std::ranges::any_of(scenario.measured.log->joints, logged)) return {};
  const std::unique_ptr<Actuator> motors = make_motors(scenario);
  const DcMotor* const dc = motors->dc_motors();
  if (dc == nullptr) return {};
  constexpr double kDigits = 1e4;
  return std::round(kDigits * dc[scenario.measured.log->joints[0].joint].efficiency) / kDigits;
}

}  // namespace

bool BenchLog::has_duty() const {
  const std::unique_ptr<Actuator> motors = make_motors(scenario);
  const auto logged = [](const MeasuredLog::OfJoint& joint) { return !joint.of(Logged::duty).empty(); };
  return motors != nullptr && motors->dc_motors() != nullptr && std::ranges::any_of(scenario.measured.log->joints, logged);
}

std::vector<BenchLog> read_bench(const std::string& file, const std::vector<std::string>& sets,
                                 const std::vector<std::string>& logs, Catalog& catalog, bool drop_spikes) {
  const std::vector<std::string> of_log = keys_of_log(read_yaml(file));
  std::vector<Entry> entries;
  for (const std::string& log : logs) std::ranges::move(entries_of(log), std::back_inserter(entries));
  std::vector<BenchLog> made;
  Problems problems;
  for (Entry& entry : entries) {
    BenchLog log;
    log.file = entry.file;
    log.name = fs::path(entry.file).stem().string();
    log.group = entry.group;
    if (log.group.empty()) log.group = entry.sets.empty() ? log.name : fmt::format("{}", fmt::join(entry.sets, ", "));
    log.sets = sets;
    std::ranges::copy(entry.sets, std::back_inserter(log.sets));
    log.of_table = std::move(entry.sets);
    const auto replays = [&](const std::string& path_or_text) {
      std::vector<std::string> all = log.sets;
      for (const std::string& key : of_log) all.push_back(key + "=" + quoted(path_or_text));
      return all;
    };
    try {
      const std::string text = read_file(entry.file, kMostJson);
      log.hash = hash128(text);
      std::vector<std::string> with_log = replays(absolute(entry.file));
      Scenario as_stated = read_scenario(file, with_log, catalog);
      if (const Jumps jumps = drop_spikes ? jumps_of(as_stated) : Jumps{}; !jumps.spikes.empty()) {
        log.left_out = jumps.spikes;
        with_log = replays(without_rows(text, jumps.spikes));
        as_stated = read_scenario(file, with_log, catalog);
      }
      log.sets = std::move(with_log);
      std::ranges::move(start_of(as_stated), std::back_inserter(log.sets));
      log.efficiency = freed_efficiency(as_stated);
      if (log.efficiency) {
        log.sets.emplace_back("actuator.stall_current=0");
        log.sets.push_back("actuator.efficiency=" + number_text(*log.efficiency));
      }
      log.with = std::make_unique<ScenarioTemplate>(file, log.sets, catalog);
      log.scenario = log.with->with({});
      made.push_back(std::move(log));
    } catch (const InputError& error) {
      for (Problem problem : error.problems()) {
        if (entry.place.line > 0) problem.notes.emplace_back(entry.place, "the row of this log");
        problems.add(std::move(problem));
      }
    }
  }
  problems.raise();
  return made;
}

void check_fit(const std::vector<BenchLog>& logs, Logged kind, const std::vector<Key>& keys) {
  constexpr double kOfSpan = 0.1;  // chosen: smaller reversals are noise
  std::size_t peaks = 0;
  for (const BenchLog& log : logs) {
    const auto& joints = log.scenario.measured.log->joints;
    if (std::ranges::all_of(joints, [&](const MeasuredLog::OfJoint& joint) { return joint.of(kind).empty(); })) {
      throw InputError(SourceLocation{log.file},
                       fmt::format("no column of the bench has the {}; expected one for a joint in measured.columns",
                                   logged_kinds()[static_cast<std::size_t>(kind)].key));
    }
    for (const Key& key : keys) {
      const auto states = [&](const std::string& set) { return set.starts_with(key.name + "="); };
      if (std::ranges::any_of(log.of_table, states)) {
        throw InputError(SourceLocation{"--fit"},
                         fmt::format("{} has a value per log in the table, and cannot be fitted", key.name));
      }
    }
    if (log.held_out) continue;
    for (const MeasuredLog::OfJoint& joint : joints) peaks += reversals(joint.of(kind), kOfSpan);
  }
  if (peaks < keys.size()) {
    throw InputError(SourceLocation{"--fit"},
                     fmt::format("{} cannot follow from {} of the {} in the fitted logs; fit fewer keys, log more motion, or "
                                 "compare other quantities (--of)",
                                 counted(keys.size(), "key"), counted(peaks, "reversal"),
                                 logged_kinds()[static_cast<std::size_t>(kind)].key));
  }
}

void hold_out(std::vector<BenchLog>& logs, const std::vector<std::string>& patterns, double share, std::int64_t seed) {
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (BenchLog& log : logs) {
      if (!glob(pattern, log.name) && !glob(pattern, fs::path(log.file).filename().string())) continue;
      any = log.held_out = true;
    }
    if (!any) throw InputError(SourceLocation{"--hold-out"}, fmt::format("no log matches {}", in_quotes(pattern)));
  }
  if (patterns.empty()) {
    std::map<std::string, double> groups;  // by name, a number drawn for each
    for (const BenchLog& log : logs)
      groups[log.group] = math::uniform({static_cast<std::uint64_t>(seed), math::fnv1a32(log.group)});
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [name, drawn] : groups) order.emplace_back(drawn, name);
    std::ranges::sort(order);
    // A quarter of three groups is one: the error of logs that were fitted is not a test.
    constexpr std::size_t kFew = 3;
    auto out = static_cast<std::size_t>(share * static_cast<double>(order.size()));
    if (share > 0 && out == 0 && order.size() >= kFew) out = 1;
    for (BenchLog& log : logs) {
      log.held_out = std::ranges::any_of(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(out),
                                         [&](const auto& one) { return one.second == log.group; });
    }
  }
  const auto fitted = std::ranges::count(logs, false, &BenchLog::held_out);
  if (fitted < 2) {
    throw InputError(SourceLocation{patterns.empty() ? "--share" : "--hold-out"},
                     fmt::format("{} of {} would be fitted; expected at least 2", fitted, counted(logs.size(), "log")));
  }
}

}  // namespace gaitlab::identify
