// Joint names given by a user. Each is the name of one joint, a pattern or the name of a group.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab {

/// A name for several joints, allowed wherever a pattern is allowed. The joints are in the order of the robot.
struct JointGroup {
  std::string name;
  std::vector<std::string> joints;
  bool operator==(const JointGroup&) const = default;
};
using JointGroups = std::vector<JointGroup>;

/// Beginning of the names of groups that follow from the legs of the robot, which may be meant by a pattern: `leg:front_left`,
/// its joints; `leg:*_left`; `leg:*/2`, the third joint of each leg from the trunk.
inline constexpr const char* kLegGroup = "leg:";

/// The group with this name, or nullptr.
const JointGroup* group_named(const std::string& name, const JointGroups& groups);
/// True for a pattern or the name of a group.
bool means_several(const std::string& text, const JointGroups& groups);

/// Ascending numbers of the joints that match a name (`m3/active`), a pattern (`*/active`, `m3/*`, `m[3-6]/active`) or a group,
/// or that are in a group of legs whose name matches a pattern. If the result is empty, no_joint() gives the message.
std::vector<std::size_t> joints_of(const std::string& text, const std::vector<std::string>& joints,
                                   const JointGroups& groups = {});

/// Message for a name or pattern that matches no joint, with the most similar name or pattern that matches one: `no joint
/// 'm3/activ'; did you mean 'm3/active'?`. Empty if a joint matches. `part` is `joint`, or `module` for names of modules.
std::string no_joint(const std::string& text, const std::vector<std::string>& joints, const std::string& part = "joint",
                     const JointGroups& groups = {});

/// Message like that of no_joint(), for a setting that requires a single joint and allows no patterns and groups.
std::string not_one_joint(const std::string& text, const std::vector<std::string>& joints, const std::string& part = "joint",
                          const JointGroups& groups = {});

/// Columns of a recording that a text means: all columns whose names match the text as a name or pattern. For
/// `joint.JOINT.PART` and `reaction.JOINT.PART`, where JOINT is a name, pattern or group, also the columns of these joints,
/// which are named by joint numbers.
class ColumnChoice {
 public:
  ColumnChoice(std::string text, const std::vector<std::string>& joints, const JointGroups& groups);
  [[nodiscard]] bool has(const std::string& column) const;

 private:
  std::string text_, head_, part_;  ///< `head_`: `joint.` or `reaction.`; `part_`: `.PART`
  std::vector<bool> chosen_;        ///< true for the joints of JOINT
};

/// Names of the joints that match a list of names, patterns and groups, in the order of the list. A pattern or group adds the
/// joints that no earlier entry names. Texts that match no joint are kept.
std::vector<std::string> joints_meant(const std::vector<std::string>& list, const std::vector<std::string>& joints,
                                      const JointGroups& groups = {});

}  // namespace gaitlab
