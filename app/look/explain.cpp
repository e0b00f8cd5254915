#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/look/listed_kinds.h"
#include "app/shell/commands.h"
#include "app/shell/manual_arguments.h"
#include "core/files/file_kind.h"
#include "core/robot_files/module_manual.h"
#include "core/scenario/key_lookup.h"
#include "core/scenario/manual.h"
#include "core/settings/wording.h"
#include "report/verdict/check_manual.h"
#include "studies/study/study_file.h"

namespace gaitlab::app {

namespace {

/// A manual without a name of its own: that of a whole file, or that of the verdict.
struct WholeManual {
  const char* name;
  std::string (*text)(const Catalog&);
};
constexpr WholeManual kWhole[] = {{"scenario", explain_scenario},
                                  {"module", [](const Catalog&) { return explain_module_file(); }},
                                  {"study", [](const Catalog&) { return studies::explain_study(); }},
                                  {"verdict", [](const Catalog&) { return report::explain_verdict(); }}};

/// A path of keys without the marks of lists and names: `hinges.axis` for `hinges[].axis`.
std::string plain_path(std::string path) {
  for (const std::string mark : {"[]", ".NAME"}) {
    for (std::size_t at = path.find(mark); at != std::string::npos; at = path.find(mark, at)) path.erase(at, mark.size());
  }
  return path;
}

/// Adds the rows of the keys for which `fits` is true, with their paths, and with the plugin or file that defines them.
template <class Fits>
void add_rows(const std::vector<ScenarioKey>& keys, const char* file, Fits fits, std::vector<KeyRow>& rows) {
  for (const ScenarioKey& key : keys) {
    if (!fits(key)) continue;
    rows.push_back(key.row);
    rows.back().key = key.path + file;
    if (key.plugin != nullptr) rows.back().key += fmt::format(" ({} {})", word(key.plugin->kind), key.plugin->name);
  }
}

/// Adds the rows of a section, or else of every key with this name.
void add_named(const std::string& word, const std::vector<ScenarioKey>& keys, const char* file, std::vector<KeyRow>& rows) {
  const bool section = word.find('.') == std::string::npos;
  const std::size_t before = rows.size();
  const auto within = [&](const ScenarioKey& key) {
    const std::string path = plain_path(key.path);
    // Plugins have manuals of their own.
    return !(section && key.plugin != nullptr) && (path == word || path.starts_with(word + "."));
  };
  add_rows(keys, file, within, rows);
  if (rows.size() > before) return;
  add_rows(
      keys, file, [&](const ScenarioKey& key) { return plain_path(key.path).ends_with("." + word); }, rows);
}

constexpr const char* kInModule = " (module file)";

/// The keys of a section of the scenario, or every key with a name, with their paths.
std::string explain_keys(const std::string& word, const Catalog& catalog) {
  std::vector<KeyRow> rows;
  add_named(word, all_keys(catalog), "", rows);
  return rows.empty() ? "" : table(rows);
}

/// The keys of scenario and module files with this name, the keys that permit this word as a value, and the engines with an
/// integrator of this name.
std::string explain_everywhere(const std::string& word, const Catalog& catalog) {
  const std::vector<ScenarioKey> scenario = all_keys(catalog);
  const std::vector<ScenarioKey> module = module_keys();
  std::vector<KeyRow> rows;
  add_named(word, scenario, "", rows);
  add_named(word, module, kInModule, rows);
  const auto permitted = [&](const ScenarioKey& key) { return std::ranges::find(key.row.words, word) != key.row.words.end(); };
  add_rows(scenario, "", permitted, rows);
  add_rows(module, kInModule, permitted, rows);
  std::string text = rows.empty() ? "" : table(rows);
  for (const std::string& name : catalog.engines()) {
    const std::vector<std::string> integrators = catalog.engine(name)->integrator_names();
    if (std::ranges::find(integrators, word) != integrators.end())
      text += fmt::format("{}: integrator of engine {} (gaitlab explain engine {})\n", word, name, name);
  }
  return text;
}

/// Meaning of the name of a joint or body, such as m0/hinge; "" for other words.
std::string explain_part(const std::string& word) {
  const std::size_t slash = word.find('/');
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  if (slash == std::string::npos || slash < 2 || word[0] != 'm' ||
      !std::all_of(word.begin() + 1, word.begin() + static_cast<std::ptrdiff_t>(slash), digit))
    return "";
  return wrapped(
      fmt::format("{0}: a joint or body of the robot, {1} of module {2}. Settings per joint accept this name as a key: "
                  "cpg.amplitude: {{default: 0.4, {0}: 0.3}}. `gaitlab check SCENARIO` lists the joints.",
                  word, word.substr(slash + 1), word.substr(1, slash - 1)));
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
  for (const std::vector<ScenarioKey>& keys : {all_keys(catalog), module_keys()}) {
    for (const ScenarioKey& key : keys) all.push_back(plain_path(key.path).substr(plain_path(key.path).rfind('.') + 1));
  }
  const std::string near = nearest(word, all);
  throw InputError(
      SourceLocation{"gaitlab explain"},
      fmt::format("nothing is named {}; {}", in_quotes(word),
                  near.empty() ? fmt::format("expected a kind ({}), a name that `gaitlab list` prints, or a key of "
                                             "a scenario or module file",
                                             fmt::join(kinds, ", "))
                               : "did you mean " + in_quotes(near) + "?"));
}

/// Manual of a single word: a kind, a name of any kind, a section or key of a scenario or module file, a word that a key
/// permits, or a module's file.
std::string explain_word(const std::string& word, Catalog& catalog) {
  const auto* const whole = std::ranges::find(kWhole, word, &WholeManual::name);
  if (whole != std::end(kWhole)) return whole->text(catalog);
  if (const ListedKind* kind = listed_kind(word)) {  // `servo` is also the name of an actuator
    const std::string manual = explain_name(word, catalog);
    return (manual.empty() ? "" : manual + "\n") + explain_kind(*kind, catalog);
  }
  if (std::string text = explain_name(word, catalog); !text.empty()) {  // a check may have the name of a section: `supply`
    const std::vector<ScenarioKey> keys = all_keys(catalog);
    const bool section =
        std::ranges::any_of(keys, [&](const ScenarioKey& key) { return plain_path(key.path).starts_with(word + "."); });
    return section ? text + "\n" + explain_keys(word, catalog) : text;
  }
  if (std::string text = explain_everywhere(word, catalog); !text.empty()) return text;
  if (const std::optional<FileKind> kind = kind_of_file(word)) {
    if (*kind == FileKind::module) return module_manual(word, catalog);
    if (*kind == FileKind::servo) return servo_manual(word, catalog);
    if (*kind == FileKind::cpg) return cpg_manual(word);
    throw InputError(SourceLocation{word}, "has no manual" + but_it_is(word));
  }
  if (std::string text = explain_part(word); !text.empty()) return text;
  refuse_word(word, catalog);
}

std::string explain_named(const std::string& kind_name, const std::string& name, bool plugins, Catalog& catalog) {
  const ListedKind* kind = listed_kind(kind_name);
  if (kind == nullptr) {
    std::vector<std::string> known;
    for (const ListedKind& one : listed_kinds()) known.push_back(one.name);
    refuse_unknown("explain", "kind", kind_name, known);
  }
  const std::vector<std::string> names = kind->names(catalog);
  const bool known = std::ranges::find(names, name) != names.end();
  const bool own_files = kind->name == "module" || kind->name == "servo";
  std::error_code none;
  const bool file = std::filesystem::exists(name, none) && !std::filesystem::is_directory(name, none);
  if (own_files && (name.ends_with(".yaml") || file)) {
    if (known) {
      say(name, "note",
          fmt::format("'{0}' is the file './{0}', not the {1} that comes with gaitlab", name,
                      kind->name == "module" ? "module type" : "servo"));
    }
    return kind->name == "module" ? module_manual(name, catalog) : servo_manual(name, catalog);
  }
  if (known) return kind->manual(name, catalog);
  if (kind->name == "cpg" && file && kind_of_file(name) == FileKind::cpg) return cpg_manual(name);
  const bool plugin = find_kind(kind->name) != nullptr && !plugins;
  refuse_unknown("explain", kind->name, name, names,
                 own_files ? fmt::format("; name a {} that you wrote by its file", kind->name == "module" ? "type" : "servo")
                 : plugin  ? "; a plugin that you wrote needs --plugin LIBRARY"
                           : "");
}

int explain(const ManualArguments& arguments) {
  Catalog catalog = standard_catalog(arguments.plugins);
  const auto& [kind, name, plugins] = arguments;
  const std::string text = kind.empty()   ? explain_scenario(catalog)
                           : name.empty() ? explain_word(kind, catalog)
                                          : explain_named(kind, name, !plugins.empty(), catalog);
  if (text.starts_with("#")) {  // a file, shown as it is
    fmt::print("{}", text);
  } else {
    print_fitted(text);
  }
  return 0;
}

}  // namespace

void add_explain(Commands& commands) {
  add_command<ManualArguments>(
      commands, "explain",
      "Print the manual of KIND NAME, or of a single word; without arguments, the manual of the scenario "
      "file.",
      explain, [](CLI::App& command, ManualArguments& arguments) {
        offering(command.add_option("KIND", arguments.kind),
                 "a kind of {}; or, without NAME, any name that this command prints, a section or key of a scenario or module "
                 "file, a value of a key, `scenario`, `study`, `verdict`, or the file of a module",
                 {.kinds = {""}});
        offering(command.add_option("NAME", arguments.name), "name that {} prints, or a module's file NAME.yaml",
                 {.kinds = {""}});
        add_plugins(command, arguments);
      });
}

}  // namespace gaitlab::app
