// The section `groups` of a scenario: names for several joints.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/model/robot.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/node.h"

namespace gaitlab {

inline constexpr const char* kGroupsSection = "groups";
inline constexpr const char* kAboutGroups =
    "Groups of joints by name, each a joint, a pattern, or a list of them: {hips: [m3/hinge, \"m[4-6]/hinge\"]}. A group is "
    "allowed wherever a pattern of joints is. Legs are groups without being listed: leg:front_left, \"leg:*_left\", and "
    "\"leg:*/2\" for the third joint of each from the trunk.";

/// Reads the section, whose members may be of the groups `legs`. Every fault is a problem at its place: a name that is not
/// allowed or is that of a joint or module, a member that matches no joint, and a group without members. A group with a fault
/// does not have joints; this is reported only here.
JointGroups read_groups(const Node& node, const std::vector<std::string>& joints, const std::vector<std::string>& modules,
                        const JointGroups& legs, Problems& problems);

/// Groups of the legs of a robot that starts with these angles, rad, and this orientation (roll, pitch, yaw): `leg:front_left`,
/// and `leg:front_left/0` for its first joint from the trunk.
JointGroups leg_groups(const Robot& robot, std::span<const double> angles, const Vec3& orientation);

/// The section with every member given by name, without the groups of legs.
Node groups_node(const JointGroups& groups);

}  // namespace gaitlab
