#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "app/commands.h"
#include "app/module_table.h"
#include "app/study/study_quantities.h"
#include "core/robot_files/module_manual.h"
#include "core/scenario/manual.h"
#include "core/scenario/read_scenario.h"
#include "core/scenario/schema.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"
#include "report/figures/paper/panel_kinds.h"
#include "report/verdict/check_manual.h"
#include "studies/study/study_file.h"

namespace gaitlab::app {

namespace {

struct ManualArguments {
  std::string kind, name;            ///< `kind` is empty for all kinds, `name` for all entries of the kind
  std::vector<std::string> plugins;  ///< plugin libraries to load first
};

void add_plugins(CLI::App& command, ManualArguments& arguments) {
  command.add_option("--plugin", arguments.plugins, "library to load first; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::vector<std::string> kinds() {
  std::vector<std::string> all;
  for (const PluginKind& plugin : kPluginKinds) all.emplace_back(plugin.section);
  all.insert(all.end(), {"engine", "module", "robot", "figure", "check"});
  return all;
}

[[noreturn]] void unknown(const std::string& what, const std::string& found, const std::vector<std::string>& known,
                          const std::string& hint = "") {
  const std::string near = nearest(found, known);
  throw InputError(SourceLocation{"gaitlab"},
                   fmt::format("unknown {} '{}'{}; known are {}{}", what, found,
                               near.empty() ? "" : "; did you mean '" + near + "'?", fmt::join(known, ", "), hint));
}

std::vector<std::string> names(const std::string& kind, const Catalog& catalog) {
  if (const PluginKind* plugin = find_kind(kind)) return catalog.names(plugin->kind);
  if (kind == "engine") return catalog.engines();
  if (kind == "figure") return to_strings(report::panel_names());
  std::vector<std::string> found;
  if (kind == "check") {
    for (const report::CheckKind& check : report::check_kinds()) found.emplace_back(check.id);
    return found;
  }
  for (const auto& [name, path] : shipped_files(kind)) found.push_back(name);
  return found;
}

/// The kind of check with this id, or nullptr if there is none.
const report::CheckKind* check_kind(const std::string& id) {
  const auto found = std::ranges::find_if(report::check_kinds(), [&](const report::CheckKind& kind) { return kind.id == id; });
  return found == report::check_kinds().end() ? nullptr : &*found;
}

std::string first_line(std::string_view text) { return std::string(text.substr(0, text.find('\n'))); }

std::string about(const std::string& kind, const std::string& name, Catalog& catalog) {
  if (const PluginKind* plugin = find_kind(kind)) {
    const Entry& entry = *catalog.find(plugin->kind, name);
    return first_line(entry.manual) + (entry.origin == kBuiltIn ? "" : fmt::format(" ({})", entry.origin));
  }
  if (kind == "engine") return first_line(catalog.engine(name)->manual);
  if (kind == "figure") return first_line(report::panel_kind(name).about);
  if (kind == "check") return check_kind(name)->title;
  const std::string file = shipped_files(kind).at(name);
  return kind == "module" ? module_row(read_module(file, catalog)) : file;
}

int list(const ManualArguments& arguments) {
  Catalog catalog = standard_catalog(arguments.plugins);
  const std::string& kind = arguments.kind;
  const std::vector<std::string> known = kinds();
  if (!kind.empty() && std::find(known.begin(), known.end(), kind) == known.end()) unknown("kind", kind, known);
  for (const std::string& one : known) {
    if (!kind.empty() && one != kind) continue;
    fmt::print("{}\n", one);
    for (const std::string& name : names(one, catalog)) fmt::print("  {:<20} {}\n", name, about(one, name, catalog));
  }
  return 0;
}

/// Prints the manual of a module type: a shipped type by its name, or a user's type by its file.
int explain_module(const std::string& name, Catalog& catalog) {
  const std::map<std::string, std::string> shipped = shipped_files("module");
  const auto known = shipped.find(name);
  if (known == shipped.end() && !name.ends_with(".yaml")) {
    unknown("module", name, names("module", catalog), "; name a type that you wrote by its file, NAME.yaml");
  }
  const std::string& file = known == shipped.end() ? name : known->second;
  fmt::print("{}\nfile: {}\n", module_table(read_module(file, catalog)), file);
  return 0;
}

int explain(const ManualArguments& arguments) {
  Catalog catalog = standard_catalog(arguments.plugins);
  const auto& [kind, name, plugins] = arguments;
  if (kind.empty()) {
    fmt::print("{}", explain_scenario(catalog));
    return 0;
  }
  if (kind == "study" && name.empty()) {
    fmt::print("{}", studies::explain_study());
    return 0;
  }
  if (kind == "verdict" && name.empty()) {
    fmt::print("{}", report::explain_verdict());
    return 0;
  }
  if (kind == "module" && name.empty()) {
    fmt::print("{}", explain_module_file());
    return 0;
  }
  if (const report::CheckKind* check = check_kind(kind); check != nullptr && name.empty()) {
    fmt::print("{}", report::explain_check(*check));
    return 0;
  }
  std::vector<std::string> known = kinds();
  if (std::find(known.begin(), known.end(), kind) == known.end()) {
    known.insert(known.end(), {"study", "verdict"});
    unknown("kind", kind, known);
  }
  if (name.empty()) {
    throw InputError(SourceLocation{"gaitlab explain"},
                     "NAME is missing: a name that `gaitlab list` prints, or the file NAME.yaml of a module; expected gaitlab "
                     "explain [KIND] [NAME]");
  }
  if (kind == "module") return explain_module(name, catalog);
  const std::vector<std::string> all = names(kind, catalog);
  if (std::find(all.begin(), all.end(), name) == all.end()) {
    unknown(kind, name, all,
            find_kind(kind) != nullptr && plugins.empty() ? "; a plugin that you wrote needs --plugin LIBRARY" : "");
  }
  if (const PluginKind* plugin = find_kind(kind)) fmt::print("{}", explain_plugin(*catalog.find(plugin->kind, name)));
  if (kind == "engine") {
    const Engine& engine = *catalog.engine(name);
    fmt::print("{}\n{}", wrapped(engine.manual),
               wrapped(fmt::format("integrators: {} (default {}); default step {}", fmt::join(engine.integrator_names(), ", "),
                                   engine.integrators.front().name, default_step(engine))));
  }
  if (kind == "figure") fmt::print("{}", report::explain_panel(report::panel_kind(name)));
  if (kind == "check") fmt::print("{}", report::explain_check(*check_kind(name)));
  if (kind == "robot") fmt::print("{}", read_text(shipped_files(kind).at(name)));
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
  add_command<ManualArguments>(commands, "list",
                               "List everything registered: cpg, controller, actuator, sensor, engine, module, robot, figure; "
                               "and checks of the verdict.",
                               list, [](CLI::App& command, ManualArguments& arguments) {
                                 command.add_option("KIND", arguments.kind, "list only this kind");
                                 add_plugins(command, arguments);
                               });
  add_command<ManualArguments>(
      commands, "explain", "Print the manual of KIND NAME; without them, the manual of the scenario file.", explain,
      [](CLI::App& command, ManualArguments& arguments) {
        command.add_option("KIND", arguments.kind,
                           "cpg, controller, actuator, sensor, engine, module, robot, figure, check; without NAME also module, "
                           "study, verdict, "
                           "or a check's id");
        command.add_option("NAME", arguments.name, "name that `gaitlab list` prints, or the file NAME.yaml of a module");
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
