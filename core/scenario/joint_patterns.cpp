#include "core/scenario/joint_patterns.h"

#include <algorithm>

#include "core/errors.h"
#include "core/model/pattern.h"
#include "core/scenario/wording.h"

namespace gaitlab {
namespace {

/// Patterns that mean some joint: every joint's module with any hinge, and its hinge of any module.
std::vector<std::string> usual_patterns(const std::vector<std::string>& joints) {
  std::vector<std::string> patterns;
  const auto add = [&](std::string pattern) {
    if (std::ranges::find(patterns, pattern) == patterns.end()) patterns.push_back(std::move(pattern));
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

std::string no_joint(const std::string& text, const std::vector<std::string>& joints) {
  if (!joints_of(text, joints).empty()) return "";
  if (!is_pattern(text)) return "no joint " + in_quotes(text) + offer(text, joints, "joints");
  const std::vector<std::string> usual = usual_patterns(joints);
  return "no joint matches " + in_quotes(text) +
         (nearest(clipped(text), usual).empty() ? offer(text, joints, "joints") : offer(text, usual, "patterns"));
}

std::string not_one_joint(const std::string& text, const std::vector<std::string>& joints) {
  return is_pattern(text) ? in_quotes(text) + " is a pattern; expected the name of one joint" : no_joint(text, joints);
}

std::vector<std::string> joints_meant(const std::vector<std::string>& list, const std::vector<std::string>& joints) {
  std::vector<std::string> meant;
  for (const std::string& text : list) {
    if (!is_pattern(text) || !no_joint(text, joints).empty()) {
      meant.push_back(text);
      continue;
    }
    for (const std::size_t j : joints_of(text, joints)) {
      if (std::ranges::find(meant, joints[j]) == meant.end()) meant.push_back(joints[j]);
    }
  }
  return meant;
}

}  // namespace gaitlab
