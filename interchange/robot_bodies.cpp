#include "interchange/robot_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/model/pattern.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/wording.h"

namespace gaitlab::interchange {

namespace {

std::vector<std::string> allowed_names(const std::vector<RobotElement>& elements) {
  std::set<std::string> seen;
  for (const RobotElement& one : elements) seen.insert(one.name.substr(one.name.rfind('/') + 1));
  const bool unique = seen.size() == elements.size();
  seen = {"dock"};  // name reserved for docks
  std::vector<std::string> allowed;
  for (const RobotElement& element : elements) {
    std::string text = unique ? element.name.substr(element.name.rfind('/') + 1) : element.name;
    std::erase_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; });  // one _ for each UTF-8 letter
    for (char& c : text) c = is_name(std::string(1, c), "_-") ? c : '_';
    text = text.empty() ? "part" : text.substr(0, 90);
    std::string one = text;
    for (int n = 2; !seen.insert(one).second; ++n) one = fmt::format("{}_{}", text, n);
    allowed.push_back(one);
  }
  return allowed;
}

}  // namespace

void RobotBodies::finish() {
  const auto note = [&](const char* what, const RobotElement& given, const std::string& allowed) {
    if (given.name == allowed || given.name.ends_with("/" + allowed)) return;
    notes.push_back(
        {given.place, fmt::format("the name of {} {}, which is {} here", what, in_quotes(given.name), allowed), false});
  };
  const std::vector<std::string> of_bodies = allowed_names(body_of);
  const std::vector<std::string> of_hinges = allowed_names(hinge_of);
  for (std::size_t b = 0; b < bodies.size(); ++b) note(format.body, body_of[b], bodies[b].name = of_bodies[b]);
  for (std::size_t j = 0; j < hinges.size(); ++j) note("joint", hinge_of[j], hinges[j].hinge.name = of_hinges[j]);
  std::ranges::stable_sort(notes, {}, [](const RobotNote& one) {
    return std::tuple(one.place.line > 0, one.place.file, one.place.line, one.place.column);
  });
}

std::set<std::string> locked_joints(const std::vector<std::string>& moving, const std::vector<std::string>& locked,
                                    Problems& problems) {
  std::set<std::string> names;
  for (const std::string& one : locked) {
    const bool verbatim = std::ranges::find(moving, one) != moving.end();
    bool found = false;
    for (const std::string& name : moving) {
      if (verbatim ? name != one : !glob(one, name)) continue;
      names.insert(name);
      found = true;
    }
    if (!found) problems.add(SourceLocation{"--lock"}, no_joint(one, moving));
  }
  return names;
}

}  // namespace gaitlab::interchange
