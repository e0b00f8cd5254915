#include <fmt/format.h>

#include <cstdio>

#include "app/commands.h"
#include "core/scenario/read_scenario.h"
#include "report/summary.h"
#include "report/warnings.h"

namespace gaitlab::app {

Scenario as_typed(const std::map<std::string, std::string>& options, const std::function<Scenario()>& read) {
  try {
    return read();
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      if (const auto typed = options.find(problem.place.file); typed != options.end())
        problem.place = SourceLocation{typed->second};
    }
    throw InputError(std::move(problems));
  }
}

Scenario read(const ScenarioArguments& arguments, Catalog& catalog) {
  std::vector<std::string> sets = arguments.sets;
  if (arguments.seed) sets.push_back(fmt::format("seed={}", *arguments.seed));
  Scenario scenario = as_typed({{"--set seed=" + arguments.seed.value_or(""), "--seed"}},
                               [&] { return read_scenario(arguments.file, sets, catalog); });
  if (!arguments.quiet) {
    for (const std::string& note : scenario.notes) fmt::print(stderr, "{}: note: {}\n", arguments.file, note);
  }
  return scenario;
}

void warn_of_start(const Scenario& scenario, bool quiet) {
  if (const std::string warning = report::start_warning(scenario); !warning.empty()) {
    const SourceLocation place = scenario.on_ground ? SourceLocation{scenario.file} : scenario.place("robot.position");
    fmt::print(stderr, "{}: warning: {}\n", to_string(place), warning);
  }
  for (const report::Warning& doubt : report::setup_warnings(scenario)) {
    if (doubt.severe) fmt::print(stderr, "{}: warning: {}\n", to_string(doubt.place), doubt.text);
    if (!doubt.severe && !quiet) fmt::print(stderr, "{}: note: {}\n", to_string(doubt.place), doubt.text);
  }
}

void add_scenario(CLI::App& command, ScenarioArguments& arguments) {
  command.add_option("SCENARIO", arguments.file, "scenario file (YAML)")->required();
  command.add_option("--set", arguments.sets, "override a key, as key.path=value; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--seed", arguments.seed, "seed of the random number generator, instead of the scenario's");
  command.add_flag("--quiet", arguments.quiet, "print no notes, no progress and no summary");
}

std::string not_empty(const std::string& text) { return text.empty() ? "is empty" : ""; }

}  // namespace gaitlab::app
