#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "app/app.h"
#include "core/scenario/manual.h"
#include "core/scenario/schema.h"
#include "core/scenario/text_file.h"

namespace gaitlab::app {

namespace {

constexpr std::array kPluginKinds{Kind::cpg, Kind::controller, Kind::actuator};

std::vector<std::string> kinds() { return {"cpg", "controller", "actuator", "engine", "module", "robot"}; }

[[noreturn]] void unknown(const std::string& what, const std::string& found, const std::vector<std::string>& known,
                          const std::string& hint = "") {
  const std::string near = nearest(found, known);
  throw InputError(Place{"gaitlab"},
                   fmt::format("unknown {} '{}'{}; known are {}{}", what, found,
                               near.empty() ? "" : "; did you mean '" + near + "'?", fmt::join(known, ", "), hint));
}

std::vector<std::string> names(const std::string& kind, const Catalog& catalog) {
  for (const Kind which : kPluginKinds) {
    if (kind == word(which)) return catalog.names(which);
  }
  if (kind == "engine") return catalog.engines();
  std::vector<std::string> found;
  for (const auto& [name, path] : shipped_files(kind)) found.push_back(name);
  return found;
}

std::string first_line(std::string_view text) { return std::string(text.substr(0, text.find('\n'))); }

std::string about(const std::string& kind, const std::string& name, const Catalog& catalog) {
  for (const Kind which : kPluginKinds) {
    if (kind != word(which)) continue;
    const Entry& entry = *catalog.find(which, name);
    return first_line(entry.manual) + (entry.origin == kBuiltIn ? "" : fmt::format(" ({})", entry.origin));
  }
  if (kind == "engine") return first_line(catalog.engine(name)->manual);
  return shipped_files(kind).at(name);
}

}  // namespace

int list(const ManualArguments& arguments) {
  const Catalog catalog = standard_catalog(arguments.plugins);
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

int explain(const ManualArguments& arguments) {
  const Catalog catalog = standard_catalog(arguments.plugins);
  const auto& [kind, name, plugins] = arguments;
  if (kind.empty()) {
    fmt::print("{}", explain_scenario(catalog));
    return 0;
  }
  const std::vector<std::string> known = kinds();
  if (std::find(known.begin(), known.end(), kind) == known.end()) unknown("kind", kind, known);
  const std::vector<std::string> all = names(kind, catalog);
  if (std::find(all.begin(), all.end(), name) == all.end()) {
    const bool plugin =
        std::any_of(kPluginKinds.begin(), kPluginKinds.end(), [&kind = kind](Kind which) { return kind == word(which); });
    unknown(kind, name, all, plugin && plugins.empty() ? "; one of your own needs --plugin LIBRARY" : "");
  }
  for (const Kind which : kPluginKinds) {
    if (kind == word(which)) fmt::print("{}", explain_plugin(*catalog.find(which, name)));
  }
  if (kind == "engine") {
    const Engine& engine = *catalog.engine(name);
    fmt::print("{}\n\nintegrators: {} (default {}); default step {}\n", engine.manual,
               fmt::join(engine.integrator_names(), ", "), engine.integrators.front().name, default_step(engine));
  }
  if (kind == "module" || kind == "robot") fmt::print("{}", read_text(shipped_files(kind).at(name)));
  return 0;
}

int schema(const ManualArguments& arguments) {
  fmt::print("{}", scenario_schema(standard_catalog(arguments.plugins)));
  return 0;
}

int reference(const ManualArguments& arguments) {
  const Catalog catalog = standard_catalog();
  fmt::print("{}", arguments.kind == "scenario" ? scenario_page(catalog) : plugins_page(catalog));
  return 0;
}

}  // namespace gaitlab::app
