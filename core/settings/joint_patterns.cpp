#include "core/settings/joint_patterns.h"

#include <algorithm>
#include <unordered_set>

#include "core/errors.h"
#include "core/model/pattern.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

/// Patterns to suggest: for each joint `module/hinge` the pattern of this hinge in every module and of every hinge of this
/// module.
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

}  // namespace

std::vector<std::size_t> joints_of(const std::string& text, const std::vector<std::string>& joints) {
  std::vector<std::size_t> numbers;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (glob(text, joints[j])) numbers.push_back(j);
  }
  return numbers;
}

std::string no_joint(const std::string& text, const std::vector<std::string>& joints, const std::string& part) {
  if (!joints_of(text, joints).empty()) return "";
  if (!is_pattern(text)) return "no " + part + " " + in_quotes(text) + offer(text, joints, part + "s");
  const std::vector<std::string> usual = usual_patterns(joints);
  return "no " + part + " matches " + in_quotes(text) +
         (nearest(clipped(text), usual).empty() ? offer(text, joints, part + "s") : offer(text, usual, "patterns"));
}

std::string not_one_joint(const std::string& text, const std::vector<std::string>& joints, const std::string& part) {
  return is_pattern(text) ? in_quotes(text) + " is a pattern; expected the name of one " + part : no_joint(text, joints, part);
}

std::vector<std::string> joints_meant(const std::vector<std::string>& list, const std::vector<std::string>& joints) {
  std::vector<std::string> meant;
  std::unordered_set<std::string> seen;
  for (const std::string& text : list) {
    const std::vector<std::size_t> numbers = is_pattern(text) ? joints_of(text, joints) : std::vector<std::size_t>();
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
