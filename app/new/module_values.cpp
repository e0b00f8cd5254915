#include "app/new/module_values.h"

#include <fmt/format.h>

#include <vector>

#include "app/new/scenario_values.h"
#include "app/shell/commands.h"
#include "core/robot_files/module_file.h"
#include "core/scenario/read_scenario.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"
#include "report/analysis/own_overlap.h"

namespace gaitlab::app {

OverlapKey overlap_key(const interchange::RobotModule& made) {
  Problems problems;
  const ModuleType type = read_module(parse_yaml(made.text, "module"), true, problems);
  problems.raise();
  std::vector<std::string> names;
  for (const BodyType& body : type.bodies) names.push_back(body.name);
  const BodyPairs excluded(made.may_overlap, names);
  std::vector<BodyPair> pairs;
  for (const auto& [a, b] : report::always_overlapping(type)) {
    if (!excluded.has(a, b)) pairs.push_back({names[a], names[b]});
  }
  std::string text;
  const auto add = [&](const char* comment, const std::vector<BodyPair>& list) {
    if (!list.empty()) text += comment;
    for (const BodyPair& pair : list) text += fmt::format("  - [{}, {}]\n", yaml_text(pair.first), yaml_text(pair.second));
  };
  add("  # whose contact the file excludes\n", made.may_overlap);
  add("  # that overlap by more than 0.5 mm at all angles, as drawn\n", pairs);
  if (text.empty()) return {};
  OverlapKey key{"# Bodies that the check `collision` leaves out:\nmay_overlap:\n" + text, ""};
  if (!pairs.empty()) {
    key.note = fmt::format("may_overlap lists {} of bodies that overlap at all angles, the first '{}' and '{}'",
                           counted(pairs.size(), "pair"), pairs[0].first, pairs[0].second);
  }
  return key;
}

std::string fall_text(const std::string& file) {
  Catalog catalog = standard_catalog();
  const Scenario one = read_module(file, catalog);
  const ModuleType& type = one.robot->types[0];
  const bool touches = !type.all.empty() || !type.feet.empty();
  const std::string angles = gait_values(one, 0).angles;
  return fmt::format("{{gaitlab: 1, robot: {{modules: {}{}}}, actuator: {{type: none}}, contact: {{on: {}}}, {}{}duration: 5}}",
                     yaml_text(file.find('/') == std::string::npos ? "./" + file : file),
                     type.base == Base::floating ? "" : fmt::format(", base: {}", name_of(type.base)), touches ? "all" : "none",
                     touches ? "" : "ground: {type: none}, ", angles == "0" ? "" : "initial: {angles: " + angles + "}, ");
}

}  // namespace gaitlab::app
