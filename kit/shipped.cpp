#include "kit/shipped.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/errors.h"
#include "core/files/file_kind.h"
#include "core/settings/shipped_files.h"
#include "core/settings/wording.h"

namespace gaitlab::kit {

namespace fs = std::filesystem;

namespace {

enum class Folders { none, runs, all };

/// Path for a word that names both a file or folder and a shipped scenario or study. Prints a note on the choice.
std::string one_of_two(const std::string& word, const std::string& shipped, Folders taken) {
  std::error_code none;
  const bool folder = fs::is_directory(word, none);
  const bool own = !folder || taken == Folders::all || (taken == Folders::runs && kind_of_file(word) == FileKind::run);
  say(word, "note",
      own ? fmt::format("{} is the {} './{}', not the one of that name that comes with gaitlab", in_quotes(word),
                        folder ? "folder" : "file", word)
          : fmt::format("{} is the one that comes with gaitlab; the folder of that name is not a scenario", in_quotes(word)));
  return own ? word : shipped;
}

std::string named(const std::string& word, Folders taken) {
  std::error_code none;
  if (word.empty() || word.find('/') != std::string::npos) return word;
  std::vector<std::string> known;
  std::string shipped;
  for (const char* kind : {"scenario", "study"}) {
    for (const auto& [name, path] : shipped_files(kind)) {
      known.push_back(name);
      if (name == word && shipped.empty()) shipped = path;
    }
  }
  if (fs::exists(word, none)) return shipped.empty() ? word : one_of_two(word, shipped, taken);
  if (!shipped.empty()) return shipped;
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

}  // namespace

std::string named_file(const std::string& word) { return named(word, Folders::none); }
std::string named_file_or_run(const std::string& word) { return named(word, Folders::runs); }
std::string named_file_or_folder(const std::string& word) { return named(word, Folders::all); }

}  // namespace gaitlab::kit
