#include "core/scenario/buses.h"

#include <fmt/format.h>

#include <algorithm>

namespace gaitlab {

const Supply& supply_of(const Scenario& scenario, std::size_t joint) {
  const std::size_t module = scenario.robot->joints[joint].module;
  const bool own = module < scenario.batteries.size() && scenario.batteries[module].any();
  return own ? scenario.batteries[module] : scenario.supply;
}

std::vector<MotorBus> buses(const Scenario& scenario) {
  std::vector<MotorBus> all;
  if (scenario.supply.any() && scenario.batteries.empty()) all.push_back({"", scenario.supply, {}});
  const bool any = scenario.supply.any() || !scenario.batteries.empty();
  if (!any || scenario.robot == nullptr) return all;
  std::vector<const Supply*> known;
  if (!all.empty()) known.push_back(&scenario.supply);
  // First the supply of the scenario, so that its bus has number 0.
  const auto take = [&](bool of_modules) {
    for (std::size_t j = 0; j < scenario.robot->joints.size(); ++j) {
      const Joint& joint = scenario.robot->joints[j];
      const Supply& supply = supply_of(scenario, j);
      const bool of_module = &supply != &scenario.supply;
      if (!joint.driven() || !supply.any() || of_module != of_modules) continue;
      const auto at = static_cast<std::size_t>(std::ranges::find(known, &supply) - known.begin());
      if (at == known.size()) {
        known.push_back(&supply);
        all.push_back({of_module ? fmt::format("m{}", joint.module) : "", supply, {}});
      }
      all[at].joints.push_back(j);
    }
  };
  take(false);
  take(true);
  return all;
}

}  // namespace gaitlab
