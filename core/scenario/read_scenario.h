// Reading scenarios: one from a file, or many that differ in a few settings.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

class ScenarioReader;

/// record: the scenario of an earlier run, whose limits may contradict each other, as older versions allowed.
enum class ReadAs { scenario, record };

/// Reads and checks a scenario file. `sets` are `key.path=value` texts in order. Loads the scenario's plugins into the catalog.
/// Throws InputError with every problem found, each at FILE:LINE:COL.
Scenario read_scenario(const std::string& path, const std::vector<std::string>& sets, Catalog& catalog,
                       ReadAs as = ReadAs::scenario);

/// One module of the type in a file, alone, without ground. Throws InputError with every problem found.
Scenario read_module(const std::string& path, Catalog& catalog);

/// A scenario that is parsed, assembled and checked once, for many rollouts that differ in a few settings.
class ScenarioTemplate {
 public:
  /// Throws what read_scenario throws.
  ScenarioTemplate(std::string path, std::vector<std::string> sets, Catalog& catalog);
  ~ScenarioTemplate();
  ScenarioTemplate(const ScenarioTemplate&) = delete;
  ScenarioTemplate& operator=(const ScenarioTemplate&) = delete;

  /// The scenario with further `key.path=value` texts after the template's: the same result as read_scenario with all of them.
  /// The sections that `own` names, and those that depend on them, are read again; the robot and everything else are shared.
  /// The whole file is read again if `own` sets the robot, the plugins, a type or a `.model` whose type the template set, or if
  /// the robot has no motor. Throws InputError with every problem found. One thread at a time.
  [[nodiscard]] Scenario with(const std::vector<std::string>& own) const;

 private:
  std::string path_;
  std::vector<std::string> sets_;
  Catalog& catalog_;
  std::unique_ptr<ScenarioReader> reader_;
};

}  // namespace gaitlab
