// The scenarios of a study: one, or several with names; every point runs in each.
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
  std::string name;  ///< empty: the only one
  std::unique_ptr<ScenarioTemplate> file = {};
  Scenario nominal = {};      ///< with the study's settings
  std::string resolved = {};  ///< the same as text
  std::vector<std::string> joints = {};
  std::map<std::string, double> nominal_values = {};  ///< of keys that vary by a factor
  std::vector<std::string> other_engine = {};         ///< settings that select the engine of `verify`, with its default step
};

/// Reads the scenarios with the study's settings. Throws InputError with every problem found.
std::vector<StudyScenario> read_scenarios(const Study& study, Catalog& catalog);

/// Reports an error of a setting as an error of the parameter or variation that makes it, at its place in the study.
void add_as_written(const InputError& error, const Study& study, Problems& problems);

/// `found`: per scenario. A problem of all scenarios is reported once, one of some scenarios with their names.
void add_of_each(const std::vector<StudyScenario>& scenarios, const std::vector<Problems>& found, Problems& problems);

/// A resolved scenario with its name.
struct ScenarioText {
  std::string name, text;
};

/// Text in a journal: for several scenarios a document each, below a line `--- # scenario NAME`; for a single one its text.
std::string scenarios_text(const std::vector<StudyScenario>& scenarios);
/// The scenarios of such a text; empty: it is the text of a single one.
std::vector<ScenarioText> scenario_texts(const std::string& text);

}  // namespace gaitlab::studies
