// A scenario that is parsed, assembled and checked once, for many rollouts that differ in a few settings.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab {

class ScenarioTemplate {
 public:
  /// Throws what read_scenario throws.
  ScenarioTemplate(std::string path, std::vector<std::string> sets, Catalog& catalog);
  ~ScenarioTemplate();
  ScenarioTemplate(const ScenarioTemplate&) = delete;
  ScenarioTemplate& operator=(const ScenarioTemplate&) = delete;

  /// The scenario with more `key.path=value` texts behind the template's own: what read_scenario gives for all of them. The
  /// sections that `own` names, and those that depend on them, are read anew; the robot and all else are shared, unless `own`
  /// sets the robot, the plugins or a type, for which the file is read again. Throws InputError with every problem found. One
  /// thread at a time.
  [[nodiscard]] Scenario with(const std::vector<std::string>& own) const;

 private:
  class Reader;
  std::string path_;
  std::vector<std::string> sets_;
  Catalog& catalog_;
  std::unique_ptr<Reader> reader_;
};

}  // namespace gaitlab
