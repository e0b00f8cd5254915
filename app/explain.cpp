#include <fmt/format.h>

#include <algorithm>

#include "app/commands.h"
#include "app/listed_kinds.h"
#include "app/manual_arguments.h"
#include "core/files/file_kind.h"
#include "core/robot_files/module_manual.h"
#include "core/scenario/key_lookup.h"
#include "core/scenario/manual.h"
#include "core/settings/wording.h"
#include "report/verdict/check_manual.h"
#include "studies/study/study_file.h"

namespace gaitlab::app {

namespace {

/// A manual that has no name of its own: of a whole file, or of the verdict.
struct WholeManual {
  const char* name;
  std::string (*text)(const Catalog&);
};
constexpr WholeManual kWhole[] = {{"scenario", explain_scenario},
                                  {"module", [](const Catalog&) { return explain_module_file(); }},
                                  {"study", [](const Catalog&) { return studies::explain_study(); }},
                                  {"verdict", [](const Catalog&) { return report::explain_verdict(); }}};

/// The keys of a section of the scenario, or every key with a name, with their paths.
std::string explain_keys(const std::string& word, const Catalog& catalog) {
  const bool section = word.find('.') == std::string::npos;
  const auto within = [&](const ScenarioKey& key) {
    if (section && key.plugin != nullptr) return false;  // they have a manual of their own
    return key.path == word || key.path.starts_with(word + ".") || key.path.starts_with(word + "[");
  };
  const auto named = [&](const ScenarioKey& key) { return key.path.ends_with("." + word); };
  const std::vector<ScenarioKey> keys = all_keys(catalog);
  std::vector<ScenarioKey> found;
  std::ranges::copy_if(keys, std::back_inserter(found), within);
  if (found.empty()) std::ranges::copy_if(keys, std::back_inserter(found), named);
  std::vector<KeyRow> rows;
  for (const ScenarioKey& key : found) {
    rows.push_back(key.row);
    rows.back().key = key.path;
    if (key.plugin != nullptr) rows.back().key += fmt::format(" ({} {})", gaitlab::word(key.plugin->kind), key.plugin->name);
  }
  return rows.empty() ? "" : table(rows);
}

/// The names of a kind, and the keys of its section of the scenario, if it has one.
std::string explain_kind(const ListedKind& kind, Catalog& catalog) {
  std::string text = fmt::format("{}: one of the following; gaitlab explain {} NAME\n", kind.name, kind.name);
  text += name_rows(kind, catalog);
  const std::string keys = find_kind(kind.name) == nullptr ? "" : explain_keys(kind.name, catalog);
  return text + (keys.empty() ? "" : "\n" + keys);
}

/// The manuals of everything with this name, under headings if there are several.
std::string explain_name(const std::string& name, Catalog& catalog) {
  std::vector<std::string> manuals, heads;
  for (const ListedKind& kind : listed_kinds()) {
    const std::vector<std::string> names = kind.names(catalog);
    if (std::ranges::find(names, name) == names.end()) continue;
    heads.push_back(kind.name + " " + name);
    manuals.push_back(kind.manual(name, catalog));
  }
  if (manuals.size() == 1) return manuals.front();
  std::string text;
  for (std::size_t i = 0; i < manuals.size(); ++i)
    text += (i > 0 ? "\n" : "") + heads[i] + "\n" + std::string(heads[i].size(), '-') + "\n" + manuals[i];
  return text;
}

[[noreturn]] void refuse_word(const std::string& word, const Catalog& catalog) {
  std::vector<std::string> kinds, all;
  for (const WholeManual& whole : kWhole) kinds.emplace_back(whole.name);
  for (const ListedKind& kind : listed_kinds()) {
    if (std::ranges::find(kinds, kind.name) == kinds.end()) kinds.push_back(kind.name);
    for (const std::string& name : kind.names(catalog)) all.push_back(name);
  }
  all.insert(all.begin(), kinds.begin(), kinds.end());
  for (const ScenarioKey& key : all_keys(catalog)) all.push_back(key.path.substr(key.path.rfind('.') + 1));
  const std::string near = nearest(word, all);
  throw InputError(
      SourceLocation{"gaitlab explain"},
      fmt::format("nothing is named {}; {}", in_quotes(word),
                  near.empty() ? fmt::format("expected a kind ({}), a name that `gaitlab list` prints, or a key of "
                                             "the scenario",
                                             fmt::join(kinds, ", "))
                               : "did you mean " + in_quotes(near) + "?"));
}

/// Manual of a single word: a kind, a name of any kind, a section or key of the scenario, or a module's file.
std::string explain_word(const std::string& word, Catalog& catalog) {
  const auto* const whole = std::ranges::find(kWhole, word, &WholeManual::name);
  if (whole != std::end(kWhole)) return whole->text(catalog);
  if (const ListedKind* kind = listed_kind(word)) return explain_kind(*kind, catalog);
  if (std::string text = explain_name(word, catalog); !text.empty()) return text;
  if (std::string text = explain_keys(word, catalog); !text.empty()) return text;
  if (const std::optional<FileKind> kind = kind_of_file(word)) {
    if (*kind == FileKind::module) return module_manual(word, catalog);
    throw InputError(SourceLocation{word}, "has no manual" + but_it_is(word));
  }
  refuse_word(word, catalog);
}

std::string explain_named(const std::string& kind_name, const std::string& name, bool plugins, Catalog& catalog) {
  const ListedKind* kind = listed_kind(kind_name);
  if (kind == nullptr) {
    std::vector<std::string> known;
    for (const ListedKind& one : listed_kinds()) known.push_back(one.name);
    refuse_unknown("kind", kind_name, known);
  }
  const std::vector<std::string> names = kind->names(catalog);
  if (std::ranges::find(names, name) != names.end()) return kind->manual(name, catalog);
  const bool module = kind->name == "module";
  if (module && name.ends_with(".yaml")) return module_manual(name, catalog);
  const bool plugin = find_kind(kind->name) != nullptr && !plugins;
  refuse_unknown(kind->name, name, names,
                 module   ? "; name a type that you wrote by its file, NAME.yaml"
                 : plugin ? "; a plugin that you wrote needs --plugin LIBRARY"
                          : "");
}

int explain(const ManualArguments& arguments) {
  Catalog catalog = standard_catalog(arguments.plugins);
  const auto& [kind, name, plugins] = arguments;
  fmt::print("{}", kind.empty()   ? explain_scenario(catalog)
                   : name.empty() ? explain_word(kind, catalog)
                                  : explain_named(kind, name, !plugins.empty(), catalog));
  return 0;
}

}  // namespace

void add_explain(Commands& commands) {
  add_command<ManualArguments>(
      commands, "explain", "Print the manual of KIND NAME, or of a single word; without them, that of the scenario file.",
      explain, [](CLI::App& command, ManualArguments& arguments) {
        command.add_option("KIND", arguments.kind,
                           "a kind of `gaitlab list`; or alone: any name that it prints, a section or key of the scenario, "
                           "scenario, study, verdict, or a module's file");
        command.add_option("NAME", arguments.name, "name that `gaitlab list` prints, or the file NAME.yaml of a module");
        add_plugins(command, arguments);
      });
}

}  // namespace gaitlab::app
