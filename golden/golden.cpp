#include "golden/golden.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>

#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/files/folder_lock.h"
#include "core/files/shallow_json.h"
#include "core/settings/wording.h"

namespace gaitlab::golden {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr int kJsonVersion = 1;
constexpr const char* kVersionKey = "gaitlab_golden";
constexpr std::string_view kChecksum = ",\n  \"checksum\": \"";  // the last key, with the checksum of the preceding text
constexpr const char* kJsonFile = "golden.json";
constexpr const char* kTraceFile = "trace.golden";
// Name of a new trace until golden.json, which contains the hash of the trace, has replaced the old golden.json.
constexpr const char* kNextTraceFile = "trace.golden.next";

std::string checksum_line(std::string_view content) { return fmt::format("{}{}\"\n}}\n", kChecksum, hash(content)); }

// ---- golden.json as text: one line per column, so that a version control system shows the changes

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json to_json(const Band& band) {
  Json json = {{"band", band.width()}, {"ensemble", band.ensemble}, {"halving", band.halving}, {"floor", band.floor}};
  if (band.constant > 0) json["constant"] = band.constant;
  return json;
}

std::string lines_of(const std::vector<std::pair<std::string, Json>>& entries) {
  std::string text = "{";
  for (const auto& [name, json] : entries)
    text += fmt::format("{}\n    {}: {}", text.size() == 1 ? "" : ",", text_of(name), text_of(json));
  return text + "\n  }";
}

std::string columns_text(const Golden& golden) {
  std::vector<std::pair<std::string, Json>> entries;
  for (std::size_t i = 1; i < golden.bands.size(); ++i) {
    Json json = to_json(golden.bands[i]);
    json["precision"] = golden.run.precision[i];
    json["rounding"] = golden.rounding[i];
    json["unit"] = golden.run.trace.columns[i].unit;
    entries.emplace_back(golden.run.trace.columns[i].name, std::move(json));
  }
  return lines_of(entries);
}

std::string numbers_text(const Golden& golden) {
  std::vector<std::pair<std::string, Json>> entries;
  for (std::size_t i = 0; i < golden.numbers.size(); ++i) {
    Json json = {{"value", golden.numbers[i].value}, {"unit", golden.numbers[i].unit}};
    json.update(to_json(golden.number_bands[i]));
    entries.emplace_back(golden.numbers[i].name, std::move(json));
  }
  return lines_of(entries);
}

std::string history_text(const Golden& golden) {
  std::string text = "[";
  for (const Approval& approval : golden.history) {
    const Json json = {{"number", approval.number}, {"reason", approval.reason}, {"build", approval.build}};
    text += fmt::format("{}\n    {}", text.size() == 1 ? "" : ",", text_of(json));
  }
  return text + "\n  ]";
}

std::string resolved_text(const GoldenProvenance& origin) {
  std::string text = "[";
  for (std::size_t at = 0; at < origin.resolved.size();) {
    const std::size_t end = std::min(origin.resolved.find('\n', at), origin.resolved.size());
    text += fmt::format("{}\n    {}", at == 0 ? "" : ",", text_of(origin.resolved.substr(at, end - at)));
    at = end + 1;
  }
  return text + "\n  ]";
}

std::string json_text(const Golden& golden, std::string_view trace_bytes) {
  const GoldenProvenance& o = golden.origin;
  const Trace& trace = golden.run.trace;
  std::string text = fmt::format("{{\n  \"{}\": {}", kVersionKey, kJsonVersion);
  const auto add = [&](const char* key, const std::string& value) { text += fmt::format(",\n  \"{}\": {}", key, value); };
  add("name", text_of(o.name));
  add("engine", text_of(o.engine));
  add("integrator", text_of(o.integrator));
  add("step", text_of(o.step));
  add("build", text_of(o.build));
  add("compiler", text_of(o.compiler));
  add("scenario", text_of(o.scenario));
  add("reason", text_of(golden.history.empty() ? "" : golden.history.back().reason));
  add("history", history_text(golden));
  add("verdict", text_of(name_of(golden.verdict)));
  if (golden.starts > 1) add("starts", text_of(golden.starts));
  if (!golden.selected.empty()) add("selected", text_of(golden.selected));
  add("rows", text_of(trace.rows()));
  add("trace", text_of(hash(trace_bytes)));
  add("columns", columns_text(golden));
  add("numbers", numbers_text(golden));
  // The text is omitted if JSON cannot represent it, as with a path that is not UTF-8.
  if (!o.resolved.empty() && Json::parse(text_of(o.resolved)) == o.resolved) add("resolved", resolved_text(o));
  return text + checksum_line(text);
}

// ---- golden.json read

InputError wrong(const fs::path& file, std::string text) { return {SourceLocation{file.string()}, std::move(text)}; }

// Parses the document and checks version and checksum.
Json checked(const fs::path& file, const std::string& text) {
  if (text.empty()) throw wrong(file, "is truncated: 0 bytes");
  const std::string start = fmt::format("{{\n  \"{}\": ", kVersionKey);
  const bool ours = text.starts_with(start);
  Json json = shallow_json(text);
  if (!ours && !start.starts_with(text) && (json.is_discarded() || !json.is_object() || !json.contains(kVersionKey)))
    throw wrong(file, "is not a golden of gaitlab");
  if (json.is_discarded()) {
    const bool whole = text.ends_with("\"\n}\n");
    throw wrong(file, whole ? "is corrupt: it is not JSON" : fmt::format("is truncated: it ends after {} bytes", text.size()));
  }
  const Json& version = json[kVersionKey];
  if (version.is_number_integer() && version != kJsonVersion) {
    throw wrong(file, fmt::format("has golden format {}; this gaitlab reads {}: use the version of gaitlab that wrote it",
                                  text_of(version), kJsonVersion));
  }
  const std::size_t end = text.rfind(kChecksum);
  const std::string_view content = std::string_view(text).substr(0, end);
  if (text.find('\r') != std::string::npos) throw wrong(file, kLineEnds);
  if (end == std::string::npos || text.substr(end) != checksum_line(content))
    throw wrong(file, "is corrupt or was changed by hand: its checksum does not match; only gaitlab approve changes goldens");
  return json;
}

Band band_of(const Json& json) {
  return {json.at("ensemble"), json.at("halving"), json.at("floor"), json.value("constant", 0.0)};
}

std::string resolved_of(const Json& lines, const std::string& hash_then) {
  std::string text;
  for (const Json& line : lines) text += line.get<std::string>() + "\n";
  if (hash(text) != hash_then) throw std::runtime_error("its resolved scenario differs from the approved one");
  return text;
}

Golden from_json(const Json& json) {
  Golden golden;
  golden.origin = {json.at("name"),  json.at("engine"),   json.at("integrator"), json.at("step"),
                   json.at("build"), json.at("compiler"), json.at("scenario")};
  if (json.contains("resolved")) golden.origin.resolved = resolved_of(json["resolved"], golden.origin.scenario);
  const auto verdict = json.at("verdict").get<std::string>();
  const std::optional<Word> word = named<Word>(verdict);
  if (!word) throw std::runtime_error("its verdict is '" + clipped(verdict) + "'");
  golden.verdict = *word;
  if (json.contains("starts")) golden.starts = json["starts"].get<int>();
  if (json.contains("selected")) golden.selected = json["selected"].get<std::vector<std::string>>();
  for (const Json& entry : json.at("history"))
    golden.history.push_back({entry.at("number"), entry.at("reason"), entry.at("build")});
  if (golden.history.empty()) throw std::runtime_error("its history is empty");
  for (const auto& [name, entry] : json.at("numbers").items()) {
    golden.numbers.push_back({name, entry.at("unit"), entry.at("value")});
    golden.number_bands.push_back(band_of(entry));
  }
  return golden;
}

// The trace that belongs to golden.json, under its final name, or under the name from an interrupted process.
RoundedTrace matching_trace(const fs::path& folder, const std::string& wanted) {
  std::error_code error;
  const bool missing = !fs::exists(folder / kTraceFile, error);
  for (const char* name : {kTraceFile, kNextTraceFile}) {
    if (!fs::exists(folder / name, error)) continue;
    const std::string bytes = read_file(folder / name, kMostTrace);
    if (hash(bytes) == wanted) return unpack(bytes, folder / name);
  }
  const fs::path file = folder / kTraceFile;
  if (missing) throw wrong(file, "is missing: the golden is incomplete");
  (void)unpack(read_file(file, kMostTrace), file);  // reports errors of the file
  throw wrong(file, "belongs to another approval than golden.json");
}

void take_bands(const Json& columns, Golden& golden) {
  const ColumnList& in_trace = golden.run.trace.columns;
  golden.bands.assign(1, {});
  golden.rounding.assign(1, 0.0);
  for (const auto& [name, entry] : columns.items()) {
    const std::size_t i = golden.bands.size();
    if (i >= in_trace.size() || in_trace[i].name != name) throw std::runtime_error("its columns are not those of the trace");
    golden.bands.push_back(band_of(entry));
    golden.rounding.push_back(entry.at("rounding"));
  }
  if (golden.bands.size() != in_trace.size()) throw std::runtime_error("its columns are not those of the trace");
}

/// True if golden.json contains the hash of the trace under its temporary name.
bool next_belongs(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / kNextTraceFile, error) || !fs::is_regular_file(folder / kJsonFile, error)) return false;
  const Json json = shallow_json(read_file(folder / kJsonFile, kMostJson));
  return json.is_object() && json.contains("trace") && json["trace"] == hash(read_file(folder / kNextTraceFile, kMostTrace));
}

void rename_next(const fs::path& folder) {
  std::error_code error;
  fs::rename(folder / kNextTraceFile, folder / kTraceFile, error);
  if (error) throw RunError(fmt::format("{}: cannot be written: {}", (folder / kTraceFile).string(), error.message()));
}

}  // namespace

double Band::width() const { return std::max({ensemble, halving, floor}); }

fs::path golden_folder(const fs::path& scenario) { return fs::path(scenario).replace_extension(".golden"); }

void write_golden(const Golden& golden, const fs::path& folder) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) throw RunError(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
  FolderLock lock;
  if (!lock.take(folder)) throw wrong(folder, "is being written by another process; try again later");
  if (next_belongs(folder)) rename_next(folder);  // a write_golden() has ended between its two renames
  const std::string bytes = pack(golden.run.trace);
  write_file(folder / kNextTraceFile, bytes);
  try {
    write_file(folder / kJsonFile, json_text(golden, bytes));  // from here on, the new golden is valid
  } catch (...) {
    // In a folder that cannot be synced, golden.json may already have its name. The new trace then belongs to it.
    if (!next_belongs(folder)) fs::remove(folder / kNextTraceFile, error);
    throw;
  }
  rename_next(folder);
}

Golden read_golden(const fs::path& folder) {
  const fs::path file = folder / kJsonFile;
  const fs::file_type kind = kind_of(folder);
  if (kind == fs::file_type::not_found) throw wrong(folder, "there is no such golden; gaitlab approve makes it");
  if (kind != fs::file_type::directory) throw wrong(folder, "is not a golden: a golden is a folder");
  if (kind_of(file) == fs::file_type::not_found) throw wrong(file, "is missing: the golden is incomplete");
  const Json json = checked(file, read_file(file, kMostJson));
  try {
    Golden golden = from_json(json);
    golden.run = matching_trace(folder, json.at("trace"));
    take_bands(json.at("columns"), golden);
    return golden;
  } catch (const InputError&) {
    throw;
  } catch (const Json::exception&) {  // the message of this exception contains no place
    throw wrong(file, "is corrupt: an entry is missing or of another type");
  } catch (const std::runtime_error& damage) {
    throw wrong(file, fmt::format("is corrupt: {}", damage.what()));
  }
}

}  // namespace gaitlab::golden
