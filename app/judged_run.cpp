#include "app/judged_run.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/files/hash.h"
#include "core/recording/run_files.h"
#include "core/scenario/resolved.h"
#include "report/remedy/remedy_text.h"
#include "report/verdict/demand.h"

namespace gaitlab::app {

namespace fs = std::filesystem;

namespace {

/// A value of the run's summary.json. Null if the key is missing, or if the file cannot be read.
nlohmann::json summarised(const fs::path& folder, const char* key) try {
  const nlohmann::json summary = read_summary(folder);
  const auto found = summary.find(key);
  return found != summary.end() ? *found : nlohmann::json();
} catch (const InputError&) {
  return {};
}

/// Real time of the simulation, s, which only summary.json contains; 0 if it is missing.
double wall_time(const fs::path& folder) {
  const nlohmann::json value = summarised(folder, "wall_time");
  const double seconds = value.is_number() ? value.get<double>() : 0;
  return std::isfinite(seconds) && seconds >= 0 ? seconds : 0;
}

/// Sentences on the missing parts of a run folder, with the path of the folder removed.
std::vector<std::string> told_missing(std::vector<std::string> missing, const fs::path& trace) {
  for (std::string& sentence : missing) {
    if (sentence.starts_with(trace.string())) sentence.replace(0, trace.string().size(), trace.filename().string());
  }
  return missing;
}

/// Adds the demand results of an earlier --demand to the verdict. They are read from verdict.json, because recordings do not
/// contain them.
void keep_demand(report::Verdict& verdict, const fs::path& file) {
  if (kind_of(file) != fs::file_type::regular || report::take_demand(verdict, read_file(file, kMostJson))) return;
  say(file.string(), "note", "belongs to another recording; its --demand results are not shown");
}

/// Adds the remedy of an earlier search to the verdict, from remedy.json.
void keep_remedy(report::Verdict& verdict, const fs::path& file, const std::string& scenario_hash) {
  if (kind_of(file) != fs::file_type::regular) return;
  verdict.remedy = report::shown_remedy(read_file(file, kMostJson), scenario_hash, verdict.word);
  if (verdict.remedy.empty()) say(file.string(), "note", "is damaged or belongs to another run or verdict; it is not shown");
}

}  // namespace

report::PageData JudgedRun::page_data(std::size_t most) const {
  return report::page_data(read.scenario, recording(), summary, verdict, told_missing(read.stored.missing, trace), most);
}

JudgedRun judged_run(const std::string& name, Catalog& catalog, const std::vector<std::string>& joints,
                     const SummaryOptions& shown) {
  const fs::path trace = trace_file(name);
  JudgedRun run{name, trace, read_run(name, catalog)};
  Scenario& scenario = run.read.scenario;
  Recording& recording = run.read.stored.recording;
  const std::string scenario_hash = hash(resolved(scenario));
  run.period = scenario.trace.period;
  draw_joints(scenario, joints);
  // A CSV file alone does not contain the outcome.
  if (run.read.stored.origin.outcome.empty()) {
    const nlohmann::json told = summarised(trace.parent_path(), "outcome");
    if (told.is_string()) recording.outcome = Outcome::of(told.get<std::string>());
  }
  if (const std::optional<AllRows> all = thin_rows(recording)) {
    scenario = with_row_stride(scenario, all->stride);
    note_row_stride(scenario, all->stride);
  }
  run.summary = report::summarise(scenario, recording, wall_time(trace.parent_path()));
  run.summary.build = run.read.stored.origin.build;
  run.overlaps = report::overlaps(scenario, recording);
  run.verdict = judged(scenario, recording, run.summary, run.overlaps, shown);
  if (!shown.demand) keep_demand(run.verdict, trace.parent_path() / "verdict.json");
  keep_remedy(run.verdict, trace.parent_path() / kRemedyFile, scenario_hash);
  return run;
}

void warn(const JudgedRun& run) {
  const Recording& recording = run.recording();
  for (const std::string& missing : run.read.stored.missing) say(run.name, "note", missing);
  if (!recording.outcome.done()) say(run.name, "note", "this run ended early: " + recording.outcome.text());
  warn_of_run(run.read.scenario, recording, run.verdict);
}

}  // namespace gaitlab::app
