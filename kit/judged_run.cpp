#include "kit/judged_run.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/files/hash.h"
#include "core/recording/run_files.h"
#include "core/scenario/resolved.h"
#include "report/remedy/remedy_text.h"
#include "report/verdict/demand.h"

namespace gaitlab::kit {

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

/// Sentences on the missing parts of a run folder, in which the trace is named without its folder.
std::vector<std::string> told_missing(std::vector<std::string> missing, const fs::path& trace) {
  for (std::string& sentence : missing) {
    if (sentence.starts_with(trace.string())) sentence.replace(0, trace.string().size(), trace.filename().string());
  }
  return missing;
}

}  // namespace

report::PageData JudgedRun::page_data(std::size_t most) const {
  return report::page_data(read.scenario, recording(), summary, verdict, told_missing(read.stored.missing, trace), most);
}

void JudgedRun::keep_demand() {
  const fs::path file = trace.parent_path() / "verdict.json";
  if (kind_of(file) != fs::file_type::regular || report::take_demand(verdict, read_file(file, kMostJson))) return;
  say(file.string(), "note", "belongs to another recording; its --demand results are not shown");
}

void JudgedRun::keep_remedy() {
  const fs::path file = trace.parent_path() / kRemedyFile;
  if (kind_of(file) != fs::file_type::regular) return;
  verdict.remedy = report::shown_remedy(read_file(file, kMostJson), scenario_hash, verdict.word);
  if (verdict.remedy.empty()) say(file.string(), "note", "is damaged or belongs to another run or verdict; it is not shown");
}

JudgedRun read_judged(const std::string& name, Catalog& catalog) {
  const fs::path trace = trace_file(name);
  JudgedRun run{name, trace, read_run(name, catalog)};
  Scenario& scenario = run.read.scenario;
  Recording& recording = run.read.stored.recording;
  run.scenario_hash = hash(resolved(scenario));
  run.period = scenario.trace.period;
  // A CSV file alone does not contain the outcome.
  if (run.read.stored.origin.outcome.empty()) {
    const nlohmann::json told = summarised(trace.parent_path(), "outcome");
    if (told.is_string()) recording.outcome = Outcome::of(told.get<std::string>());
  }
  run.all = thin_rows(recording);
  if (run.all) {
    scenario = with_row_stride(scenario, run.all->stride);
    note_row_stride(scenario, run.all->stride);
  }
  run.summary = report::summarise(scenario, recording, wall_time(trace.parent_path()));
  run.summary.build = run.read.stored.origin.build;
  run.overlaps = report::overlaps(scenario, recording);
  run.verdict = report::verdict(scenario, recording, run.summary, run.overlaps);
  return run;
}

}  // namespace gaitlab::kit
