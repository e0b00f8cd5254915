#include "core/robot_files/servo_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/files/file_kind.h"
#include "core/settings/data_folder.h"
#include "core/settings/file_of_name.h"
#include "core/settings/reader.h"
#include "core/settings/shipped_files.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"

namespace gaitlab {

namespace {

constexpr std::array kServoSections{"actuator", "controller"};

Node* find(Node& map, const std::string& key) { return const_cast<Node*>(std::as_const(map).find(key)); }

/// Path of the file that `name` means; adds a problem and returns "" if there is none.
std::string path_of(const Node& name, const std::string& folder, Problems& problems) {
  const std::string& text = name.text;
  if (text.find('/') != std::string::npos || text.ends_with(".yaml")) return path_from(folder, text);
  if (const auto file =
          file_of_name({path_from(folder, "servos/" + text + ".yaml"), path_from(folder, "../servos/" + text + ".yaml")},
                       data_folder() + "/servos/" + text + ".yaml"))
    return file->path;
  std::vector<std::string> known;
  for (const auto& [servo, path] : shipped_files("servo")) known.push_back(servo);
  problems.add(name.place, "no servo " + in_quotes(text) + offer(text, known, "servos"));
  return {};
}

/// The map `section` of a servo file, with the source of the file; a null node if there is none.
Node section_of(const std::string& path, const std::string& section, const SourceLocation& asked_at, Problems& problems) {
  expect_kind(path, FileKind::servo);
  const Node file = read_yaml(path, asked_at);
  const std::size_t before = problems.size();
  Reader reader(file, "servo file", problems, nullptr);
  reader.version("gaitlab_servo");
  std::string name;
  std::string source;
  reader.text("name", name, "");
  reader.text("source", source, "");
  reader.require({"name", "source", "actuator"});
  for (const char* const one : kServoSections) reader.take(one);
  reader.finish();
  const Node* const found = file.find(section);
  if (problems.size() > before || found == nullptr || found->kind != Node::Kind::map) return {};
  Node keys = *found;
  if (section != kServoSections[0]) return keys;
  keys.keys.emplace_back("source", found->place);
  keys.items.push_back(*file.find("source"));
  return keys;
}

void insert(Node& map, const std::string& section, const std::string& folder, Problems& problems) {
  const Node* const model = map.find(kServoModel);
  if (model == nullptr) return;
  const Node name = *model;
  const auto at = static_cast<std::size_t>(model - map.items.data());
  map.keys.erase(map.keys.begin() + static_cast<std::ptrdiff_t>(at));
  map.items.erase(map.items.begin() + static_cast<std::ptrdiff_t>(at));
  if (name.kind != Node::Kind::scalar) {
    problems.add(name.place, fmt::format("model is {}; expected the name of a servo (gaitlab list servo)", found(name)));
    return;
  }
  const std::string path = path_of(name, folder, problems);
  if (path.empty()) return;
  Problems found_in_file;
  Node keys;
  try {
    keys = section_of(path, section, name.place, found_in_file);
  } catch (const InputError& error) {
    add_all(error, found_in_file);
  }
  add_found(found_in_file, {path, folder, "servo file", "gaitlab_servo"}, problems);
  if (found_in_file.size() > 0) return;
  if (keys.kind == Node::Kind::null) {
    problems.add(name.place, fmt::format("servo {} has no {}", in_quotes(name.text), section));
    return;
  }
  const Node* const type = map.find("type");
  const Node* const own = keys.find("type");
  if (type != nullptr && own != nullptr && type->text != own->text) {
    Problem& problem = problems.add(name.place, fmt::format("servo {} is for {} {}, not {}", in_quotes(name.text), section,
                                                            in_quotes(own->text), in_quotes(type->text)));
    problem.notes.emplace_back(own->place, "its type is here");
    return;
  }
  auto place = static_cast<std::ptrdiff_t>(at);
  for (std::size_t i = 0; i < keys.items.size(); ++i) {
    if (map.find(keys.keys[i].first) != nullptr) continue;
    map.keys.insert(map.keys.begin() + place, keys.keys[i]);
    map.items.insert(map.items.begin() + place, keys.items[i]);
    ++place;
  }
}

}  // namespace

void insert_servos(Node& document, const std::string& folder, Problems& problems) {
  for (const char* const section : kServoSections) {
    Node* const map = find(document, section);
    if (map == nullptr || map->kind != Node::Kind::map) continue;
    insert(*map, section, folder, problems);
  }
  Node* const hinges = find(document, "hinges");
  if (hinges == nullptr) return;
  for (Node& hinge : hinges->items) {
    if (hinge.kind == Node::Kind::map) insert_servos(hinge, folder, problems);
  }
}

}  // namespace gaitlab
