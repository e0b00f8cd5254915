#include <fmt/format.h>

#include "app/look/listed_kinds.h"
#include "app/shell/commands.h"
#include "app/shell/manual_arguments.h"
#include "app/study/study_quantities.h"
#include "core/robot_files/module_manual.h"
#include "core/scenario/manual.h"
#include "core/scenario/schema.h"
#include "report/figures/paper/recipe.h"
#include "report/verdict/check_manual.h"
#include "studies/study/study_file.h"

namespace gaitlab::app {

void add_plugins(CLI::App& command, ManualArguments& arguments) {
  command.add_option("--plugin", arguments.plugins, "library to load first; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

namespace {

int list(const ManualArguments& arguments) {
  Catalog catalog = standard_catalog(arguments.plugins);
  const ListedKind* only = listed_kind(arguments.kind);
  std::vector<std::string> known;
  for (const ListedKind& kind : listed_kinds()) known.push_back(kind.name);
  if (!arguments.kind.empty() && only == nullptr) refuse_unknown("list", "kind", arguments.kind, known);
  for (const ListedKind& kind : listed_kinds()) {
    if (only != nullptr && &kind != only) continue;
    fmt::print("{}\n", kind.name);
    print_fitted(name_rows(kind, catalog));
  }
  return 0;
}

struct SchemaArguments : ManualArguments {
  bool study = false, module = false;
};

int schema(const SchemaArguments& arguments) {
  if (arguments.study && !arguments.plugins.empty())
    throw InputError(SourceLocation{"--plugin"}, "cannot be combined with --study: plugins add no keys to the file of a study");
  if (arguments.study) {
    fmt::print("{}", studies::study_schema(quantity_offer().checks));
    return 0;
  }
  const Catalog catalog = standard_catalog(arguments.plugins);
  fmt::print("{}", arguments.module ? module_schema(catalog) : scenario_schema(catalog));
  return 0;
}

int reference(const ManualArguments& arguments) {
  const Catalog catalog = standard_catalog();
  fmt::print("{}", arguments.kind == "scenario"  ? scenario_page(catalog)
                   : arguments.kind == "figure"  ? report::recipe_page()
                   : arguments.kind == "module"  ? module_page()
                   : arguments.kind == "study"   ? studies::study_page()
                   : arguments.kind == "verdict" ? report::verdict_page()
                                                 : plugins_page(catalog));
  return 0;
}

}  // namespace

void add_manuals(Commands& commands) {
  add_command<ManualArguments>(
      commands, "list",
      "List the names of each kind: cpg, controller, actuator, sensor, engine, module, servo, robot, figure, "
      "check, scenario and study.",
      list, [](CLI::App& command, ManualArguments& arguments) {
        offering(command.add_option("KIND", arguments.kind), "list only this kind of {}", {.kinds = {""}, .files = false});
        add_plugins(command, arguments);
      });
  add_command<SchemaArguments>(
      commands, "schema", "Print the JSON Schema of the scenario file, for editors.", schema,
      [](CLI::App& command, SchemaArguments& arguments) {
        CLI::Option* study = command.add_flag("--study", arguments.study, "print the schema of the study file instead");
        command.add_flag("--module", arguments.module, "print the schema of the module file instead")->excludes(study);
        add_plugins(command, arguments);
      });
  add_command<ManualArguments>(
      commands, "reference", "Print a page of docs/reference.", reference, [](CLI::App& command, ManualArguments& arguments) {
        command.group("");  // hides the command in the help
        command.add_option("PAGE", arguments.kind, "scenario, plugins, module, figure, study or verdict")
            ->required()
            ->check(CLI::IsMember({"scenario", "plugins", "module", "figure", "study", "verdict"}));
      });
}

}  // namespace gaitlab::app
