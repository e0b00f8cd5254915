#include "kit/shipped.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/errors.h"
#include "core/settings/data_folder.h"
#include "core/settings/wording.h"

namespace gaitlab::kit {

namespace {

namespace fs = std::filesystem;

/// Folders of the data, and ending of the files in them, by kind.
struct ShippedKind {
  const char* kind;
  std::array<const char*, 2> folders;
  const char* ending;
};
constexpr ShippedKind kShipped[] = {{"module", {"modules", nullptr}, ".yaml"},
                                    {"robot", {"robots", nullptr}, ".dat"},
                                    {"scenario", {".", "library"}, ".yaml"},
                                    {"study", {"studies", nullptr}, ".yaml"}};

}  // namespace

std::map<std::string, std::string> shipped_files(const std::string& kind) {
  std::map<std::string, std::string> files;
  const ShippedKind& shipped = *std::ranges::find(kShipped, kind, &ShippedKind::kind);
  for (const char* folder : shipped.folders) {
    if (folder == nullptr) continue;
    std::error_code none;  // an installation without data has an empty list
    for (const auto& file : fs::directory_iterator((fs::path(data_folder()) / folder).lexically_normal(), none)) {
      if (file.path().extension() == shipped.ending)
        files[file.path().stem().string()] = file.path().lexically_normal().string();
    }
  }
  return files;
}

std::string named_file(const std::string& word) {
  std::error_code none;
  if (word.empty() || fs::exists(word, none) || word.find('/') != std::string::npos) return word;
  std::vector<std::string> known;
  for (const char* kind : {"scenario", "study"}) {
    const std::map<std::string, std::string> files = shipped_files(kind);
    if (const auto file = files.find(word); file != files.end()) return file->second;
    for (const auto& [name, path] : files) known.push_back(name);
  }
  const std::string name = fs::path(word).stem().string();
  const bool bare = name == word || word == name + ".yaml";
  if (bare && shipped_files("module").contains(name)) {
    throw InputError(
        SourceLocation{word},
        fmt::format("this is a module type, not a scenario; make one of it with gaitlab new scenario NAME --module {}", name));
  }
  if ((name == word || word == name + ".dat") && shipped_files("robot").contains(name)) {
    throw InputError(SourceLocation{word},
                     fmt::format("this is a build file, not a scenario; name it in a scenario, robot: {{build: {}}}", name));
  }
  const std::string near =
      bare && std::ranges::find(known, name) != known.end() ? name : nearest(word.ends_with(".yaml") ? name : word, known);
  if (near.empty()) return word;
  throw InputError(SourceLocation{word}, "there is no such file; did you mean " + in_quotes(near) +
                                             ", which comes with gaitlab (gaitlab list scenarios)?");
}

}  // namespace gaitlab::kit
