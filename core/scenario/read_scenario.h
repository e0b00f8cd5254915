// Reader of one scenario from a file, or of many scenarios that differ in a few settings.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

class ScenarioReader;

/// Reads and checks a scenario file. `sets` are texts `key.path=value`, applied in order. Loads the scenario's plugins into the
/// catalog. Throws InputError with every problem found, each at FILE:LINE:COL.
Scenario read_scenario(const std::string& path, const std::vector<std::string>& sets, Catalog& catalog);

/// The scenario of an earlier run from its text. Its limits may contradict each other, because older versions allowed that.
/// Messages call the text `file`, and relative paths start at the folder of `file`.
Scenario read_record(const std::string& text, const std::string& file, const std::vector<std::string>& sets, Catalog& catalog);

/// Scenario with a single module of the type in a file, without ground. Its angles are 0, even if a hinge cannot reach 0.
/// Throws InputError with every problem found.
Scenario read_module(const std::string& path, Catalog& catalog);

/// A scenario that is parsed, assembled and checked only once, for many rollouts that differ in a few settings.
class ScenarioTemplate {
 public:
  /// Reads and checks the scenario. Throws the InputError of read_scenario().
  ScenarioTemplate(std::string path, std::vector<std::string> sets, Catalog& catalog);
  ~ScenarioTemplate();
  ScenarioTemplate(const ScenarioTemplate&) = delete;
  ScenarioTemplate& operator=(const ScenarioTemplate&) = delete;

  /// The scenario with further texts `key.path=value` after those of the template, equal to read_scenario() with all texts. The
  /// sections in `own`, and those that depend on them, are read again. The robot and all other sections are shared. The whole
  /// file is read again if `own` sets the robot, the plugins or a type, if it sets a `.model` whose type the template set, or
  /// if the robot does not have a motor. Throws InputError with every problem found. Only one thread at a time may call this.
  [[nodiscard]] Scenario with(const std::vector<std::string>& own) const;

 private:
  std::string path_;
  std::vector<std::string> sets_;
  Catalog& catalog_;
  std::unique_ptr<ScenarioReader> reader_;
};

}  // namespace gaitlab
