#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "app/new/skeletons.h"
#include "app/shell/commands.h"
#include "core/files/atomic_file.h"
#include "core/settings/data_folder.h"
#include "core/settings/wording.h"

namespace gaitlab::app {

namespace {

struct NewPluginArguments {
  std::string kind, name;          ///< cpg, controller or actuator; type name of the plugin in scenarios
  std::optional<std::string> out;  ///< folder to create; the default is the name
};

namespace fs = std::filesystem;

const Skeleton& skeleton(const std::string& kind) {
  for (const Skeleton& one : kSkeletons) {
    if (kind == word(one.kind)) return one;
  }
  throw InputError(SourceLocation{"gaitlab new plugin"},
                   "unknown kind " + in_quotes(kind) + offer(kind, {"cpg", "controller", "actuator"}, "kinds"));
}

/// Checks the name, which becomes a file name, a CMake target and part of a class name.
void check_name(const Skeleton& skeleton, const std::string& name) {
  constexpr std::array kTargets{"all", "clean", "depend", "help", "install", "package", "test"};  // CMake's own targets
  const SourceLocation place{fmt::format("gaitlab new plugin {}", word(skeleton.kind))};
  if (!is_name(name, "_") || name[0] == '_' || std::isdigit(static_cast<unsigned char>(name[0])) != 0) {
    throw InputError(place, "name " + in_quotes(name) +
                                " is not allowed; expected letters, digits and `_`, beginning with a "
                                "letter");
  }
  if (std::find(kTargets.begin(), kTargets.end(), name) != kTargets.end()) {
    throw InputError(place, fmt::format("name '{}' is a target of CMake; choose another", name));
  }
  if (standard_catalog().find(skeleton.kind, name) != nullptr) {
    throw InputError(place, fmt::format("{} '{}' is built in, and a name can be registered once; choose another",
                                        word(skeleton.kind), name));
  }
}

/// Class name of a plugin: `MyWaveCpg` for the name `my_wave` and the kind `cpg`.
std::string class_name(const std::string& name, const std::string& kind) {
  std::string out;
  bool capital = true;
  for (const char c : fmt::format("{}_{}", name, kind)) {
    if (c != '_') out += capital ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    capital = c == '_';
  }
  return out;
}

/// A folder that gets its name only when it is complete, and is removed on failure.
class NewFolder {
 public:
  explicit NewFolder(const std::string& name) : name_(name), folder_(fs::path(name).lexically_normal()) {
    if (!folder_.has_filename()) folder_ = folder_.parent_path();
    std::error_code error;
    if (fs::exists(fs::symlink_status(folder_, error))) refuse(EEXIST);
    const fs::path beside = folder_.has_parent_path() ? folder_.parent_path() : ".";
    fs::create_directories(beside, error);
    if (error) refuse(error.value());
    std::string part = (beside / ("." + folder_.filename().string() + ".XXXXXX")).string();
    if (::mkdtemp(part.data()) == nullptr) refuse(errno);
    part_ = part;
    constexpr auto kOthers = fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read | fs::perms::others_exec;
    fs::permissions(part_, kOthers, fs::perm_options::add, error);
  }
  ~NewFolder() {
    std::error_code none;
    if (!part_.empty()) fs::remove_all(part_, none);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Path of the folder before commit().
  [[nodiscard]] const fs::path& part() const { return part_; }
  fs::path commit() {
    if (const int error = rename_new(part_, folder_); error != 0) refuse(error);
    part_.clear();
    return folder_;
  }

 private:
  [[noreturn]] void refuse(int error) const {
    throw InputError(SourceLocation{name_}, error == EEXIST ? "exists; nothing was written"
                                                            : "cannot be made: " + std::generic_category().message(error));
  }

  std::string name_;
  fs::path folder_, part_;
};

/// Installation prefix of the running program, or empty if it is not installed.
std::string prefix() {
  std::error_code none;
  const fs::path prefix = installation_prefix();
  return fs::is_directory(prefix / "include" / "gaitlab", none) ? prefix.string() : "PREFIX";
}

int new_plugin(const NewPluginArguments& arguments) {
  const Skeleton& text = skeleton(arguments.kind);
  const std::string& name = arguments.name;
  check_name(text, name);
  NewFolder made(arguments.out.value_or(name));
  const auto write = [&](const std::string& file, const std::string& content) {
    write_file(made.part() / file, filled(filled(content, "@NAME@", name), "@CLASS@", class_name(name, arguments.kind)));
  };
  write("CMakeLists.txt", kSkeletonBuild);
  write(name + ".cpp", text.code);
  write("scenario.yaml", text.scenario);
  write("test.cmake", filled(kSkeletonTest, "@TEST@", text.test));
  const fs::path folder = made.commit();
  fmt::print("{0}: CMakeLists.txt, {1}.cpp, scenario.yaml, test.cmake; next:\n  cd {0}\n", folder.string(), name);
  fmt::print("  cmake -B build -DCMAKE_PREFIX_PATH={}{}\n", prefix(),
             prefix() == "PREFIX" ? "      # where gaitlab is installed: cmake --install build/release --prefix PREFIX" : "");
  fmt::print("  cmake --build build\n  ctest --test-dir build\n  gaitlab run scenario.yaml\n");
  return 0;
}

}  // namespace

void add_new(Commands& commands) {
  CLI::App* command = commands.app.add_subcommand("new", "Write a new module, scenario or plugin, or the bench of a servo.");
  command->require_subcommand(1);
  add_command<NewPluginArguments>(
      commands, "plugin", "Make a folder with a working plugin, its scenario and its test.", new_plugin,
      [](CLI::App& plugin, NewPluginArguments& arguments) {
        plugin.add_option("KIND", arguments.kind, "cpg, controller or actuator")->required();
        plugin.add_option("NAME", arguments.name, "name by which scenarios select it")->required();
        plugin.add_option("--out", arguments.out, "folder to make (default: NAME); must not exist");
      },
      command);
  add_new_files(commands, *command);
  add_new_log(commands, *command);
}

}  // namespace gaitlab::app
