#include "core/scenario/resolved.h"

#include "core/scenario/change_section.h"
#include "core/scenario/group_section.h"
#include "core/scenario/robot_section.h"
#include "core/scenario/sections.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/writer.h"

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
  for (auto& [key, node] : robot_nodes(*scenario.robot, *scenario.module_documents)) writer.add(key, std::move(node));
  const bool placed = !scenario.on_ground || scenario.position != Vec3::Zero();
  BaseFields{scenario, placed}.fields(writer);
  return writer.take();
}

}  // namespace

std::string resolved(const Scenario& scenario) {
  Scenario copy = scenario;  // the visitor also reads scenarios, and therefore needs write access
  const std::vector<std::string> joints = joint_names(*scenario.robot);
  Writer writer(joints);
  writer.add("gaitlab", scalar_node("1"));
  writer.add("name", text_node(scenario.name));
  writer.add("plugins", plugins_node(scenario.plugins));
  writer.add("robot", robot_node(copy, joints));
  if (!scenario.groups.empty()) writer.add(kGroupsSection, groups_node(scenario.groups));  // older goldens do not contain it
  const Entry* actuator = scenario.actuator.entry;
  SectionFields sections(copy, nullptr, nullptr, actuator == nullptr ? "none" : std::string(actuator->name));
  sections.writing = true;
  sections.has_cpg = scenario.cpg.entry != nullptr;
  sections.fields(writer);
  writer.add("sensors", sensors_node(scenario, joints));
  if (!scenario.changes.empty()) writer.add("at", changes_node(scenario, joints));  // older goldens do not contain it
  return print_yaml(writer.take());
}

}  // namespace gaitlab
