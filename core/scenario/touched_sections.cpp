#include "core/scenario/touched_sections.h"

#include <algorithm>
#include <array>
#include <utility>

namespace gaitlab {

std::vector<std::string> sections_of(const std::vector<std::string>& sets) {
  std::vector<std::string> sections;
  for (const std::string& set : sets) sections.push_back(set.substr(0, set.find_first_of(".=")));
  return sections;
}

TouchedSections::TouchedSections(std::vector<std::string> names) : names_(std::move(names)) {
  constexpr std::array<std::pair<const char*, const char*>, 7> kFollows{{{"contact", "physics"},
                                                                         {"contact", "ground"},
                                                                         {"supply", "actuator"},
                                                                         {"actuator", "controller"},
                                                                         {"initial", "cpg"},
                                                                         {"controller", "cpg"},
                                                                         {"controller", "sensors"}}};
  if (all()) return;
  for (const auto& [first, second] : kFollows) {
    if (has(first)) names_.emplace_back(second);
  }
}

bool TouchedSections::has(const std::string& section) const {
  return all() || std::ranges::find(names_, section) != names_.end();
}

void TouchedSections::restart(Scenario& scenario) const {
  const Scenario fresh;
  if (has("initial")) scenario.initial = fresh.initial;
  if (has("physics")) scenario.physics = fresh.physics;
  if (has("ground")) scenario.ground = fresh.ground;
  if (has("contact")) scenario.contact = fresh.contact;
  if (has("trace")) scenario.trace = fresh.trace;
  if (has("figure")) scenario.figure = fresh.figure;
  if (has("limits")) scenario.limits = fresh.limits;
  if (has("accept")) scenario.accept = fresh.accept;
  if (has("supply")) scenario.supply = fresh.supply;
  if (has(kMeasuredSection)) scenario.measured = fresh.measured;
  if (has("actuator")) {
    scenario.actuator = fresh.actuator;
    scenario.actuator_source = fresh.actuator_source;
    scenario.identified = fresh.identified;
  }
  if (has("controller")) {
    scenario.controller = fresh.controller;
    scenario.control_period = fresh.control_period;
  }
  if (has("cpg")) {
    scenario.cpg = fresh.cpg;
    scenario.cpg_step = fresh.cpg_step;
  }
}

}  // namespace gaitlab
