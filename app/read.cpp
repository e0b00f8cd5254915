#include <fmt/format.h>

#include <cstdio>

#include "app/app.h"
#include "report/summary.h"

namespace gaitlab::app {

Scenario read(const ScenarioArguments& arguments, Catalog& catalog) {
  std::vector<std::string> sets = arguments.sets;
  if (arguments.seed) sets.push_back(fmt::format("seed={}", *arguments.seed));
  Scenario scenario = read_scenario(arguments.file, sets, catalog);
  if (!arguments.quiet) {
    for (const std::string& note : scenario.notes) fmt::print(stderr, "{}: note: {}\n", arguments.file, note);
  }
  return scenario;
}

void warn_of_start(const Scenario& scenario) {
  const std::string warning = start_warning(scenario);
  if (warning.empty()) return;
  const Place place = scenario.on_ground ? Place{scenario.file} : scenario.place("robot.position");
  fmt::print(stderr, "{}: warning: {}\n", to_string(place), warning);
}

}  // namespace gaitlab::app
