#include <fmt/format.h>

#include <cstdio>

#include "app/commands.h"
#include "core/scenario/read_scenario.h"
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
  const std::string warning = report::start_warning(scenario);
  if (warning.empty()) return;
  const SourceLocation place = scenario.on_ground ? SourceLocation{scenario.file} : scenario.place("robot.position");
  fmt::print(stderr, "{}: warning: {}\n", to_string(place), warning);
}

void add_scenario(CLI::App& command, ScenarioArguments& arguments) {
  command.add_option("SCENARIO", arguments.file, "scenario file (YAML)")->required();
  command.add_option("--set", arguments.sets, "override a key, as key.path=value; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--seed", arguments.seed, "seed of the random number generator, instead of the scenario's");
  command.add_flag("--quiet", arguments.quiet, "print no notes, no progress and no summary");
}

std::string not_empty(const std::string& text) { return text.empty() ? "is empty" : ""; }

}  // namespace gaitlab::app
