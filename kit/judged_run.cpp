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
#include "report/verdict/frictionless.h"

namespace gaitlab::kit {

namespace fs = std::filesystem;

namespace {

/// The run's summary.json, or an empty object if it cannot be read.
nlohmann::json summary_or_none(const fs::path& folder) {
  try {
    return read_summary(folder);
  } catch (const InputError&) {
    return nlohmann::json::object();
  }
}

/// Real time of the simulation, s, which only summary.json contains; 0 if it is missing.
double wall_time(const nlohmann::json& told) {
  const nlohmann::json value = told.value("wall_time", nlohmann::json());
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
  return report::page_data(read.scenario, recording(), summary, verdict, told_missing(read.stored.missing, read.stored.file),
                           most);
}

void JudgedRun::keep_second_runs(bool demand) {
  const fs::path file = folder() / "verdict.json";
  if (kind_of(file) != fs::file_type::regular) return;
  const std::string json = read_file(file, kMostJson);
  const bool own_word = report::take_word_without_friction(verdict, json);
  const bool own_demand = !demand || report::take_demand(verdict, json);
  if (!own_word || !own_demand)
    say(file.string(), "note", "belongs to another recording; its results of second runs are not shown");
}

void JudgedRun::keep_remedy() {
  const fs::path file = folder() / kRemedyFile;
  if (kind_of(file) != fs::file_type::regular) return;
  verdict.remedy = report::shown_remedy(read_file(file, kMostJson), scenario_hash, verdict.word);
  if (verdict.remedy.empty()) say(file.string(), "note", "is damaged or belongs to another run or verdict; it is not shown");
}

JudgedRun read_judged(const std::string& name, Catalog& catalog) {
  JudgedRun run{name, read_run(name, catalog)};
  Scenario& scenario = run.read.scenario;
  Recording& recording = run.read.stored.recording;
  run.scenario_hash = hash(resolved(scenario));
  run.period = scenario.trace.period;
  const nlohmann::json told = summary_or_none(run.folder());
  // A CSV file alone does not contain the outcome.
  if (const nlohmann::json outcome = told.value("outcome", nlohmann::json());
      outcome.is_string() && run.read.stored.origin.outcome.empty()) {
    recording.outcome = Outcome::of(outcome.get<std::string>());
  }
  run.all = thin_rows(recording);
  if (run.all) {
    scenario = with_row_stride(scenario, run.all->stride);
    note_row_stride(scenario, run.all->stride);
  }
  run.summary = report::summarise(scenario, recording, wall_time(told));
  run.summary.build = run.read.stored.origin.build;
  run.overlaps = report::overlaps(scenario, recording);
  run.verdict = report::verdict(scenario, recording, run.summary, run.overlaps);
  return run;
}

}  // namespace gaitlab::kit
