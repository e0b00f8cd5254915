#include "core/scenario/scenario_periods.h"

#include <vector>

#include "core/scenario/scenario_checks.h"
#include "core/scenario/section_places.h"
#include "core/settings/periods.h"

namespace gaitlab {

void check_step(const Node& root, const Scenario& scenario, Problems& problems) {
  std::vector<Period> periods{{"control period", scenario.control_period, given(root, "controller", "period")},
                              {"trace period", scenario.trace.period, given(root, "trace", "period")}};
  if (const Node* duration = root.find("duration"); duration != nullptr && scenario.duration > 0)
    periods.push_back({"duration", scenario.duration, duration->place});
  const Period step{"step", scenario.physics.step, given(root, "physics", "step")};
  check_periods(periods, step, place_of(root, "physics", "step"), problems);
}

void finish_periods(const Node& root, Scenario& scenario, const Catalog& catalog, Problems& problems) {
  // Without set points and actuator, the only purpose of the control tick is to monitor the step.
  if (scenario.actuator.entry == nullptr && root.find("cpg") == nullptr) {
    scenario.control_period = scenario.physics.adaptive_step ? kLongestStep : scenario.trace.period;
    scenario.cpg_step = scenario.control_period;
  }
  Physics& physics = scenario.physics;
  if (physics.engine != nullptr && !physics.adapts()) ScenarioChecks(root, scenario, catalog, problems).automatic_step();
  const Period control{"control period", scenario.control_period, given(root, "controller", "period")};
  if (physics.adaptive_step) {
    physics.step = longest_step(scenario.control_period);
  } else if (physics.step > 0 && !physics.chosen_step) {
    check_step(root, scenario, problems);
  }
  if (!(scenario.cpg_step > 0)) return;
  const Period cpg{"CPG step", scenario.cpg_step, given(root, "cpg", "step")};
  check_periods({control}, cpg, place_of(root, "cpg", "step"), problems);
}

}  // namespace gaitlab
