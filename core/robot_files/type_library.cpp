#include "core/robot_files/type_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/files/file_kind.h"
#include "core/robot_files/module_file.h"
#include "core/robot_files/servo_file.h"
#include "core/settings/data_folder.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

namespace fs = std::filesystem;

bool is_path(const std::string& text) {
  return text.find('/') != std::string::npos || text.ends_with(".yaml") || text.ends_with(".yml");
}

/// Adds the names of the module type files in a folder.
void add_names(const std::string& folder, std::vector<std::string>& names) {
  std::error_code failure;
  for (const auto& file : fs::directory_iterator(folder, failure)) {
    if (file.path().extension() == ".yaml") names.push_back(file.path().stem().string());
  }
}

/// Name of the shipped type whose file name is that of `path`; "" if there is none.
std::string shipped_name(const std::string& path) {
  const std::string name = fs::path(path).stem().string();
  std::error_code none;
  const bool shipped = path.ends_with(name + ".yaml") && fs::exists(data_folder() + "/modules/" + name + ".yaml", none);
  return shipped ? name : "";
}

std::string file_key(const std::string& path) {
  std::error_code failure;
  const fs::path canonical = fs::canonical(path, failure);
  return "file " + (failure ? path : canonical.string());
}

std::vector<std::string> whole_paths(std::vector<std::string> folders) {
  for (std::string& folder : folders) {
    std::error_code failure;
    const fs::path whole = fs::absolute(folder, failure);
    if (!failure) folder = whole.lexically_normal().string();
  }
  return folders;
}

}  // namespace

bool TypeLibrary::is_inline(const Node& map) {
  return map.find("name") != nullptr || map.find("bodies") != nullptr || map.find("gaitlab_module") != nullptr;
}

void TypeLibrary::define(const Node& types) {
  if (types.kind != Node::Kind::map) {
    problems_.add(types.place, fmt::format("types is {}; expected a map NAME: {{name: ..., bodies: ...}}", found(types)));
    return;
  }
  for (std::size_t i = 0; i < types.keys.size(); ++i) {
    const auto& [name, place] = types.keys[i];
    if (!is_name(name, "_-")) {
      problems_.add(place, "type name " + in_quotes(name) + " is not allowed; expected letters, digits, `_` and `-`");
    }
    defined_[name] = &types.items[i];
  }
}

std::optional<std::size_t> TypeLibrary::find(const Node& node) {
  if (node.kind == Node::Kind::map) {
    const auto [seen, fresh] = inline_.emplace(&node, Index{});
    return fresh ? seen->second = read(node, false, problems_) : seen->second;
  }
  if (node.kind != Node::Kind::scalar) {
    problems_.add(node.place, fmt::format("the module type is {}; expected a name, a file or a map", found(node)));
    return {};
  }
  if (!is_path(node.text)) return find_name(node);
  const std::string path = path_from(folder_, node.text);
  if (const std::string name = shipped_name(node.text); !name.empty() && !fs::exists(path)) {
    if (seen_.emplace("no file " + path, Index{}).second)
      problems_.add(node.place, fmt::format("there is no file '{}'; `modules: {}` names the shipped one", path, name));
    return {};
  }
  return read_file(path, node.place);
}

std::optional<std::size_t> TypeLibrary::find_name(const Node& node) {
  const auto [seen, fresh] = seen_.emplace("name " + node.text, Index{});
  if (!fresh) return seen->second;
  if (const auto defined = defined_.find(node.text); defined != defined_.end()) {
    return seen->second = read(*defined->second, false, problems_);
  }
  const bool is_file_name = is_name(node.text, "_-");
  if (const auto file = is_file_name ? named_file(node.text) : std::nullopt) {
    if (std::string hidden = note_of_hidden(node.text, *file); !hidden.empty())
      notes.push_back({node.place, std::move(hidden)});
    return seen->second = read_file(file->path, node.place);
  }
  std::vector<std::string> known;
  for (const auto& [name, type] : defined_) known.push_back(name);
  for (const std::string& folder : search_folders()) add_names(folder, known);
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  Problem& problem = problems_.add(node.place, "no module type " + in_quotes(node.text) + offer(node.text, known, "types"));
  problem.notes.emplace_back(node.place, "looked in " + joined(whole_paths(search_folders())));
  std::error_code none;
  if (!fs::exists(data_folder(), none)) {
    problem.notes.emplace_back(
        node.place, "the data of the program are missing; GAITLAB_DATA names another folder with modules/ and robots/");
  }
  return {};
}

std::optional<FileOfName> TypeLibrary::named_file(const std::string& name) const {
  std::vector<std::string> own;
  for (const std::string& folder : search_folders()) own.push_back(folder + "/" + name + ".yaml");
  const std::string shipped = std::move(own.back());
  own.pop_back();
  const std::string beside = path_from(folder_, name + ".yaml");  // may be the scenario itself
  if (kind_of_file(beside) == FileKind::module) own.push_back(beside);
  return file_of_name(own, shipped);
}

std::optional<std::size_t> TypeLibrary::read_file(const std::string& path, const SourceLocation& asked_at) {
  const auto [seen, fresh] = seen_.emplace(file_key(path), Index{});
  if (!fresh) return seen->second;
  Problems found;
  try {
    expect_kind(path, FileKind::module);
    const std::optional<Node> document = parse_yaml(read_text(path, asked_at), path, found);
    if (document) seen->second = read(*document, true, found);
  } catch (const InputError& e) {
    add_all(e, found);
  }
  add_found(found, {path, folder_, "module file", "gaitlab_module"}, problems_);
  return seen->second;
}

std::optional<std::size_t> TypeLibrary::read(const Node& document, bool versioned, Problems& problems) {
  const std::size_t before = problems.size();
  Node whole = document;
  insert_servos(whole, folder_, problems, notes);
  ModuleType type = read_module(whole, versioned, problems);
  if (problems.size() != before) return {};
  types.push_back(std::move(type));
  documents.push_back(std::move(whole));
  return types.size() - 1;
}

std::vector<std::string> TypeLibrary::search_folders() const {
  std::vector<std::string> folders{path_from(folder_, "modules"), path_from(folder_, "../modules")};
  folders.push_back(data_folder() + "/modules");
  return folders;
}

}  // namespace gaitlab
