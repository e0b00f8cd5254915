#include "core/settings/joint_patterns.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <unordered_set>

#include "core/errors.h"
#include "core/model/pattern.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

/// Patterns to suggest. Each joint `module/hinge` gives the pattern for this hinge in every module, and the pattern for every
/// hinge of this module.
std::vector<std::string> usual_patterns(const std::vector<std::string>& joints) {
  std::vector<std::string> patterns;
  std::unordered_set<std::string> seen;
  const auto add = [&](std::string pattern) {
    if (seen.insert(pattern).second) patterns.push_back(std::move(pattern));
  };
  for (const std::string& joint : joints) {
    const std::size_t slash = joint.find('/');
    if (slash == std::string::npos) continue;
    add("*" + joint.substr(slash));
    add(joint.substr(0, slash) + "/*");
  }
  return patterns;
}

/// Range of existing names for a number that is too large: `m0/hinge to m2/hinge` for m9/hinge, and `m0 to m2` for m9. Empty
/// for other names.
std::string range_beside(const std::string& text, const std::vector<std::string>& joints) {
  const std::size_t end = std::min(text.find('/'), text.size());
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  if (end < 2 || text[0] != 'm' || !std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(end), digit))
    return "";
  std::vector<std::string> beside;
  for (const std::string& joint : joints) {
    if (joint.substr(std::min(joint.find('/'), joint.size())) == text.substr(end)) beside.push_back(joint);
  }
  if (beside.size() < 2) return "";
  return beside.size() <= 3 ? joined(beside) : beside.front() + " to " + beside.back();
}

}  // namespace

const JointGroup* group_named(const std::string& name, const JointGroups& groups) {
  const auto found = std::ranges::find(groups, name, &JointGroup::name);
  return found == groups.end() ? nullptr : &*found;
}

bool means_several(const std::string& text, const JointGroups& groups) {
  return is_pattern(text) || group_named(text, groups) != nullptr;
}

std::vector<std::size_t> joints_of(const std::string& text, const std::vector<std::string>& joints, const JointGroups& groups) {
  std::vector<const JointGroup*> named;
  const bool of_legs = text.starts_with(kLegGroup);
  for (const JointGroup& group : groups) {
    if (group.name == text || (of_legs && glob(text, group.name))) named.push_back(&group);
  }
  std::vector<std::size_t> numbers;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto has = [&](const JointGroup* group) {
      return std::ranges::find(group->joints, joints[j]) != group->joints.end();
    };
    if (named.empty() ? glob(text, joints[j]) : std::ranges::any_of(named, has)) numbers.push_back(j);
  }
  return numbers;
}

namespace {

/// Message for the name of a module where a joint is expected, or of a joint where a module is expected.
std::string of_the_other_kind(const std::string& text, const std::vector<std::string>& names, const std::string& part) {
  std::vector<std::string> within;
  std::ranges::copy_if(names, std::back_inserter(within), [&](const auto& name) { return name.starts_with(text + "/"); });
  if (part == "joint" && !text.empty() && !within.empty()) {
    return fmt::format("{0} is a module; its joint{1} {2}", in_quotes(text), within.size() == 1 ? " is" : "s are",
                       joined(within));
  }
  const std::string head = text.substr(0, text.find('/'));
  if (part != "module" || head == text || std::ranges::find(names, head) == names.end()) return "";
  return fmt::format("{} is not a module; expected its module, {}", in_quotes(text), head);
}

/// Message for a text that means no joint of a leg.
std::string no_leg(const std::string& text, const JointGroups& groups, const std::string& part) {
  std::vector<std::string> legs;
  std::size_t longest = 0;
  for (const JointGroup& group : groups) {
    if (!group.name.starts_with(kLegGroup) || group.name.find('/') != std::string::npos) continue;
    legs.push_back(group.name);
    longest = std::max(longest, group.joints.size());
  }
  if (legs.empty()) return fmt::format("no {} {}; the robot has no legs", part, in_quotes(text));
  return fmt::format("no {} {}{}; each has at most {}", part, in_quotes(text), offer(text, legs, "legs"),
                     counted(longest, "joint"));
}

}  // namespace

std::string no_joint(const std::string& text, const std::vector<std::string>& joints, const std::string& part,
                     const JointGroups& groups) {
  if (!joints_of(text, joints, groups).empty()) return "";
  if (group_named(text, groups) != nullptr) return "";  // the group has a fault, which is reported where it is given
  if (text.starts_with(kLegGroup)) return no_leg(text, groups, part);
  if (!is_pattern(text)) {
    if (std::string other = of_the_other_kind(text, joints, part); !other.empty()) return other;
    const std::string range = range_beside(text, joints);
    std::vector<std::string> known = joints;
    for (const JointGroup& group : groups) known.push_back(group.name);
    const char* kinds = groups.empty() ? "s" : "s and groups";
    return "no " + part + " " + in_quotes(text) +
           (range.empty() ? offer(text, known, part + kinds) : fmt::format("; {}s are {}", part, range));
  }
  const std::vector<std::string> usual = usual_patterns(joints);
  return "no " + part + " matches " + in_quotes(text) +
         (nearest(clipped(text), usual).empty() ? offer(text, joints, part + "s") : offer(text, usual, "patterns"));
}

std::string not_one_joint(const std::string& text, const std::vector<std::string>& joints, const std::string& part,
                          const JointGroups& groups) {
  if (group_named(text, groups) != nullptr) return in_quotes(text) + " is a group; expected the name of one " + part;
  return is_pattern(text) ? in_quotes(text) + " is a pattern; expected the name of one " + part
                          : no_joint(text, joints, part, groups);
}

ColumnChoice::ColumnChoice(std::string text, const std::vector<std::string>& joints, const JointGroups& groups)
    : text_(std::move(text)), chosen_(joints.size(), false) {
  const std::size_t end = text_.rfind('.');
  for (const std::string head : {"joint.", "reaction."}) {
    if (!text_.starts_with(head) || end < head.size()) continue;
    head_ = head;
    part_ = text_.substr(end);
    for (const std::size_t j : joints_of(text_.substr(head.size(), end - head.size()), joints, groups)) chosen_[j] = true;
  }
}

bool ColumnChoice::has(const std::string& column) const {
  if (glob(text_, column)) return true;
  if (head_.empty() || !column.starts_with(head_)) return false;
  std::size_t joint = 0;
  const auto read = std::from_chars(column.data() + head_.size(), column.data() + column.size(), joint);
  return read.ec == std::errc() && joint < chosen_.size() && chosen_[joint] && glob(part_, read.ptr);
}

std::vector<std::string> joints_meant(const std::vector<std::string>& list, const std::vector<std::string>& joints,
                                      const JointGroups& groups) {
  std::vector<std::string> meant;
  std::unordered_set<std::string> seen;
  for (const std::string& text : list) {
    const std::vector<std::size_t> numbers =
        means_several(text, groups) ? joints_of(text, joints, groups) : std::vector<std::size_t>();
    if (numbers.empty()) {
      seen.insert(text);
      meant.push_back(text);
    }
    for (const std::size_t j : numbers) {
      if (seen.insert(joints[j]).second) meant.push_back(joints[j]);
    }
  }
  return meant;
}

}  // namespace gaitlab
