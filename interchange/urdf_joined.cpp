#include "interchange/urdf_joined.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/settings/wording.h"
#include "interchange/robot_bodies.h"
#include "interchange/urdf_mass.h"

namespace gaitlab::interchange {

namespace {

/// Links from the root outwards, each after its parent.
std::vector<const urdf::Link*> links_outwards(const urdf::ModelInterface& model) {
  std::vector<const urdf::Link*> links{model.getRoot().get()};
  for (std::size_t i = 0; i < links.size(); ++i) {
    for (const urdf::LinkSharedPtr& child : links[i]->child_links) links.push_back(child.get());
  }
  return links;
}

/// Properties of a link and of all that is joined to it.
struct JoinedGroup {
  bool mass = false, moves = false;  ///< true if it has mass; true if it is the parent of a joint that moves
};

std::vector<std::string> moving_joints(const std::vector<const urdf::Link*>& links) {
  std::vector<std::string> moving;
  for (const urdf::Link* const link : links) {
    const urdf::Joint* const joint = link->parent_joint.get();
    if (joint != nullptr && joint->type != urdf::Joint::FIXED) moving.push_back(joint->name);
  }
  return moving;
}

}  // namespace

std::set<const urdf::Joint*> joined_joints(const UrdfText& urdf, const std::vector<std::string>& locked,
                                           std::vector<RobotNote>& notes, Problems& problems) {
  std::set<const urdf::Joint*> joined;
  std::map<const urdf::Link*, JoinedGroup> groups;
  const std::vector<const urdf::Link*> links = links_outwards(urdf.model());
  const std::set<std::string> fixed_by_option = locked_joints(moving_joints(links), locked, problems);
  for (auto next = links.rbegin(); next != links.rend(); ++next) {
    const urdf::Link* const link = *next;
    JoinedGroup& own = groups[link];
    own.mass = own.mass || has_mass(*link);
    const urdf::Joint* const joint = link->parent_joint.get();
    if (joint == nullptr) continue;
    JoinedGroup& parent = groups[urdf.model().getLink(joint->parent_link_name).get()];
    const bool fixed = joint->type == urdf::Joint::FIXED;
    const bool by_option = !fixed && fixed_by_option.contains(joint->name);
    const bool frame = !fixed && !by_option && !own.mass && !own.moves;
    if (by_option) {
      notes.push_back({urdf.place("joint", joint->name),
                       fmt::format("joint {} is fixed at 0, as --lock asks", in_quotes(joint->name)), true});
    }
    if (frame) {
      notes.push_back({urdf.place("joint", joint->name),
                       fmt::format("joint {} moves only link {}, which has no mass; it is fixed at 0", in_quotes(joint->name),
                                   in_quotes(link->name)),
                       true});
    }
    if (fixed || by_option || frame) {
      joined.insert(joint);
      parent.mass = parent.mass || own.mass;
      parent.moves = parent.moves || own.moves;
    } else {
      parent.moves = true;
    }
  }
  return joined;
}

}  // namespace gaitlab::interchange
