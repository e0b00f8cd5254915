#include <fmt/format.h>

#include <cstdio>

#include "app/app.h"

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

}  // namespace gaitlab::app
