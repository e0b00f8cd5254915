#include "core/scenario/resolved.h"

#include <filesystem>
#include <variant>

#include "core/robot_files/body_pair_list.h"
#include "core/robot_files/leg_list.h"
#include "core/scenario/change_section.h"
#include "core/scenario/group_section.h"
#include "core/scenario/height_file.h"
#include "core/scenario/robot_section.h"
#include "core/scenario/sections.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/writer.h"

namespace gaitlab {
namespace {

Node plugins_node(const std::vector<PluginFile>& files, FilePaths paths) {
  Node node{Node::Kind::list};
  for (const PluginFile& file : files) {
    Node entry{Node::Kind::map};
    entry.keys = {{"path", {}}, {"hash", {}}};
    const std::string& path = file.path;
    entry.items = {text_node(paths == FilePaths::whole ? path : std::filesystem::path(path).filename().string()),
                   scalar_node(file.hash, true)};
    node.items.push_back(std::move(entry));
  }
  node.flow = node.items.empty();
  return node;
}

Node robot_node(Scenario& scenario, const std::vector<std::string>& joints) {
  Writer writer(joints);
  for (auto& [key, node] : robot_nodes(*scenario.robot, *scenario.module_documents)) writer.add(key, std::move(node));
  if (!scenario.may_overlap.empty()) writer.add(kMayOverlap, body_pairs_node(scenario.may_overlap));
  if (scenario.robot->stated_legs) writer.add(kLegs, legs_node(*scenario.robot));
  const bool placed = !scenario.on_ground || scenario.position != Vec3::Zero();
  BaseFields{scenario, placed}.fields(writer);
  return writer.take();
}

/// Replaces the file of heights by the file in the run folder, which contains heights in metres.
void name_height_file(Ground& ground) {
  auto* field = std::get_if<Heightfield>(&ground.shape);
  if (!needs_height_file(field)) return;
  field->source.file = heights_name(*field);
  field->source.scale = 1;
}

}  // namespace

std::string resolved(const Scenario& scenario, FilePaths paths) {
  Scenario copy = scenario;  // the visitor also reads scenarios, and therefore needs write access
  if (paths == FilePaths::names) name_height_file(copy.ground);
  const std::vector<std::string> joints = joint_names(*scenario.robot);
  Writer writer(joints);
  writer.add("gaitlab", scalar_node("1"));
  writer.add("name", text_node(scenario.name));
  writer.add("plugins", plugins_node(scenario.plugins, paths));
  writer.add("robot", robot_node(copy, joints));
  if (Node groups = groups_node(scenario.groups); !groups.keys.empty()) writer.add(kGroupsSection, std::move(groups));
  const Entry* actuator = scenario.actuator.entry;
  SectionFields sections(copy, nullptr, nullptr, actuator == nullptr ? "none" : std::string(actuator->name));
  sections.writing = true;
  sections.has_cpg = scenario.cpg.entry != nullptr;
  sections.fields(writer);
  writer.add("sensors", sensors_node(scenario, joints));
  if (!scenario.changes.empty()) writer.add("at", changes_node(scenario, joints));
  return print_yaml(writer.take());
}

}  // namespace gaitlab
