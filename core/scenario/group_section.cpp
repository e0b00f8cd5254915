#include "core/scenario/group_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/model/frames.h"
#include "core/model/legs.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"

namespace gaitlab {

namespace {

/// The message for a name that a group may not have, or "".
std::string refused_name(const std::string& name, const std::vector<std::string>& joints,
                         const std::vector<std::string>& modules) {
  for (const auto& [parts, noun] : {std::pair(&joints, "joint"), std::pair(&modules, "module")}) {
    if (std::ranges::find(*parts, name) != parts->end())
      return fmt::format("{} is the name of a {}; expected another name for the group", in_quotes(name), noun);
  }
  const bool letter = !name.empty() && ((name[0] >= 'a' && name[0] <= 'z') || (name[0] >= 'A' && name[0] <= 'Z'));
  if (is_name(name, "_-") && letter && name != "default") return "";
  return in_quotes(name) + " is not a name of a group; expected a letter, then letters, digits, `_` and `-`, but not `default`";
}

/// The message for a member that matches no joint, or "". `groups` is the section.
std::string refused_member(const std::string& member, const std::vector<std::string>& joints, const JointGroups& legs,
                           const Node& groups) {
  const bool group = groups.find(member) != nullptr && joints_of(member, joints).empty();
  return group ? in_quotes(member) + " is a group; expected a joint or a pattern" : no_joint(member, joints, "joint", legs);
}

/// Joints of a group, in the order of the robot; none if the group has a fault.
std::vector<std::string> members(const std::string& name, const Node& node, const std::vector<std::string>& joints,
                                 const JointGroups& legs, const Node& groups, Problems& problems) {
  const std::size_t before = problems.size();
  const bool list = node.kind == Node::Kind::list;
  if (!list && node.kind != Node::Kind::scalar) {
    problems.add(node.place, fmt::format("group {} is {}; expected joints: [m3/hinge, \"m[4-6]/hinge\"]", name, found(node)));
    return {};
  }
  if (list && node.items.empty()) problems.add(node.place, fmt::format("group {} has no joint", in_quotes(name)));
  std::vector<bool> chosen(joints.size(), false);
  for (const Node& item : list ? std::span<const Node>(node.items) : std::span<const Node>(&node, 1)) {
    const Reading<std::string> text = read_scalar(item);
    const std::string wrong =
        text.ok() ? refused_member(text.value, joints, legs, groups) : "a member of group " + name + " " + text.wrong;
    if (!wrong.empty()) problems.add(item.place, wrong);
    for (const std::size_t j : text.ok() ? joints_of(text.value, joints, legs) : std::vector<std::size_t>()) chosen[j] = true;
  }
  std::vector<std::string> all;
  for (std::size_t j = 0; j < joints.size() && problems.size() == before; ++j) {
    if (chosen[j]) all.push_back(joints[j]);
  }
  return all;
}

}  // namespace

JointGroups read_groups(const Node& node, const std::vector<std::string>& joints, const std::vector<std::string>& modules,
                        const JointGroups& legs, Problems& problems) {
  JointGroups groups;
  if (node.kind != Node::Kind::map) {
    problems.add(node.place, fmt::format("groups is {}; expected a map NAME: [JOINT, ...]", found(node)));
    return groups;
  }
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const auto& [name, place] = node.keys[i];
    const std::string wrong = refused_name(name, joints, modules);
    if (!wrong.empty()) problems.add(place, wrong);
    groups.push_back({name, members(clipped(name), node.items[i], joints, legs, node, problems)});
  }
  return groups;
}

JointGroups leg_groups(const Robot& robot, std::span<const double> angles, const Vec3& orientation) {
  JointGroups groups;
  for (const Leg& leg : legs_of(robot, angles, rpy(orientation))) {
    JointGroup whole{kLegGroup + leg.name, {}};
    for (const std::int64_t joint : leg.joints) whole.joints.push_back(robot.joints[static_cast<std::size_t>(joint)].name);
    groups.push_back(whole);
    for (std::size_t k = 0; k < whole.joints.size(); ++k)
      groups.push_back({fmt::format("{}/{}", whole.name, k), {whole.joints[k]}});
  }
  return groups;
}

Node groups_node(const JointGroups& groups) {
  Node all{Node::Kind::map};
  for (const JointGroup& group : groups) {
    if (group.name.starts_with(kLegGroup)) continue;
    Node list{Node::Kind::list};
    list.flow = true;
    for (const std::string& joint : group.joints) list.items.push_back(text_node(joint));
    all.keys.emplace_back(group.name, SourceLocation{});
    all.items.push_back(std::move(list));
  }
  return all;
}

}  // namespace gaitlab
