// The scenarios of a study. Every point runs in each of them.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/scenario/read_scenario.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// A scenario of a study, read from its file once.
struct StudyScenario {
  std::string name;  ///< empty if the study has only one scenario
  std::unique_ptr<ScenarioTemplate> file = {};
  Scenario nominal = {};      ///< scenario with the settings that the study applies to all runs
  std::string resolved = {};  ///< `nominal` as text
  std::vector<std::string> joints = {};
  std::map<std::string, double> nominal_values = {};  ///< values of the keys that variations multiply by a factor
  std::vector<std::string> other_engine = {};         ///< settings that select the engine of `verify`, with its default step
};

/// Reads the scenarios with the study's settings. If problems are found, throws InputError with `before` and these problems.
std::vector<StudyScenario> read_scenarios(const Study& study, const Problems& before, Catalog& catalog);

/// Reports an error in a setting as an error of the parameter or variation that defines the setting, at its place in the study.
void add_as_written(const InputError& error, const Study& study, Problems& problems);

/// Adds the problems found in each scenario. A problem found in all scenarios is added once. A problem found in only some is
/// added once per scenario, with that scenario's name.
void add_of_each(const std::vector<StudyScenario>& scenarios, const std::vector<Problems>& found, Problems& problems);

/// A resolved scenario with its name.
struct ScenarioText {
  std::string name, text;
};

/// Text of the scenarios in a journal. The text of a single scenario is the resolved text. If there are several, each resolved
/// text follows a line `--- # scenario NAME`.
std::string scenarios_text(const std::vector<StudyScenario>& scenarios);
/// The scenarios of a text by scenarios_text(). Empty if the text is that of a single scenario.
std::vector<ScenarioText> scenario_texts(const std::string& text);

}  // namespace gaitlab::studies
