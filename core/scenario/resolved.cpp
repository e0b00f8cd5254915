// The scenario written out in full, and its keys and plugins explained.
#include <fmt/format.h>

#include "core/scenario/explainer.h"
#include "core/scenario/overlay.h"
#include "core/scenario/plugin_instance.h"
#include "core/scenario/robot_section.h"
#include "core/scenario/scenario.h"
#include "core/scenario/sections.h"
#include "core/scenario/value.h"
#include "core/scenario/writer.h"

namespace gaitlab {
namespace {

Node plugins_node(const std::vector<PluginFile>& files) {
  Node node{Node::Kind::list};
  for (const PluginFile& file : files) {
    Node entry{Node::Kind::map};
    entry.keys = {{"path", {}}, {"hash", {}}};
    entry.items = {text_node(file.path), scalar_node(file.hash, true)};
    node.items.push_back(std::move(entry));
  }
  node.flow = node.items.empty();
  return node;
}

Node robot_node(Scenario& scenario, const std::vector<std::string>& joints) {
  Writer writer(joints);
  for (auto& [key, node] : robot_nodes(*scenario.robot, scenario.module_documents)) writer.add(key, std::move(node));
  BaseFields{scenario, !scenario.on_ground}.fields(writer);
  return writer.take();
}

Node empty_list() {
  Node node{Node::Kind::list};
  node.flow = true;
  return node;
}

}  // namespace

std::string resolved(const Scenario& scenario) {
  Scenario copy = scenario;  // the walk is written for reading and wants to write
  const std::vector<std::string> joints = joint_names(*scenario.robot);
  Writer writer(joints);
  writer.add("gaitlab", scalar_node("1"));
  writer.add("name", text_node(scenario.name));
  writer.add("plugins", plugins_node(scenario.plugins));
  writer.add("robot", robot_node(copy, joints));
  const Entry* actuator = scenario.actuator.entry;
  SectionFields sections(copy, nullptr, nullptr, actuator == nullptr ? "none" : std::string(actuator->name));
  sections.has_cpg = scenario.cpg.entry != nullptr;
  sections.fields(writer);
  writer.add("sensors", empty_list());
  return print_yaml(writer.take());
}

std::string explain_scenario(const Catalog& catalog) {
  Explainer explainer;
  explainer.row("gaitlab", "", "1", "1", "Format version.");
  explainer.row("name", "", "the file's name", "text", "Name of the run folder.");
  explainer.row("plugins", "", "[]", "list of paths", "Plugin libraries, relative to this file, or {path, hash}.");
  explainer.row("robot:", "", "", "", "The robot; required.");
  explainer.row("  modules", "", "", "name | file | map",
                "Module type, or {0: mtran, 5: ./foot.yaml, default: mtran}; required.");
  explainer.row("  types", "", "{}", "map", "Module types defined here, by name.");
  explainer.row("  build", "", "", "file", "Build file, rows child_face child_module parent_face parent_module orientation.");
  explainer.row("  docks", "", "[]", "list", "The same rows here; neither: one module.");
  Scenario scenario;
  Explainer base;
  BaseFields{scenario}.fields(base);
  for (const KeyRow& row : base.rows()) explainer.row("  " + row.key, row.unit, row.preset, row.range, row.about);
  SectionFields sections(scenario, &catalog, nullptr, default_type("actuator"));
  for (PluginFields* plugin : {&sections.actuator, &sections.controller, &sections.cpg}) plugin->own_keys = false;
  sections.fields(explainer);
  explainer.row("sensors", "", "[]", "[]", "There are no sensor types yet.");
  std::vector<KeyRow> rows = explainer.rows();
  for (KeyRow& row : rows) {
    if (row.key == "duration") row.preset.clear();
  }
  return table(rows);
}

std::string explain_plugin(const Entry& entry) {
  Explainer explainer;
  visit_settings(entry, default_settings(entry).get(), explainer);
  std::string text(entry.manual);
  if (!text.ends_with('\n')) text += '\n';
  return explainer.rows().empty() ? text : text + "\n" + table(explainer.rows());
}

}  // namespace gaitlab
