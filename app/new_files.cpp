// The commands `gaitlab new module` and `gaitlab new scenario`, which write a file that is valid as it stands.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "app/chain.h"
#include "app/commands.h"
#include "app/skeletons.h"
#include "app/study/study_text.h"
#include "core/scenario/read_scenario.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"
#include "interchange/urdf_module.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;

struct NewFileArguments {
  std::string name;
  std::optional<std::string> out;   ///< file to write; the default is NAME.yaml
  std::optional<std::string> from;  ///< URDF file; only for modules
  std::string module = "y1";        ///< name of a shipped module type, or a file; only for scenarios
  int count = 4;                    ///< number of modules in the row; only for scenarios
};

/// Checks the name of a module or scenario, which becomes the name of its file.
void check_file_name(const std::string& what, const std::string& name) {
  const SourceLocation place{"gaitlab new " + what};
  if (!is_name(name, "_-") || std::isalpha(static_cast<unsigned char>(name[0])) == 0) {
    throw InputError(place, "name " + in_quotes(name) + " is not allowed; expected letters, digits, _ and -, a letter first");
  }
}

/// A text as YAML, in quotes where it needs them.
std::string yaml_text(const std::string& text) {
  std::string value = print_yaml(text_node(text));
  while (value.ends_with('\n')) value.pop_back();
  return value;
}

/// Writes a new file and returns its name.
std::string write_new(const NewFileArguments& arguments, const std::string& text) {
  const std::string file = arguments.out.value_or(arguments.name + ".yaml");
  check_new(file);
  write_file(file, text, Existing::refused);
  return file;
}

int new_module(const NewFileArguments& arguments) {
  const std::string& name = arguments.name;
  check_file_name("module", name);
  if (shipped_files("module").contains(name)) {
    throw InputError(SourceLocation{"gaitlab new module"},
                     fmt::format("module '{}' comes with the program; choose another name", name));
  }
  std::string text = filled(filled(kSkeletonModule, "@NAME@", name), "@TEXT@", yaml_text(name));
  std::string what = "a module of two bodies and a hinge; replace its numbers by yours";
  if (arguments.from) {
    interchange::UrdfModule made = interchange::module_of_urdf(*arguments.from, name);
    for (const std::string& note : made.notes) say(*arguments.from, "note", "not carried over: " + note);
    text = std::move(made.text);
    what = "the robot of " + *arguments.from + " as a module";
  }
  const std::string file = shell_word(write_new(arguments, text));
  fmt::print("{0}: {1}; next:\n  gaitlab explain module {0}\n", file, what);
  fmt::print("  gaitlab new scenario {0}-walk --module {1}\n  gaitlab run {0}-walk.yaml\n", name, file);
  return 0;
}

/// A module type as the command line names it.
struct NamedModule {
  std::string file;
  bool shipped;
};

NamedModule named_module(const std::string& name) {
  const std::map<std::string, std::string> shipped = shipped_files("module");
  if (const auto known = shipped.find(name); known != shipped.end()) return {known->second, true};
  std::error_code none;
  if (fs::exists(name, none)) return {name, false};
  std::vector<std::string> names;
  for (const auto& [one, path] : shipped) names.push_back(one);
  const std::string near = nearest(name, names);
  throw InputError(SourceLocation{"--module"},
                   "no module " + in_quotes(name) +
                       (near.empty() ? "; expected a name that `gaitlab list module` prints, or a file"
                                     : "; did you mean " + in_quotes(near) + "?"));
}

/// Value of `robot.modules`: the name of a shipped module, or the path of a file from the folder of the scenario.
std::string module_value(const NamedModule& module, const NewFileArguments& arguments) {
  if (module.shipped) return arguments.module;
  const fs::path folder = fs::path(arguments.out.value_or(arguments.name)).parent_path();
  std::error_code none;
  std::string path = fs::relative(module.file, folder.empty() ? fs::path(".") : folder, none).string();
  if (none || path.empty()) path = fs::absolute(module.file).string();
  if (path.find('/') == std::string::npos) path = "./" + path;  // marks the text as a file
  return yaml_text(path);
}

/// Value of a key per joint: `default` for all hinges, and the values of some hinges by their names.
std::string per_hinge(double common, const std::vector<std::pair<std::string, double>>& others) {
  if (others.empty()) return number_text(common);
  std::string text = "{default: " + number_text(common);
  for (const auto& [hinge, value] : others) text += fmt::format(", \"*/{}\": {}", hinge, number_text(value));
  return text + "}";
}

/// Values of the gait that fit the ranges of the hinges.
struct GaitValues {
  std::string amplitude, offset, angles;
};

GaitValues gait_values(const ModuleType& type) {
  constexpr double kAmplitude = 0.4;  // rad
  constexpr double kShare = 0.8;      // of half the range, where it is narrow
  constexpr double kDigits = 1000;    // values are rounded to 0.001 rad
  std::vector<std::pair<std::string, double>> amplitudes, offsets, angles;
  for (const HingeType& hinge : type.hinges) {
    if (hinge.hi == kNoStop || (hinge.lo <= -kAmplitude && hinge.hi >= kAmplitude)) continue;
    const double middle = std::round((hinge.lo + hinge.hi) / 2 * kDigits) / kDigits;
    const double half = std::min(middle - hinge.lo, hinge.hi - middle);
    angles.emplace_back(hinge.name, middle);
    if (hinge.passive) continue;
    offsets.emplace_back(hinge.name, middle);
    amplitudes.emplace_back(hinge.name, std::min(kAmplitude, std::floor(kShare * half * kDigits) / kDigits));
  }
  return {per_hinge(kAmplitude, amplitudes), per_hinge(0, offsets), per_hinge(0, angles)};
}

/// Text of the docks, with a comment on their numbers.
std::string docks_text(const std::vector<Dock>& docks) {
  if (docks.empty()) return "";
  std::string text = "  docks:                   # child face, child module, parent face, parent module, quarter turns\n";
  for (const Dock& dock : docks) {
    text += fmt::format("    - [{}, {}, {}, {}, {}]\n", dock.child_face, dock.child_module, dock.parent_face,
                        dock.parent_module, dock.orientation);
  }
  return text;
}

/// Surroundings of the robot as sections of a scenario, and its base.
struct Surroundings {
  std::string base, ground;
};

/// The ground, or a fixed base for a module that touches nothing.
Surroundings surroundings(const ModuleType& type) {
  if (type.all.empty() && type.feet.empty()) {
    return {"  base: fixed              # the module has no contact elements, so that it would fall\n",
            "ground: {type: none}\ncontact: {on: none}\n"};
  }
  return {"", std::string("ground:\n  friction: 0.8            # coefficient between robot and ground\ncontact:\n") +
                  (type.all.empty()
                       ? "  on: feet                 # the module has elements for feet alone; all: every element\n"
                       : "  on: all                  # every contact element of the module; feet: those of its feet\n")};
}

/// Description of the robot that `docks` make of modules of a type.
std::string robot_text(const std::string& type, const std::vector<Dock>& docks) {
  return docks.empty() ? "one module " + type : fmt::format("{} modules {} in a row", docks.size() + 1, type);
}

/// Checks that a gait can move the module type.
void check_driven(const ModuleType& type, const std::string& file) {
  if (std::ranges::any_of(type.hinges, [](const HingeType& hinge) { return !hinge.passive; })) return;
  throw InputError(SourceLocation{file}, fmt::format("module '{}' has no hinge with a motor, and a gait needs one; dock it to "
                                                     "modules that have one, in the scenario of such a module",
                                                     type.name));
}

int new_scenario(const NewFileArguments& arguments) {
  const std::string& name = arguments.name;
  check_file_name("scenario", name);
  const NamedModule module = named_module(arguments.module);
  Catalog catalog = standard_catalog();
  const Scenario one = read_module(module.file, catalog);
  const ModuleType& type = one.robot->types[0];
  check_driven(type, module.file);
  const std::vector<Dock> docks = chain(one, arguments.count);
  const GaitValues gait = gait_values(type);
  const Surroundings around = surroundings(type);
  const std::pair<const char*, std::string> values[] = {
      {"@NAME@", name},
      {"@TEXT@", yaml_text(name)},
      {"@ROBOT@", robot_text(type.name, docks)},
      {"@FILE@", shell_word(arguments.out.value_or(name + ".yaml"))},
      {"@MODULE@", module_value(module, arguments)},
      {"@DOCKS@", docks_text(docks)},
      {"@BASE@", around.base},
      {"@GROUND@", around.ground},
      {"@INITIAL@", gait.angles == "0" ? "" : "initial: {angles: " + gait.angles + "}   # rad\n\n"},
      {"@AMPLITUDE@", gait.amplitude},
      {"@OFFSET@", gait.offset}};
  std::string text = kSkeletonScenario;
  for (const auto& [mark, value] : values) text = filled(text, mark, value);
  const std::string file = shell_word(write_new(arguments, text));
  fmt::print("{0}: {1}; next:\n  gaitlab check {0} --page {2}.html\n  gaitlab run {0}\n", file, robot_text(type.name, docks),
             name);
  return 0;
}

void add_out(CLI::App& command, NewFileArguments& arguments) {
  command.add_option("--out", arguments.out, "file to write (default: NAME.yaml); must not exist")->check(not_empty);
}

}  // namespace

void add_new_files(Commands& commands, CLI::App& command) {
  add_command<NewFileArguments>(
      commands, "module", "Write a commented module file, to be filled from a data sheet.", new_module,
      [](CLI::App& module, NewFileArguments& arguments) {
        module.add_option("NAME", arguments.name, "name of the module")->required();
        module.add_option("--from", arguments.from, "URDF file of the robot, instead of an example")->check(not_empty);
        add_out(module, arguments);
      },
      &command);
  add_command<NewFileArguments>(
      commands, "scenario", "Write a commented scenario that runs: a wave along modules in a row.", new_scenario,
      [](CLI::App& scenario, NewFileArguments& arguments) {
        scenario.add_option("NAME", arguments.name, "name of the scenario")->required();
        scenario
            .add_option("--module", arguments.module, "name that `gaitlab list module` prints, or a module file (default: y1)")
            ->check(not_empty);
        scenario.add_option("--count", arguments.count, "number of modules in the row (default: 4)")
            ->check(CLI::Range(1, 1000));
        add_out(scenario, arguments);
      },
      &command);
}

}  // namespace gaitlab::app
