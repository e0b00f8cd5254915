#include "studies/study/scenarios.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/files/atomic_file.h"
#include "core/scenario/resolved.h"
#include "core/settings/shipped_files.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"

namespace gaitlab::studies {

namespace {

constexpr std::string_view kDocument = "--- # scenario ";  // no line of a resolved scenario begins with this text

bool alike(const Problem& a, const Problem& b) { return a.text == b.text && to_string(a.place) == to_string(b.place); }

bool holds(const Problems& problems, const Problem& one) {
  return std::ranges::any_of(problems.list(), [&](const Problem& other) { return alike(one, other); });
}

std::vector<std::string> joints_of(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const auto& joint : scenario.robot->joints) names.push_back(joint.name);
  return names;
}

/// The problems of a scenario that a study file names, without quotes of the scenario's lines.
InputError without_quotes(const InputError& error, const std::filesystem::path& study, const std::string& scenario) {
  Problems found;
  Problems told;
  add_all(error, found);
  add_found(found, {scenario, study.parent_path().string(), "scenario", "gaitlab"}, told);
  return InputError(told.list());
}

/// True if a scenario that a study file names cannot be read. Then adds a problem at its place in the study.
bool is_unreadable(const NamedScenario& named, Problems& problems) {
  if (named.place.file.empty()) return false;
  try {
    static_cast<void>(read_start(named.file, 1));
    return false;
  } catch (const InputError& error) {
    std::vector<std::string> names;
    for (const auto& [name, path] : shipped_files("scenario")) names.push_back(name);
    const std::string near = gaitlab::nearest(std::filesystem::path(named.file).stem().string(), names);
    problems.add(named.place, fmt::format("file '{}' {}{}", named.file, error.problems().front().text,
                                          near.empty() ? "" : fmt::format("; `scenario: {}` names a shipped one", near)));
    return true;
  }
}

}  // namespace

std::vector<StudyScenario> read_scenarios(const Study& study, const Problems& before, Catalog& catalog) {
  std::vector<NamedScenario> files = study.scenarios;
  if (files.empty()) files.push_back({"", study.scenario, study.scenario_place});
  std::vector<StudyScenario> scenarios;
  std::vector<Problems> found(files.size());
  for (std::size_t k = 0; k < files.size(); ++k) {
    StudyScenario& one = scenarios.emplace_back(StudyScenario{files[k].name});
    if (is_unreadable(files[k], found[k])) continue;
    try {
      one.file = std::make_unique<ScenarioTemplate>(files[k].file, study.sets, catalog);
      one.nominal = one.file->with({});
      one.resolved = resolved(one.nominal);
      one.joints = joints_of(one.nominal);
    } catch (const InputError& error) {
      add_as_written(study.file.empty() ? error : without_quotes(error, study.file, files[k].file), study, found[k]);
    }
  }
  Problems problems = before;
  add_of_each(scenarios, found, problems);
  if (problems.size() > before.size()) problems.raise();
  return scenarios;
}

void add_as_written(const InputError& error, const Study& study, Problems& problems) {
  for (const Problem& problem : error.problems()) {
    SourceLocation place = problem.place;
    const std::string written = problem.place.file;
    const auto makes = [&](const auto& one) { return written.starts_with("--set " + one.key + "="); };
    const auto parameter = std::ranges::find_if(study.parameters, makes);
    const auto variation = std::ranges::find_if(study.replicates.vary, makes);
    for (std::size_t k = 0; k < study.set_places.size(); ++k) {
      if (place.file == "--set " + clipped(study.sets[k])) place = study.set_places[k];
    }
    if (variation != study.replicates.vary.end()) place = variation->place;
    if (parameter != study.parameters.end()) place = parameter->place;
    for (const Parameter& own : study.parameters) {
      const auto follower = std::ranges::find_if(own.sets, makes);
      if (follower != own.sets.end()) place = follower->place;
    }
    if (!holds(problems, {place, problem.text})) problems.add(place, problem.text).notes = problem.notes;
  }
}

void add_of_each(const std::vector<StudyScenario>& scenarios, const std::vector<Problems>& found, Problems& problems) {
  for (std::size_t k = 0; k < scenarios.size(); ++k) {
    for (const Problem& problem : found[k].list()) {
      const bool everywhere = std::ranges::all_of(found, [&](const Problems& other) { return holds(other, problem); });
      if (everywhere && k > 0) continue;
      const std::string where = everywhere ? "" : fmt::format(" (in scenario {})", clipped(scenarios[k].name));
      problems.add(problem.place, problem.text + where).notes = problem.notes;
    }
  }
}

std::string scenarios_text(const std::vector<StudyScenario>& scenarios) {
  if (scenarios.front().name.empty()) return scenarios.front().resolved;
  std::string text;
  for (const StudyScenario& one : scenarios) text += fmt::format("{}{}\n{}", kDocument, one.name, one.resolved);
  return text;
}

std::vector<ScenarioText> scenario_texts(const std::string& text) {
  std::vector<ScenarioText> texts;
  for (std::size_t at = 0; text.compare(at, kDocument.size(), kDocument) == 0;) {
    const std::size_t name = at + kDocument.size();
    const std::size_t line = std::min(text.find('\n', name), text.size());
    const std::size_t next = text.find("\n" + std::string(kDocument), line);
    const std::size_t end = next == std::string::npos ? text.size() : next + 1;
    const std::size_t from = std::min(line + 1, end);
    texts.push_back({text.substr(name, line - name), text.substr(from, end - from)});
    at = end;
    if (at >= text.size()) break;
  }
  return texts;
}

}  // namespace gaitlab::studies
