#include "core/scenario/robot_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/files/file_kind.h"
#include "core/robot_files/build_file.h"
#include "core/robot_files/type_library.h"
#include "core/scenario/plugin_files.h"
#include "core/settings/data_folder.h"
#include "core/settings/file_of_name.h"
#include "core/settings/text_file.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"

namespace gaitlab {
namespace {

/// A build file, or a robot by its name as in `gaitlab list robot`. The name means a file beside the scenario or in a folder
/// robots/ beside it, or else the shipped file.
FileOfName build_file(const std::string& folder, const std::string& name) {
  const std::string path = path_from(folder, name);
  if (name.find_first_of("/.") != std::string::npos) return {path};
  std::vector<std::string> own{path};
  for (const char* robots : {".", "robots", "../robots"})
    own.push_back(path_from(folder, fmt::format("{}/{}.dat", robots, name)));
  return file_of_name(own, data_folder() + "/robots/" + name + ".dat").value_or(FileOfName{path});
}

/// Largest number of bodies of a robot. `gaitlab check` takes 55 kB and 1 ms per body, which is 2 GB and 40 s for this number.
constexpr std::size_t kMostBodies = 40000;

std::vector<Dock> read_connections(Reader& reader, const std::string& folder, std::vector<Problem>& notes, Problems& problems) {
  const Node* build = reader.take("build");
  const Node* docks = reader.take("docks");
  if (build != nullptr && docks != nullptr) {
    problems.add(build->place, "robot has both build and docks; expected one")
        .notes.emplace_back(docks->place, "docks is here");
    return {};
  }
  if (docks != nullptr) return read_docks(*docks, problems);
  if (build == nullptr) return {};
  const Reading<std::string> name = read_scalar(*build);
  if (!name.ok()) {
    problems.add(build->place, fmt::format("build is {}; expected a build file", found(*build)));
    return {};
  }
  const FileOfName file = build_file(folder, name.value);
  const std::string& path = file.path;
  if (std::string hidden = note_of_hidden(name.value, file); !hidden.empty())
    notes.push_back({build->place, std::move(hidden)});
  const std::string stem = std::filesystem::path(name.value).stem().string();
  std::error_code none;
  if (name.value.ends_with(".dat") && !std::filesystem::exists(path, none)) {
    const bool shipped = std::filesystem::exists(fmt::format("{}/robots/{}.dat", data_folder(), stem), none);
    if (shipped) {
      problems.add(build->place, fmt::format("there is no file '{}'; `build: {}` names the shipped one", path, stem));
      return {};
    }
  }
  std::vector<Dock> rows;
  Problems found;
  try {
    expect_kind(path, FileKind::robot);
    const std::string text = read_text(path, build->place);
    check_text(text, path);
    rows = read_build(text, path, found);
  } catch (const InputError& e) {
    add_all(e, found);
  }
  add_found(found, {path, folder, "build file", ""}, problems);
  return rows;
}

std::size_t module_count(const std::vector<Dock>& docks) {
  int highest = 0;
  for (const Dock& dock : docks) highest = std::max({highest, dock.child_module, dock.parent_module});
  return static_cast<std::size_t>(highest) + 1;
}

/// Type of each module. `modules` is a single type for all modules, or a map of types by module number.
class TypeChoice {
 public:
  TypeChoice(const Node& modules, std::size_t count, TypeLibrary& library, Problems& problems)
      : modules_(modules), count_(count), library_(library), problems_(problems) {}

  std::vector<std::size_t> read() {
    if (modules_.kind == Node::Kind::map && !TypeLibrary::is_inline(modules_)) {
      read_numbers();
    } else {
      default_ = &modules_;
    }
    std::vector<std::size_t> types;
    for (std::size_t i = 0; i < count_; ++i) {
      const auto own = own_.find(i);
      const Node* node = own == own_.end() ? default_ : own->second;
      if (node == nullptr) {
        missing(i);
        break;
      }
      if (const std::optional<std::size_t> type = library_.find(*node)) types.push_back(*type);
    }
    if (default_ != nullptr) library_.find(*default_);  // the default is checked even if no module uses it
    return types;
  }

 private:
  void read_numbers() {
    for (std::size_t i = 0; i < modules_.keys.size(); ++i) {
      const auto& [key, place] = modules_.keys[i];
      if (key == "default") {
        default_ = &modules_.items[i];
        continue;
      }
      Node number{Node::Kind::scalar, place};
      number.text = key;
      const Reading<std::int64_t> module = read_integer(number);
      if (!module.ok() || module.value < 0) {
        problems_.add(
            {place, "unknown key " + in_quotes(key) + " in modules; expected the number of a module, or `default`", {}, key});
      } else if (static_cast<std::size_t>(module.value) >= count_) {
        problems_.add(place, fmt::format("there is no module {}; the robot has {}", module.value,
                                         count_ == 1 ? "only module 0" : fmt::format("modules 0 to {}", count_ - 1)));
      } else {
        own_[static_cast<std::size_t>(module.value)] = &modules_.items[i];
      }
    }
  }

  void missing(std::size_t module) {
    problems_.add(modules_.place, fmt::format("modules has no type for module {}; add it, or default: TYPE", module));
  }

  const Node& modules_;
  std::size_t count_;
  TypeLibrary& library_;
  Problems& problems_;
  const Node* default_ = nullptr;
  std::map<std::size_t, const Node*> own_;
};

/// Keeps the types that modules use, in the order of first use, and renumbers them.
void keep_used(TypeLibrary& library, std::vector<std::size_t>& type_of_module) {
  std::vector<ModuleType> types;
  std::vector<Node> documents;
  std::map<std::size_t, std::size_t> index;
  for (std::size_t& type : type_of_module) {
    const auto [number, fresh] = index.emplace(type, types.size());
    if (fresh) {
      types.push_back(library.types[type]);
      documents.push_back(library.documents[type]);
    }
    type = number->second;
  }
  library.types = std::move(types);
  library.documents = std::move(documents);
}

bool too_large(const TypeLibrary& library, const std::vector<std::size_t>& type_of_module, const SourceLocation& place,
               Problems& problems) {
  std::size_t bodies = 0;
  for (const std::size_t type : type_of_module) bodies += library.types[type].bodies.size();
  if (bodies > kMostBodies) {
    problems.add(place,
                 fmt::format("the robot has {} bodies; expected at most {}, which take 2 GB of memory", bodies, kMostBodies));
  }
  return bodies > kMostBodies;
}

/// A unique name for each type. Types with equal names get numbers.
std::vector<std::string> unique_names(const Robot& robot) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const ModuleType& type : robot.types) {
    std::string name = type.name;
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}-{}", type.name, i);
    names.push_back(name);
  }
  return names;
}

Node modules_node(const Robot& robot, const std::vector<std::string>& names) {
  const std::size_t common = robot.modules[0].type;
  if (names.size() == 1) return scalar_node(names[common]);
  Node node{Node::Kind::map};
  node.flow = true;
  const auto add = [&](const std::string& key, std::size_t type) {
    node.keys.emplace_back(key, SourceLocation{});
    node.items.push_back(scalar_node(names[type]));
  };
  add("default", common);
  for (std::size_t i = 0; i < robot.modules.size(); ++i) {
    if (robot.modules[i].type != common) add(std::to_string(i), robot.modules[i].type);
  }
  return node;
}

Node docks_node(const Robot& robot) {
  Node node{Node::Kind::list};
  for (const Module& module : robot.modules) {
    if (module.parent < 0) continue;
    const Dock& d = module.dock;
    Node row{Node::Kind::list};
    row.flow = true;
    for (const int number : {d.child_face, d.child_module, d.parent_face, d.parent_module, d.orientation}) {
      row.items.push_back(scalar_node(std::to_string(number)));
    }
    node.items.push_back(std::move(row));
  }
  node.flow = node.items.empty();
  return node;
}

}  // namespace

RobotParts read_robot(Reader& reader, const SourceLocation& place, const std::string& folder, Problems& problems) {
  const std::size_t before = problems.size();
  RobotParts parts;
  TypeLibrary library(folder, problems);
  if (const Node* types = reader.take("types")) library.define(*types);
  const std::vector<Dock> docks = read_connections(reader, folder, parts.notes, problems);
  // The rows determine the number of modules. After a wrong row, every module number could therefore seem wrong.
  const bool counted = problems.size() == before;
  Node reference{Node::Kind::scalar, place};
  reference.text = kDefaultType;
  const Node* modules = reader.take("modules");
  if (modules == nullptr && reader.misspelt("modules")) return parts;  // the docks would be faulty for the default type
  if (modules == nullptr) modules = &reference;
  if (!counted) {
    if (modules->kind == Node::Kind::scalar) library.find(*modules);
    return parts;
  }
  std::vector<std::size_t> type_of_module = TypeChoice(*modules, module_count(docks), library, problems).read();
  if (problems.size() != before || too_large(library, type_of_module, place, problems)) return parts;
  keep_used(library, type_of_module);
  try {
    parts.robot = std::make_shared<const Robot>(assemble(std::move(library.types), type_of_module, docks));
    parts.documents = std::move(library.documents);
    parts.notes.insert(parts.notes.end(), library.notes.begin(), library.notes.end());
  } catch (const InputError& e) {
    add_all(e, problems);
  }
  return parts;
}

std::vector<std::pair<std::string, Node>> robot_nodes(const Robot& robot, const std::vector<Node>& documents) {
  const std::vector<std::string> names = unique_names(robot);
  Node types{Node::Kind::map};
  for (std::size_t i = 0; i < names.size(); ++i) {
    types.keys.emplace_back(names[i], SourceLocation{});
    types.items.push_back(documents[i]);
  }
  return {{"types", std::move(types)}, {"modules", modules_node(robot, names)}, {"docks", docks_node(robot)}};
}

std::string scenario_of_module(const std::string& path) {
  expect_kind(path, FileKind::module);
  static_cast<void>(read_text(path));  // reports a file that cannot be read here, not at a place in the text below
  Node file{Node::Kind::scalar};
  file.text = path.find('/') == std::string::npos ? "./" + path : path;  // marks the text as a file
  file.quoted = true;
  return "gaitlab: 1\nname: module\nduration: 1\nground: {type: none}\ncontact: {on: none}\nrobot:\n  modules: " +
         print_yaml(file);
}

}  // namespace gaitlab
