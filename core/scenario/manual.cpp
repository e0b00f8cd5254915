#include "core/scenario/manual.h"

#include <fmt/format.h>

#include <array>

#include "core/plugin/plugin_instance.h"
#include "core/scenario/change_section.h"
#include "core/scenario/group_section.h"
#include "core/scenario/robot_section.h"
#include "core/scenario/sections.h"
#include "core/settings/explainer.h"
#include "core/settings/overlay.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

constexpr const char* kRenewed =
    "<!-- Written by `tests/gates/reference.sh build/release --renew`; CI fails where it is stale. -->\n\n";

void add_changes(Explainer& all) {
  all.row("at", "", "[]", "list", kAboutChanges);
  Change change;
  JointFault fault;
  Explainer keys;
  ChangeKeys{change}.fields(keys);
  keys.row("set", "", "", "map", kAboutSet);
  keys.row("fault", "", "", "map | list", kAboutFault);
  for (const KeyRow& row : keys.rows()) all.row("at[]." + row.key, row.unit, "", row.range, row.about, row.words);
  Explainer of_fault;
  FaultKeys{fault, true}.fields(of_fault);
  for (const KeyRow& row : of_fault.rows()) all.row("at[].fault." + row.key, row.unit, "", row.range, row.about, row.words);
}

}  // namespace

std::vector<KeyRow> scenario_keys(const Catalog& catalog) {
  Explainer explainer;
  explainer.row("gaitlab", "", "1", "1", "Format version.");
  explainer.row("name", "", "the file's name", "text", "Name of the run folder.");
  explainer.row("plugins", "", "[]", "list of paths",
                "Plugin libraries, relative to this file, or {path, hash}; commands that do not run the scenario load them "
                "with --plugins-from-scenario.");
  explainer.row("robot:", "", "", "", "The robot; required.");
  explainer.row("  modules", "", kDefaultType, "name | file | map",
                "Module type, or {0: mtran, 5: ./foot.yaml, default: mtran}.");
  explainer.row("  types", "", "{}", "map", "Module types defined here, by name.");
  explainer.row("  build", "", "", "file", "Build file, rows child_face child_module parent_face parent_module orientation.");
  explainer.row("  docks", "", "[]", "list", "Docks as rows of a build file, given here; without build and docks: one module.");
  Scenario scenario;
  Explainer base;
  BaseFields{scenario}.fields(base);
  for (const KeyRow& row : base.rows()) explainer.row("  " + row.key, row.unit, row.preset, row.range, row.about, row.words);
  explainer.row(kGroupsSection, "", "{}", "NAME: list", kAboutGroups);
  SectionFields sections(scenario, &catalog, nullptr, describe(Kind::actuator).default_type);
  for (PluginFields* plugin : {&sections.actuator, &sections.controller, &sections.cpg}) plugin->own_keys = false;
  sections.fields(explainer);
  explainer.row(
      "sensors", "", "{}", "NAME: map",
      "Sensors by name, each with a type: {NAME: {type: TYPE, ...}}; a map with a key type is a single one. Their keys: "
      "gaitlab explain sensor TYPE.");
  add_changes(explainer);
  std::vector<KeyRow> rows = explainer.rows();
  for (KeyRow& row : rows) {
    if (row.key == "duration") row.preset.clear();
  }
  return rows;
}

std::vector<KeyRow> plugin_keys(const Entry& entry) {
  Explainer explainer;
  visit_settings(entry, default_settings(entry).get(), explainer);
  return explainer.rows();
}

namespace {

/// Unit of the row whose path is the beginning of `key`. The rest of `key` is an element of a list or a part of the robot.
std::string unit_in(const std::vector<KeyRow>& rows, const std::string& key) {
  std::vector<std::string> path;
  for (const KeyRow& row : rows) {
    const std::size_t indent = std::min(row.key.find_first_not_of(' '), row.key.size());
    path.resize(indent / 2);
    path.push_back(row.key.substr(indent, row.key.find(':') - indent));
    const std::string whole = fmt::format("{}", fmt::join(path, "."));
    if (!row.unit.empty() && (key == whole || key.starts_with(whole + "."))) return row.unit;
  }
  return "";
}

/// Code block in Markdown, so that equations keep their lines.
std::string fenced(const std::string& text) { return "```text\n" + text + (text.ends_with('\n') ? "" : "\n") + "```\n"; }

}  // namespace

std::string explain_scenario(const Catalog& catalog) { return table(scenario_keys(catalog)); }

std::string explain_plugin(const Entry& entry, std::size_t width) {
  const std::string text = wrapped(std::string(entry.manual), 0, width);
  const std::vector<KeyRow> keys = plugin_keys(entry);
  return keys.empty() ? text : text + "\n" + table(keys);
}

std::string unit_of_key(const Catalog& catalog, const Node& scenario, const std::string& key) {
  const std::size_t dot = std::min(key.find('.'), key.size());
  const PluginKind* kind = find_kind(key.substr(0, dot));
  const Node* section = scenario.find(key.substr(0, dot));
  const Node* type = kind == nullptr || section == nullptr ? nullptr : section->find("type");
  const Entry* entry = type == nullptr ? nullptr : catalog.find(kind->kind, type->text);
  if (entry != nullptr && dot < key.size()) {
    if (std::string unit = unit_in(plugin_keys(*entry), key.substr(dot + 1)); !unit.empty()) return unit;
  }
  return unit_in(scenario_keys(catalog), key);
}

std::string scenario_page(const Catalog& catalog) {
  return "# The scenario file\n\n" + std::string(kRenewed) +
         "Every key, as `gaitlab explain` prints it. The keys of a CPG, controller, actuator or sensor are on their own page,\n"
         "[plugins.md](plugins.md). A value per joint is a number, a list, or `{default: x, m3/passive: y}`; a name\n"
         "may be a pattern with `*`, `?` and ranges such as `[3-6]`, in quotes (`\"m[3-6]/active\": y`), or a group "
         "(`groups`). A\n"
         "name beats patterns and groups, and these beat `default`. For editors: the JSON Schema "
         "`scenarios/gaitlab.schema.json`, by `gaitlab schema`.\n\n" +
         markdown_table(scenario_keys(catalog));
}

std::string default_step(const Engine& engine) {
  std::string given = number_text(engine.step) + " s";
  if (engine.adaptive() == nullptr) return given;
  if (engine.choose_step != nullptr) {
    given += fmt::format(" (an explicit one: auto, the longest up to {} s that is stable at the start)",
                         number_text(engine.longest_step));
  }
  return fmt::format("auto (integrator {}); {} with another integrator; {} is the default integrator if a step is given",
                     engine.adaptive()->name, given, engine.fixed().name);
}

std::string plugins_page(const Catalog& catalog) {
  std::string page = "# CPGs, controllers, actuators, sensors and engines\n\n" + std::string(kRenewed) +
                     "The manuals of the built-in plugins, as `gaitlab explain KIND NAME` prints them. To write "
                     "another:\n[write a CPG](../tutorials/write-a-cpg.md).\n";
  for (const PluginKind& kind : kPluginKinds) {
    for (const std::string& name : catalog.names(kind.kind)) {
      const Entry& entry = *catalog.find(kind.kind, name);
      page += fmt::format("\n## {} `{}`\n\n{}", kind.section, name, fenced(std::string(entry.manual)));
      const std::vector<KeyRow> keys = plugin_keys(entry);
      if (!keys.empty()) page += "\n" + markdown_table(keys);
    }
  }
  for (const std::string& name : catalog.engines()) {
    const Engine& engine = *catalog.engine(name);
    page +=
        fmt::format("\n## engine `{}`\n\n{}\nIntegrators: {} (default {}). Default step: {}.\n", name, fenced(engine.manual),
                    fmt::join(engine.integrator_names(), ", "), engine.integrators.front().name, default_step(engine));
  }
  return page;
}

}  // namespace gaitlab
