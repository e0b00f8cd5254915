#include "core/robot_files/servo_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

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

/// A document that names servos, and what is found on the way.
struct Search {
  const std::string& folder;  ///< of the document
  Problems& problems;
  std::vector<Problem>& notes;
  const Node* controller = nullptr;  ///< the map that the document states
};

/// Path of the file that `name` means; adds a problem and returns "" if there is none.
std::string path_of(const Node& name, const Search& search) {
  const auto& [folder, problems, notes, controller] = search;
  const std::string& text = name.text;
  if (text.find('/') != std::string::npos || text.ends_with(".yaml")) return path_from(folder, text);
  if (const auto file =
          file_of_name({path_from(folder, "servos/" + text + ".yaml"), path_from(folder, "../servos/" + text + ".yaml")},
                       data_folder() + "/servos/" + text + ".yaml")) {
    std::string hidden = note_of_hidden(text, *file);
    if (!hidden.empty() && std::ranges::find(notes, hidden, &Problem::text) == notes.end())
      notes.push_back({name.place, std::move(hidden)});
    return file->path;
  }
  std::vector<std::string> known;
  for (const auto& [servo, path] : shipped_files("servo")) known.push_back(servo);
  problems.add(name.place, "no servo " + in_quotes(text) + offer(text, known, "servos"));
  return {};
}

constexpr std::array kKinds{"data sheet", "identified", "chosen"};  // in the order of ServoFigure

/// Keys of an entry of `sources`.
struct SourceKeys : ServoSource {
  void fields(Fields& f) {
    Marked required(f, Need::required);
    required.texts("of", of, "Keys of actuator and controller that have this source.");
    required.choice("kind", kind, kKinds, "Origin of the numbers.");
    required.text("text", text, "Document, or logs and method.");
  }
};

/// The keys of a map except `type`, with their places.
std::vector<std::pair<std::string, SourceLocation>> figures(const Node& map) {
  std::vector<std::pair<std::string, SourceLocation>> keys;
  std::ranges::copy_if(map.keys, std::back_inserter(keys), [](const auto& key) { return key.first != "type"; });
  return keys;
}

/// Requires exactly one source for each number of the file.
void check_sources(const Node& list, const ServoFile& servo, Problems& problems) {
  std::vector<std::string> known, sourced;
  auto keys = figures(servo.actuator);
  const auto of_controller = figures(servo.controller);
  keys.insert(keys.end(), of_controller.begin(), of_controller.end());
  for (const auto& [key, place] : keys) known.push_back(key);
  for (const Node& source : list.items) {
    for (const Node& of : source.find("of")->items) {
      if (std::ranges::count(known, of.text) == 0) {
        problems.add(of.place, fmt::format("the file states no {}{}", in_quotes(of.text), offer(of.text, known, "keys")));
      } else if (std::ranges::count(sourced, of.text) > 0) {
        problems.add(of.place, fmt::format("{} has two sources; expected one", in_quotes(of.text)));
      }
      sourced.push_back(of.text);
    }
  }
  for (const auto& [key, place] : keys) {
    if (std::ranges::count(sourced, key) == 0)
      problems.add(place, fmt::format("{} has no source; expected its name in an `of` of sources", in_quotes(key)));
  }
}

/// One text for all sources, chosen numbers first. The first source is printed without its keys.
std::string together(const std::vector<ServoSource>& sources) {
  std::string text;
  const auto add = [&](const ServoSource& source) {
    const std::string keys = fmt::format("{}", fmt::join(source.of, ", "));
    const bool own = source.kind == ServoFigure::chosen;
    text += fmt::format("{}{}{}", text.empty() ? "" : "; ", own ? "chosen: " : "", text.empty() && !own ? "" : keys + ": ");
    text += source.text;
  };
  for (const ServoSource& source : sources) {
    if (source.kind == ServoFigure::chosen) add(source);
  }
  for (const ServoSource& source : sources) {
    if (source.kind != ServoFigure::chosen) add(source);
  }
  return text;
}

/// Takes the map `section` of a servo file.
Node map_of(const Node& file, const char* section, Problems& problems) {
  const Node* const found = file.find(section);
  if (found == nullptr) return {};
  if (found->kind != Node::Kind::map) {
    problems.add(found->place, fmt::format("{} is {}; expected a map", section, gaitlab::found(*found)));
    return {};
  }
  if (const Node* const nested = found->find(kServoModel))
    problems.add(nested->place, "a servo file cannot name another one; expected the keys themselves");
  return *found;
}

/// Keys that exclude each other: a stated one takes the place of the other in a servo file.
constexpr std::array<std::pair<const char*, const char*>, 5> kInstead{
    {{"gain", "P"}, {"gain", "unit"}, {"P", "gain"}, {"efficiency", "stall_current"}, {"stall_current", "efficiency"}}};

bool stated(const Node& map, const std::string& key) {
  const auto instead = [&](const auto& one) { return one.second == key && map.find(one.first) != nullptr; };
  return map.find(key) != nullptr || std::ranges::any_of(kInstead, instead);
}

/// Source of a map that states the keys `own` itself and takes the others from a servo file.
std::string source_of(const std::vector<std::string>& own, const Node* stated, const std::string& of_file) {
  if (own.empty()) return of_file;
  const std::string keys = fmt::format("{}", fmt::join(own, ", "));
  return stated != nullptr ? fmt::format("{}: {}; the rest: {}", keys, stated->text, of_file)
                           : fmt::format("chosen: {}; the rest: {}", keys, of_file);
}

/// True if a stated key takes the place of one that moves the joint.
bool changes_motion(const Node& stated_by, const Node& of_file) {
  return std::ranges::any_of(of_file.keys, [&](const auto& key) {
    return key.first != "type" && moves_joint(key.first, true) && stated(stated_by, key.first);
  });
}

/// True if the controller states another value for a key that the servo has from logs.
bool changes_controller(const Node* controller, const ServoFile& servo) {
  if (controller == nullptr) return false;
  return std::ranges::any_of(servo.controller.keys, [&](const auto& key) {
    const ServoSource* const source = servo.source_of(key.first);
    const Node* const own = controller->find(key.first);
    return source != nullptr && source->kind == ServoFigure::identified && own != nullptr &&
           own->text != servo.controller.find(key.first)->text;
  });
}

void put(Node& map, std::size_t at, const std::string& key, Node value) {
  map.keys.emplace(map.keys.begin() + static_cast<std::ptrdiff_t>(at), key, value.place);
  map.items.insert(map.items.begin() + static_cast<std::ptrdiff_t>(at), std::move(value));
}

void remove(Node& map, const Node* value) {
  const auto at = value - map.items.data();
  map.keys.erase(map.keys.begin() + at);
  map.items.erase(map.items.begin() + at);
}

/// The servo of that name, or nothing after a problem.
std::optional<ServoFile> named(const Node& name, const Search& search) {
  const auto& [folder, problems, notes, controller] = search;
  if (name.kind != Node::Kind::scalar) {
    problems.add(name.place, fmt::format("model is {}; expected the name of a servo (gaitlab list servo)", found(name)));
    return {};
  }
  const std::string path = path_of(name, search);
  if (path.empty()) return {};
  Problems found_in_file;
  std::optional<ServoFile> servo;
  try {
    servo = read_servo(path, name.place, found_in_file);
  } catch (const InputError& error) {
    add_all(error, found_in_file);
  }
  add_found(found_in_file, {path, folder, "servo file", "gaitlab_servo"}, problems);
  return servo;
}

/// `of_hinge`: the map is that of a hinge, whose type is that of the module.
void insert(Node& map, const std::string& section, bool of_hinge, const Search& search) {
  Problems& problems = search.problems;
  const Node* const model = map.find(kServoModel);
  if (model == nullptr) return;
  const Node name = *model;
  auto at = static_cast<std::size_t>(model - map.items.data());
  remove(map, model);
  const std::optional<ServoFile> servo = named(name, search);
  if (!servo) return;
  const Node& keys = section == kServoSections[0] ? servo->actuator : servo->controller;
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
  std::vector<std::string> stated_keys;
  for (const auto& [key, place] : map.keys) {
    if (key != "type" && key != "source") stated_keys.push_back(key);
  }
  const Node before = map;
  for (std::size_t i = 0; i < keys.items.size(); ++i) {
    const std::string& key = keys.keys[i].first;
    if (stated(before, key) || (of_hinge && key == "type")) continue;
    put(map, at++, key, keys.items[i]);
  }
  if (section != kServoSections[0]) return;
  const Node* const source = map.find("source");
  Node text = source != nullptr ? *source : Node{Node::Kind::scalar, name.place};
  text.text = source_of(stated_keys, source, servo->source);
  text.quoted = true;
  if (source != nullptr) remove(map, source);
  put(map, map.items.size(), "source", std::move(text));
  if (servo->identified.any() && map.find(kIdentified) == nullptr && !changes_motion(before, keys) &&
      !changes_controller(search.controller, *servo)) {
    put(map, map.items.size(), kIdentified, servo->logs);
  }
}

void insert_all(Node& document, bool of_hinge, const Search& search) {
  for (const char* const section : kServoSections) {
    Node* const map = find(document, section);
    if (map == nullptr || map->kind != Node::Kind::map) continue;
    insert(*map, section, of_hinge, search);
  }
}

}  // namespace

const ServoSource* ServoFile::source_of(const std::string& key) const {
  const auto at = std::ranges::find_if(sources, [&](const ServoSource& one) { return std::ranges::count(one.of, key) > 0; });
  return at == sources.end() ? nullptr : &*at;
}

std::optional<ServoFile> read_servo(const std::string& path, const SourceLocation& asked_at, Problems& problems) {
  expect_kind(path, FileKind::servo);
  const Node file = read_yaml(path, asked_at);
  const std::size_t before = problems.size();
  Reader reader(file, "servo file", problems, nullptr);
  reader.version("gaitlab_servo");
  ServoFile servo;
  std::vector<SourceKeys> sources;
  reader.text("name", servo.name, "");
  reader.text("source", servo.source, "");
  reader.list("sources", sources, "");
  reader.group(kIdentified, servo.identified, "");
  reader.require({"name", "actuator"});
  const Node* const list = file.find("sources");
  if (list == nullptr) {
    reader.require({"source"});
  } else if (const Node* const source = file.find("source")) {
    problems.add(source->place, "source and sources are both stated; expected one of them");
  }
  if (const Node* const logs = file.find(kIdentified)) check_identified(*logs, servo.identified, problems);
  for (const char* const one : kServoSections) reader.take(one);
  reader.finish();
  if (problems.size() > before) return {};
  servo.actuator = map_of(file, kServoSections[0], problems);
  servo.controller = map_of(file, kServoSections[1], problems);
  if (list != nullptr) check_sources(*list, servo, problems);
  if (problems.size() > before) return {};
  if (const Node* const logs = file.find(kIdentified)) servo.logs = *logs;
  servo.sources.assign(sources.begin(), sources.end());
  if (list != nullptr) servo.source = together(servo.sources);
  return servo;
}

void check_identified(const Node& stated, const Identification& identified, Problems& problems) {
  if (!identified.any()) problems.add(stated.place, "identified has no logs; expected their number, as in {logs: 8}");
  const Node* const count = stated.find("held_out_logs");
  const Node* const error = stated.find("held_out");
  if (identified.held_out_logs > 0 && error == nullptr)
    problems.add(count->place, "held_out_logs has no held_out; expected the error of these logs, as in {held_out: 0.04}");
  if (identified.held_out > 0 && identified.held_out_logs == 0)
    problems.add(error->place, "held_out has no held_out_logs; expected their number, as in {held_out_logs: 8}");
}

bool moves_joint(const std::string& key, bool stated_with_logs) {
  constexpr std::array kBeside{"u_max", "efficiency", "stall_current"};
  return key == "i_max" ? stated_with_logs : std::ranges::find(kBeside, key) == kBeside.end();
}

std::optional<ServoFile> named_servo(const Node& map, const std::string& folder, Problems& problems) {
  const Node* const model = map.find(kServoModel);
  std::vector<Problem> notes;
  return model == nullptr ? std::nullopt : named(*model, {folder, problems, notes});
}

void insert_servos(Node& document, const std::string& folder, Problems& problems, std::vector<Problem>& notes) {
  const Search search{folder, problems, notes, document.find(kServoSections[1])};
  insert_all(document, false, search);
  Node* const hinges = find(document, "hinges");
  if (hinges == nullptr) return;
  for (Node& hinge : hinges->items) {
    if (hinge.kind == Node::Kind::map) insert_all(hinge, true, search);
  }
}

}  // namespace gaitlab
