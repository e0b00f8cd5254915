// Fixture of tests that make modules of URDF text, and parts of such texts.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/robot_files/module_file.h"
#include "interchange/robot_module.h"
#include "tests/folder.h"
#include "tests/folders.h"
#include "tests/messages.h"

namespace gaitlab::test {

inline ModuleType module_in(const interchange::RobotModule& made) {
  Problems problems;
  const Node document = parse_yaml(made.text, "made.yaml");
  ModuleType type = read_module(document, true, problems);
  problems.raise();
  return type;
}

/// Small files, each with a fault or a habit of public robots (README.md beside them).
inline const std::string kImports = std::string(source_folder()) + "/tests/data/imports/";

inline constexpr const char* kInertial =
    "<inertial><mass value='2'/><inertia ixx='0.01' iyy='0.02' izz='0.02' ixy='0' ixz='0' iyz='0'/></inertial>";
inline constexpr const char* kLimit = "<limit lower='-1' upper='2' effort='5' velocity='3'/>";

inline std::string urdf_link(const std::string& name, const std::string& content = kInertial) {
  return "<link name='" + name + "'>" + content + "</link>\n";
}
inline std::string urdf_joint(const std::string& name, const std::string& type, const std::string& parent,
                              const std::string& child, const std::string& content) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child + "'/>" +
         content + "</joint>\n";
}

class FromUrdf : public ::testing::Test {
 protected:
  ModuleType read_urdf(const std::string& content) {
    made_ =
        interchange::module_of_robot(folder_.write("r.urdf", "<robot name='r'>\n" + content + "</robot>\n"), "made", options_);
    return module_in(made_);
  }
  std::string refused(const std::string& content) {
    std::string text = message_of([&] { read_urdf(content); });
    const std::string place = folder_ / "r.urdf";
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place)) text.replace(at, place.size(), "r");
    return text;
  }
  /// Notes of the module that was read last, as `LINE Changed: TEXT`; line 0 means the whole file.
  std::vector<std::string> notes() const {
    std::vector<std::string> texts;
    for (const interchange::RobotNote& note : made_.notes)
      texts.push_back(fmt::format("{} {}: {}", note.place.line, note.kind(), note.text));
    return texts;
  }
  interchange::ImportOptions options_;
  interchange::RobotModule made_;
  Folder folder_;
};
using Texts = std::vector<std::string>;

inline const BodyType& body_of(const ModuleType& type, const std::string& name) {
  const auto found = std::ranges::find(type.bodies, name, &BodyType::name);
  if (found == type.bodies.end()) throw std::out_of_range("no body " + name);
  return *found;
}

}  // namespace gaitlab::test
