#include "app/look/listed_kinds.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "app/app.h"
#include "app/look/module_table.h"
#include "app/look/servo_table.h"
#include "app/shell/progress.h"
#include "core/scenario/cpg_file.h"
#include "core/scenario/manual.h"
#include "core/scenario/read_scenario.h"
#include "core/settings/shipped_files.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"
#include "report/figures/paper/panel_kinds.h"
#include "report/figures/paper/recipe.h"
#include "report/verdict/check_manual.h"

namespace gaitlab::app {

namespace {

std::string first_line(std::string_view text) { return std::string(text.substr(0, text.find('\n'))); }

/// Path of a shipped file by kind and name.
std::string shipped_file(const std::string& kind, const std::string& name) { return shipped_files(kind).at(name); }

ListedKind of_plugins(const PluginKind& plugin) {
  const Kind kind = plugin.kind;
  return {plugin.section, std::string(plugin.section) + "s", [kind](const Catalog& catalog) { return catalog.names(kind); },
          [kind](const std::string& name, Catalog& catalog) {
            const Entry& entry = *catalog.find(kind, name);
            return first_line(entry.manual) + (entry.origin == kBuiltIn ? "" : fmt::format(" ({})", entry.origin));
          },
          [kind](const std::string& name, Catalog& catalog) {
            return explain_plugin(*catalog.find(kind, name), terminal_columns(STDOUT_FILENO));
          }};
}

CpgFile cpg_file(const std::string& path) {
  Problems problems;
  std::optional<CpgFile> file = read_cpg_file(path, {}, problems);
  problems.raise();
  return std::move(*file);
}

/// The CPGs, those in files after the others.
ListedKind of_cpgs(const PluginKind& plugin) {
  ListedKind kind = of_plugins(plugin);
  const auto is_plugin = [](const std::string& name, const Catalog& catalog) {
    return catalog.find(Kind::cpg, name) != nullptr;
  };
  kind.names = [plugins = kind.names, is_plugin](const Catalog& catalog) {
    std::vector<std::string> names = plugins(catalog);
    for (const auto& [name, path] : shipped_files("cpg")) {
      if (!is_plugin(name, catalog)) names.push_back(name);
    }
    return names;
  };
  kind.about = [about = kind.about, is_plugin](const std::string& name, Catalog& catalog) {
    return is_plugin(name, catalog) ? about(name, catalog)
                                    : first_line(cpg_file(shipped_file("cpg", name)).manual) + " (equations)";
  };
  kind.manual = [manual = kind.manual, is_plugin](const std::string& name, Catalog& catalog) {
    return is_plugin(name, catalog) ? manual(name, catalog) : cpg_manual(shipped_file("cpg", name));
  };
  return kind;
}

std::string engine_manual(const std::string& name, Catalog& catalog) {
  const Engine& engine = *catalog.engine(name);
  return wrapped(engine.manual) + "\n" +
         wrapped(fmt::format("integrators: {} (default {}); default step {}", fmt::join(engine.integrator_names(), ", "),
                             engine.integrators.front().name, default_step(engine)));
}

/// The CheckKind with this id.
const report::CheckKind& check_kind(const std::string& id) {
  return *std::ranges::find_if(report::check_kinds(), [&](const report::CheckKind& kind) { return kind.id == id; });
}

std::vector<std::string> check_ids(const Catalog&) {
  std::vector<std::string> ids;
  for (const report::CheckKind& check : report::check_kinds()) ids.emplace_back(check.id);
  return ids;
}

/// Comment at the head of a file, after the line for editors.
std::string head_comment(const std::string& text) {
  std::istringstream lines(text);
  std::string comment;
  for (std::string line; std::getline(lines, line) && line.starts_with("#");) {
    if (line.find("yaml-language-server") == std::string::npos) comment += line.substr(1);
  }
  comment.erase(0, comment.find_first_not_of(' '));
  return comment;
}

/// First sentence of the comment at the head of a file.
std::string head_sentence(const std::string& text) {
  std::string comment = head_comment(text);
  comment = comment.substr(0, std::min(comment.find(". "), comment.find(": gaitlab")));
  return comment.ends_with(".") ? comment.substr(0, comment.size() - 1) : comment;
}

/// Kind of the files in a folder that comes with the program. Each file is shown as it is.
ListedKind of_files(const std::string& kind, const std::string& plural, bool about_is_path) {
  return {kind, plural,
          [kind](const Catalog&) {
            std::vector<std::string> names;
            for (const auto& [name, path] : shipped_files(kind)) names.push_back(name);
            return names;
          },
          [kind, about_is_path](const std::string& name, Catalog&) {
            const std::string file = shipped_file(kind, name);
            return about_is_path ? file : head_sentence(read_text(file));
          },
          [kind](const std::string& name, Catalog&) {
            const std::string file = shipped_file(kind, name);
            return read_text(file) + (kind == "robot" ? "" : "file: " + file + "\n");
          }};
}

std::vector<ListedKind> all_kinds() {
  std::vector<ListedKind> all;
  for (const PluginKind& plugin : kPluginKinds) all.push_back(plugin.kind == Kind::cpg ? of_cpgs(plugin) : of_plugins(plugin));
  all.push_back({"engine", "engines", [](const Catalog& catalog) { return catalog.engines(); },
                 [](const std::string& name, Catalog& catalog) { return first_line(catalog.engine(name)->manual); },
                 engine_manual});
  ListedKind modules = of_files("module", "modules", true);
  modules.about = [](const std::string& name, Catalog& catalog) {
    return module_row(read_module(shipped_file("module", name), catalog));
  };
  modules.manual = [](const std::string& name, Catalog& catalog) {
    return module_manual(shipped_file("module", name), catalog);
  };
  all.push_back(std::move(modules));
  ListedKind servos = of_files("servo", "servos", false);
  servos.about = [](const std::string& name, Catalog&) {
    const std::string file = shipped_file("servo", name);
    return servo_row(file, head_sentence(read_text(file)));
  };
  servos.manual = [](const std::string& name, Catalog& catalog) { return servo_manual(shipped_file("servo", name), catalog); };
  all.push_back(std::move(servos));
  all.push_back(of_files("robot", "robots", true));
  all.push_back({"figure", "figures", [](const Catalog&) { return to_strings(report::panel_names()); },
                 [](const std::string& name, Catalog&) { return first_line(report::panel_kind(name).about); },
                 [](const std::string& name, Catalog&) { return report::explain_panel(report::panel_kind(name)); }});
  all.push_back({"check", "checks", check_ids,
                 [](const std::string& id, Catalog&) { return std::string(check_kind(id).title); },
                 [](const std::string& id, Catalog&) { return report::explain_check(check_kind(id)); }});
  all.push_back(of_files("scenario", "scenarios", false));
  all.push_back(of_files("study", "studies", false));
  return all;
}

}  // namespace

std::string servo_manual(const std::string& file, const Catalog& catalog) {
  return fmt::format("{}file: {}\n", servo_table(file, head_comment(read_text(file)), catalog), file);
}

std::string cpg_manual(const std::string& file) { return manual_of(cpg_file(file)) + "file: " + file + "\n"; }

const std::vector<ListedKind>& listed_kinds() {
  static const std::vector<ListedKind> kAll = all_kinds();
  return kAll;
}

const ListedKind* listed_kind(const std::string& name) {
  const auto found =
      std::ranges::find_if(listed_kinds(), [&](const ListedKind& kind) { return kind.name == name || kind.plural == name; });
  return found == listed_kinds().end() ? nullptr : &*found;
}

std::string name_rows(const ListedKind& kind, Catalog& catalog) {
  const std::vector<std::string> names = kind.names(catalog);
  std::size_t width = 20;
  for (const std::string& name : names) width = std::max(width, name.size());
  std::string text;
  for (const std::string& name : names) text += fmt::format("  {:<{}} {}\n", name, width, kind.about(name, catalog));
  return text;
}

void refuse_unknown(const std::string& command, const std::string& what, const std::string& found,
                    const std::vector<std::string>& known, const std::string& hint) {
  const std::string near = nearest(found, known);
  throw InputError(SourceLocation{"gaitlab " + command},
                   fmt::format("unknown {} {}{}; expected one of {}{}", what, in_quotes(found),
                               near.empty() ? "" : "; did you mean '" + near + "'?", fmt::join(known, ", "), hint));
}

std::string module_manual(const std::string& file, Catalog& catalog) {
  return fmt::format("{}\nfile: {}\n", module_table(read_module(file, catalog)), file);
}

}  // namespace gaitlab::app
