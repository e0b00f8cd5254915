#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "app/shell/commands.h"
#include "core/scenario/read_scenario.h"
#include "kit/run_warnings.h"
#include "report/verdict/plausible/plausibility.h"

namespace gaitlab::app {

namespace {

/// Rethrows an error of the seed with the place --seed, because the user did not type the equivalent --set.
[[noreturn]] void raise_as_typed(const InputError& error, const std::string& seed) {
  std::vector<Problem> problems = error.problems();
  for (Problem& problem : problems) {
    if (problem.place.file == "--set " + seed) problem.place = SourceLocation{"--seed"};
  }
  throw InputError(std::move(problems));
}

}  // namespace

Scenario read(const ScenarioArguments& arguments, Catalog& catalog) {
  std::vector<std::string> sets = arguments.sets;
  const std::string seed = "seed=" + arguments.seed.value_or("");
  if (arguments.seed) sets.push_back(seed);
  Scenario scenario;
  try {
    scenario = read_scenario(arguments.file, sets, catalog);
  } catch (const InputError& error) {
    if (!arguments.seed) throw;
    raise_as_typed(error, seed);
  }
  report::check_accepted(scenario);
  if (!arguments.quiet) {
    for (const Note& note : scenario.notes) say(to_string(note.place), "note", note.text);
  }
  return scenario;
}

void warn_of_start(const Scenario& scenario, bool quiet) {
  for (const report::Warning& doubt : start_warnings(scenario)) {
    if (doubt.severe || !quiet) say(to_string(doubt.place), doubt.severe ? "warning" : "note", doubt.text);
  }
}

void add_scenario(CLI::App& command, ScenarioArguments& arguments, std::string (*named)(const std::string&)) {
  offering(command.add_option("SCENARIO", arguments.file), "scenario file (YAML), or a name of {}", {.kinds = {"scenarios"}})
      ->required()
      ->transform(named);
  offering(command.add_option("--set", arguments.sets), "override a key, as {}; may be repeated", {.settings = true})
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--seed", arguments.seed, "seed of the random number generator, instead of the scenario's");
  command.add_flag("--quiet", arguments.quiet, "print no notes, no progress and no summary");
}

void add_trust(CLI::App& command, PluginArguments& allowed) {
  command.add_flag("--plugins-from-scenario", allowed.from_scenario,
                   "load the plugins that the scenario names, and run their code; use it only for plugins that you trust");
  command.add_option("--plugin", allowed.files, "load this plugin if the scenario names it; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::string not_empty(const std::string& text) { return text.empty() ? "is empty" : ""; }

CLI::Validator within(double low, double high) {
  CLI::Validator range = CLI::Range(low, high);
  const CLI::Validator number(
      [](std::string& text) {
        double value = 0;
        return CLI::detail::lexical_cast(text, value) && std::isnan(value) ? text + " is not a number" : "";
      },
      "");
  return range & number;
}

}  // namespace gaitlab::app
