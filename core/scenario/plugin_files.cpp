#include "core/scenario/plugin_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/files/hash.h"
#include "core/settings/reader.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

namespace fs = std::filesystem;

/// An entry of `plugins` as written by the user.
struct PluginEntry {
  std::string path, hash;

  void fields(Fields& f) {
    f.text("path", path, "The library.");
    f.text("hash", hash, "FNV-1a hash of the file; a file with another hash is refused.");
  }
};

/// Reads an entry. `place` becomes the place of the path. Returns false, with a problem, if the entry is invalid.
bool read_entry(const Node& node, PluginEntry& entry, SourceLocation& place, Problems& problems) {
  const std::size_t before = problems.size();
  place = node.place;
  if (node.kind == Node::Kind::map) {
    Reader reader(node, "plugin", problems, nullptr);
    entry.fields(reader);
    reader.require({"path"});
    reader.finish();
    if (const Node* path = node.find("path")) place = path->place;
  } else if (node.kind == Node::Kind::scalar) {
    entry.path = node.text;
  } else {
    problems.add(node.place, fmt::format("plugin is {}; expected a path or {{path, hash}}", found(node)));
  }
  return problems.size() == before;
}

/// Paths of the libraries that the catalog has loaded or may load because the command line names them.
std::vector<std::string> named_libraries(const Catalog& catalog) {
  std::vector<std::string> paths(catalog.trust().files.begin(), catalog.trust().files.end());
  for (const PluginKind& kind : kPluginKinds) {
    for (const std::string& name : catalog.names(kind.kind)) {
      const std::string path(catalog.find(kind.kind, name)->origin);
      if (path != kBuiltIn && std::ranges::find(paths, path) == paths.end()) paths.push_back(path);
    }
  }
  return paths;
}

void load(const PluginEntry& entry, const SourceLocation& place, const std::string& folder, Catalog& catalog,
          std::vector<PluginFile>& files, Problems& problems) {
  const std::string path = plugin_path({entry.path, entry.hash}, folder, catalog);
  std::error_code failure;
  const fs::path canonical = fs::canonical(path, failure);
  if (failure || !fs::is_regular_file(canonical, failure)) {
    const std::string why = failure ? failure.message() : "not a regular file";
    problems.add(place,
                 fmt::format("plugin '{}' cannot be loaded: {} (tried '{}'{})", one_line(entry.path), why,
                             fs::absolute(path).lexically_normal().string(),
                             entry.hash.empty() ? ""
                                                : "; a record contains only the plugin's name, so that --plugin must give "
                                                  "the file"));
    return;
  }
  if (const PluginTrust& trust = catalog.trust(); !trust.all && !trust.files.contains(canonical.string())) {
    problems.add(place, fmt::format("plugin '{}' is foreign code and is not loaded; {}", one_line(entry.path), trust.remedy));
    return;
  }
  const std::string hash = file_hash(canonical.string());
  if (hash.empty()) {
    problems.add(place,
                 fmt::format("plugin '{}' cannot be read, or has more than {} MB", one_line(entry.path), kMostPage >> 20U));
    return;
  }
  if (!entry.hash.empty() && entry.hash != hash) {
    problems.add(place, fmt::format("plugin '{}' is not the recorded file: its hash is {}, but {} is recorded",
                                    one_line(entry.path), hash, clipped(entry.hash)));
    return;
  }
  if (!read_start(canonical, 4)
           .starts_with("\x7F"
                        "ELF")) {
    problems.add(place, fmt::format("plugin '{}' is not a library (.so)", one_line(entry.path)));
    return;
  }
  try {
    load_plugin(canonical.string(), hash, catalog);
    files.push_back({canonical.string(), hash});
  } catch (const std::exception& e) {
    problems.add(place, fmt::format("plugin '{}' cannot be loaded: {}", one_line(entry.path), e.what()));
  }
}

}  // namespace

std::string file_hash(const std::string& path) {
  try {
    return hash(read_file(path, kMostPage));
  } catch (const InputError&) {
    return {};
  }
}

std::string plugin_path(const PluginFile& file, const std::string& folder, const Catalog& catalog) {
  const std::string own = path_from(folder, file.path);
  std::vector<std::string> paths;
  for (std::string& path : named_libraries(catalog)) {
    if (fs::path(path).filename() == fs::path(file.path).filename()) paths.push_back(std::move(path));
  }
  paths.push_back(own);
  const auto same = std::ranges::find_if(paths, [&](const std::string& path) { return file_hash(path) == file.hash; });
  if (!file.hash.empty() && same != paths.end()) return *same;
  std::error_code none;
  return fs::exists(own, none) ? own : paths.front();
}

std::vector<PluginFile> read_plugins(const Node& node, const std::string& folder, Catalog& catalog, Problems& problems) {
  std::vector<PluginFile> files;
  if (node.kind != Node::Kind::list) {
    problems.add(node.place, fmt::format("plugins is {}; expected a list of paths", found(node)));
    return files;
  }
  for (const Node& item : node.items) {
    PluginEntry entry;
    SourceLocation place;
    if (read_entry(item, entry, place, problems)) load(entry, place, folder, catalog, files, problems);
  }
  return files;
}

void load_plugin_file(const std::string& path, Catalog& catalog) {
  Problems problems;
  std::vector<PluginFile> files;
  load({path, {}}, SourceLocation{path}, ".", catalog, files, problems);
  problems.raise();
}

std::string hidden_file(const Node& section, const std::string& folder) {
  if (section.kind == Node::Kind::scalar) {
    const std::string path = path_from(folder, section.text);
    std::error_code none;
    const bool file = section.text.find('\n') == std::string::npos && std::filesystem::is_regular_file(path, none);
    return file && !may_quote(path, folder) ? path : "";
  }
  for (const Node& item : section.items) {
    if (std::string found = hidden_file(item, folder); !found.empty()) return found;
  }
  return {};
}

}  // namespace gaitlab
