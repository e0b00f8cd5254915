// The section `groups` of a scenario: names for several joints.
#pragma once
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/node.h"

namespace gaitlab {

inline constexpr const char* kGroupsSection = "groups";
inline constexpr const char* kAboutGroups =
    "Groups of joints by name, each a joint, a pattern, or a list of them: {hips: [m3/hinge, \"m[4-6]/hinge\"]}. A group is "
    "allowed wherever a pattern of joints is.";

/// Reads the section. Every fault is a problem at its place: a name that is not allowed or is that of a joint or module, a
/// member that matches no joint, and a group without members. A group with a fault does not have joints; this is reported only
/// here.
JointGroups read_groups(const Node& node, const std::vector<std::string>& joints, const std::vector<std::string>& modules,
                        Problems& problems);

/// The section with every member given by name.
Node groups_node(const JointGroups& groups);

}  // namespace gaitlab
