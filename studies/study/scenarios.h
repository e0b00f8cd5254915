// The scenarios of a study: one, or several by name, in each of which every point runs.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/scenario/read_scenario.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// A scenario of a study, read once.
struct StudyScenario {
  std::string name;  ///< empty: it is the only one
  std::unique_ptr<ScenarioTemplate> file = {};
  Scenario nominal = {};      ///< with the study's own settings
  std::string resolved = {};  ///< that as text
  std::vector<std::string> joints = {};
  std::map<std::string, double> nominal_values = {};  ///< of keys that vary as a multiple
  std::vector<std::string> other_engine = {};         ///< settings that take the engine of `verify`, with its own step
};

/// Reads them with the study's settings. InputError with every problem found.
std::vector<StudyScenario> read_scenarios(const Study& study, Catalog& catalog);

/// What is wrong with a setting is told of the parameter or variation that makes it, at its place in the study.
void add_as_written(const InputError& error, const Study& study, Problems& problems);

/// `found`: of each scenario. What is wrong in all of them is told once, what is wrong in some with the name of each.
void add_of_each(const std::vector<StudyScenario>& scenarios, const std::vector<Problems>& found, Problems& problems);

/// A resolved scenario under its name.
struct ScenarioText {
  std::string name, text;
};

/// As a journal holds them: of several scenarios a document each, below a line `--- # scenario NAME`; the only one as it is.
std::string scenarios_text(const std::vector<StudyScenario>& scenarios);
/// Those of several scenarios, taken apart again; empty: the text is that of one.
std::vector<ScenarioText> scenario_texts(const std::string& text);

}  // namespace gaitlab::studies
