// The commands `gaitlab new module` and `gaitlab new scenario`, which write a file that is valid as it stands, and `gaitlab new
// bench`, whose logs are still to be recorded.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

#include "app/gait/run_time.h"
#include "app/new/chain.h"
#include "app/new/leg_values.h"
#include "app/new/module_values.h"
#include "app/new/scenario_values.h"
#include "app/new/skeletons.h"
#include "app/shell/commands.h"
#include "core/robot_files/module_file.h"
#include "core/robot_files/servo_file.h"
#include "core/robot_files/type_library.h"
#include "core/scenario/read_scenario.h"
#include "core/settings/shell_word.h"
#include "core/settings/shipped_files.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"
#include "core/simulation/simulation.h"
#include "interchange/robot_module.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;

struct NewFileArguments {
  std::string name;
  std::optional<std::string> out;   ///< file to write; the default is NAME.yaml
  std::optional<std::string> from;  ///< URDF or MJCF file; only for modules
  interchange::ImportOptions options;
  std::string module = "y1";        ///< name of a shipped module type, or a file; only for scenarios
  std::optional<int> count = {};    ///< number of modules in the row; only for scenarios
  std::string servo;                ///< name or file of a servo; only for benches
  double mass = 0.3, length = 0.1;  ///< of the arm, kg and m; only for benches
};

/// Writes a new file and returns its name.
std::string write_new(const NewFileArguments& arguments, const std::string& text) {
  std::string file = arguments.out.value_or(arguments.name + ".yaml");
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
  bool driven = true;
  std::size_t changes = 0;
  if (arguments.from) {
    interchange::RobotModule made = interchange::module_of_robot(*arguments.from, name, arguments.options);
    for (const interchange::RobotNote& note : made.notes) say(to_string(note.place), "note", note.kind() + (": " + note.text));
    changes = static_cast<std::size_t>(std::ranges::count(made.notes, true, &interchange::RobotNote::changed));
    const OverlapKey overlap = overlap_key(made);
    if (!overlap.note.empty()) say(*arguments.from, "note", overlap.note);
    text = made.text + overlap.text;
    what = "the robot of " + *arguments.from + " as a module";
    driven = made.driven;
  }
  const std::string file = write_new(arguments, text);
  fmt::print("{0}: {1}; next:\n  gaitlab explain module {0}\n", shell_word(file), what);
  if (driven) {
    fmt::print("  gaitlab new scenario {0}-walk --module {1}\n  gaitlab run {0}-walk.yaml\n", name, shell_word(file));
  } else {
    fmt::print(
        "No hinge has a motor, so that no gait moves the module. To let it fall:\n  echo {1} > {0}-fall.yaml\n  gaitlab run "
        "{0}-fall.yaml\n",
        name, shell_word(fall_text(file)));
  }
  if (changes > 0) fmt::print("{}; read the head of {}\n", counted(changes, "change"), shell_word(file));
  return 0;
}

/// A module type that the command line names.
struct NamedModule {
  std::string file;
  bool by_name;  ///< a scenario takes its name; else the path of the file
};

/// Folder of the new scenario.
fs::path folder_of(const NewFileArguments& arguments) {
  const fs::path folder = fs::path(arguments.out.value_or(arguments.name)).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

/// The module type, sought in the order that applies to every name: a file of that name, one that the scenario would find, the
/// shipped one.
NamedModule named_module(const NewFileArguments& arguments) {
  const std::string& name = arguments.module;
  const std::map<std::string, std::string> shipped = shipped_files("module");
  const auto known = shipped.find(name);
  std::error_code none;
  const bool file = fs::exists(name, none) && !fs::is_directory(name, none);
  if (file && known != shipped.end())
    say(name, "note", fmt::format("'{0}' is the file './{0}', not the module type that comes with gaitlab", name));
  if (file) return {name, false};
  if (known != shipped.end()) {
    Problems problems;
    const TypeLibrary library(folder_of(arguments).string(), problems);
    const FileOfName found = library.named_file(name).value_or(FileOfName{known->second});
    if (const std::string hidden = note_of_hidden(name, found); !hidden.empty()) say("--module", "note", hidden);
    return {found.path, true};
  }
  std::vector<std::string> names;
  for (const auto& [one, path] : shipped) names.push_back(one);
  const std::string near = nearest(name, names);
  throw InputError(SourceLocation{"--module"},
                   "no module " + in_quotes(name) +
                       (near.empty() ? "; expected a name that `gaitlab list module` prints, or a file"
                                     : "; did you mean " + in_quotes(near) + "?"));
}

/// Value of `robot.modules`: the name of a shipped module, or the path of a file relative to the folder of the scenario.
std::string module_value(const NamedModule& module, const NewFileArguments& arguments) {
  if (module.by_name) return arguments.module;
  std::error_code none;
  std::string path = fs::relative(module.file, folder_of(arguments), none).string();
  if (none || path.empty()) path = fs::absolute(module.file).string();
  if (path.find('/') == std::string::npos) path = "./" + path;  // marks the text as a file
  return yaml_text(path);
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

/// Description of a robot of modules of one type, connected by `docks`, on one line.
std::string robot_text(const std::string& name, const std::vector<Dock>& docks) {
  const std::string type = one_line(name);
  return docks.empty() ? "one module " + type : fmt::format("{} modules {} in a row", docks.size() + 1, type);
}

/// Checks that a gait can move the module type.
void check_driven(const ModuleType& type, const std::string& file) {
  if (std::ranges::any_of(type.hinges, [](const HingeType& hinge) { return !hinge.passive; })) return;
  throw InputError(
      SourceLocation{file},
      fmt::format(
          "module '{}' has no hinge with a motor, but a gait needs one; dock it to modules that have one, in their scenario",
          type.name));
}

/// The robot of a new scenario: a row of modules of one type.
struct NewRobot {
  NamedModule module;
  Scenario one;  ///< of one module
  std::vector<Dock> docks;
  [[nodiscard]] const ModuleType& type() const { return one.robot->types[0]; }
};

NewRobot new_robot(const NewFileArguments& arguments, Catalog& catalog) {
  constexpr int kMost = 4;  // number of modules, if the user gives none
  NewRobot robot{named_module(arguments), {}, {}};
  robot.one = read_module(robot.module.file, catalog);
  check_driven(robot.type(), robot.module.file);
  robot.docks = chain(robot.one, arguments.count.value_or(modules_carried(robot.one, kMost)));
  return robot;
}

/// A gait to try: its share of the largest amplitude or stride, and the accuracy of its torques.
struct Draft {
  double share = 1, accuracy = 0.001;
};

/// Text of the scenario with a gait, and `promise` at its head.
std::string scenario_text(const NewFileArguments& arguments, const NewRobot& robot, const Draft& draft,
                          const std::string& promise) {
  const double share = draft.share;
  constexpr double kAmplitude = 0.4;  // rad
  const GaitValues gait = gait_values(robot.one, share * kAmplitude);
  const std::optional<LegValues> legs = robot.docks.empty() ? leg_values(robot.one, share) : std::nullopt;
  const Surroundings around = surroundings(robot.type(), static_cast<int>(robot.docks.size()) + 1);
  const std::pair<const char*, std::string> values[] = {
      {"@NAME@", arguments.name},
      {"@TEXT@", yaml_text(arguments.name)},
      {"@WHAT@", legs ? legs->what + " of" : "a wave along"},
      {"@CHANGE@", legs ? "frequency and stride" : "the robot (docks), then frequency, amplitude and phase_lag"},
      {"@ROBOT@", legs ? one_line(robot.type().name) : robot_text(robot.type().name, robot.docks)},
      {"@PROMISE@", one_line(promise)},
      {"@FILE@", one_line(shell_word(arguments.out.value_or(arguments.name + ".yaml")))},
      {"@MODULE@", module_value(robot.module, arguments)},
      {"@DOCKS@", docks_text(robot.docks)},
      {"@BASE@", around.base},
      {"@GROUND@", around.ground},
      {"@INITIAL@", legs || gait.angles == "0" ? "" : "initial: {angles: " + gait.angles + "}   # rad\n\n"},
      {"@CONTROLLER@", legs ? legs->controller : ""},
      {"@CPG@", legs ? legs->cpg : kSkeletonWave},
      {"@FREQUENCY@", gait.frequency},
      {"@AMPLITUDE@", gait.amplitude},
      {"@OFFSET@", gait.offset},
      {"@PERIODS@", legs ? "two periods to start, and four that are judged" : "a period to start, and three that are judged"},
      {"@ACCURACY@", number_text(draft.accuracy)},
      {"@DURATION@", legs ? legs->duration : gait.duration}};
  std::string text = kSkeletonScenario;
  for (const auto& [mark, value] : values) text = filled(text, mark, value);
  return text;
}

/// The reason why the scenario in the file is not feasible; empty if it is feasible. Nothing if a run would take long.
std::optional<std::string> shortfall(const std::string& file, Catalog& catalog) try {
  constexpr double kLong = 3;  // s, of one of three runs
  const Scenario s = read_scenario(file, {}, catalog);
  if (estimated_seconds(s) > kLong) return {};
  Simulation simulation({&s, 1});
  simulation.run();
  const Recording recording = simulation.take_recording(0);
  const report::Summary summary = report::summarise(s, recording, 0);
  const report::Verdict verdict = report::verdict(s, recording, summary, report::overlaps(s, recording));
  return verdict.word == Word::feasible ? "" : fmt::format("{}: {}", name_of(verdict.word), verdict.why());
} catch (const InputError& error) {
  return error.problems().front().text;
}

/// Writes the scenario with the largest feasible one of some gaits. If none is feasible, the first remains, and the file
/// states the reason.
std::string write_scenario(const NewFileArguments& arguments, const NewRobot& robot, Catalog& catalog) {
  // The finer accuracy is for gaits whose torques are off.
  constexpr Draft kDrafts[] = {{1, 1e-3}, {1, 1e-4}, {0.5, 1e-3}, {0.5, 1e-4}, {0.25, 1e-3}, {0.25, 1e-4}};
  const auto text = [&](const Draft& draft) {
    return scenario_text(arguments, robot, draft, "It runs without changes, to a verdict");
  };
  std::string file = write_new(arguments, text(kDrafts[0]));
  const std::string why = shortfall(file, catalog).value_or("");
  if (why.empty()) return file;
  for (std::size_t i = 1; i < std::size(kDrafts); ++i) {
    write_file(file, text(kDrafts[i]));
    if (shortfall(file, catalog) == "") return file;
  }
  write_file(file, scenario_text(arguments, robot, kDrafts[0], "As it stands " + why));
  say(file, "note", "as it stands " + why);
  return file;
}

int new_scenario(const NewFileArguments& arguments) {
  check_file_name("scenario", arguments.name);
  Catalog catalog = standard_catalog();
  const NewRobot robot = new_robot(arguments, catalog);
  const std::string file = shell_word(write_scenario(arguments, robot, catalog));
  fmt::print("{0}: {1}; next:\n  gaitlab check {0} --page {2}.html\n  gaitlab run {0}\n", file,
             robot_text(robot.type().name, robot.docks), arguments.name);
  return 0;
}

/// True if the servo file of that name has the section.
bool has_section(const NewFileArguments& arguments, const char* section, bool needed) {
  Problems problems;
  std::vector<Problem> notes;
  Node document = parse_yaml(fmt::format("{}: {{model: {}}}\n", section, yaml_text(arguments.servo)), "--servo");
  insert_servos(document, folder_of(arguments).string(), problems, notes);
  if (needed) problems.raise();
  return problems.empty();
}

int new_bench(const NewFileArguments& arguments) {
  check_file_name("bench", arguments.name);
  const std::string servo = yaml_text(arguments.servo);
  std::string actuator = "{type: servo, voltage: 6, stall_torque: 1, no_load_speed: 6, u_max: 6}";
  std::string controller = "{type: rc_servo, period: 0.001}";
  if (!arguments.servo.empty()) {
    has_section(arguments, "actuator", true);
    actuator = fmt::format("{{model: {}, u_max: 0}}", servo);
    if (has_section(arguments, "controller", false))
      controller = fmt::format("{{type: rc_servo, model: {}, period: 0.001}}", servo);
  }
  const double radius = arguments.length / 6;
  const double inertia = 0.4 * arguments.mass * radius * radius;  // of a ball
  const std::pair<const char*, std::string> values[] = {
      {"@NAME@", arguments.name},
      {"@TEXT@", yaml_text(arguments.name)},
      {"@FILE@", one_line(shell_word(arguments.out.value_or(arguments.name + ".yaml")))},
      {"@MASS@", number_text(arguments.mass)},
      {"@LENGTH@", number_text(arguments.length)},
      {"@INERTIA@", fmt::format("{:.3g}", inertia)},
      {"@ACTUATOR@", actuator},
      {"@CONTROLLER@", controller}};
  std::string text = kSkeletonBench;
  for (const auto& [mark, value] : values) text = filled(text, mark, value);
  const std::string file = shell_word(write_new(arguments, text));
  fmt::print(
      "{0}: a mass on the arm of a servo; state the supply and the columns of your logs in it; next:\n  gaitlab identify {0} "
      "LOG.csv LOG.csv ... --to servo.yaml\n",
      file);
  return 0;
}

void add_out(CLI::App& command, NewFileArguments& arguments) {
  command.add_option("--out", arguments.out, "file to write (default: NAME.yaml); must not exist")->check(not_empty);
}

}  // namespace

void check_file_name(const std::string& what, const std::string& name) {
  const SourceLocation place{"gaitlab new " + what};
  if (!is_name(name, "_-") || std::isalpha(static_cast<unsigned char>(name[0])) == 0) {
    throw InputError(place, "name " + in_quotes(name) +
                                " is not allowed; expected letters, digits, `_` and `-`, beginning "
                                "with a letter");
  }
}

void add_new_files(Commands& commands, CLI::App& command) {
  add_command<NewFileArguments>(
      commands, "module", "Write a commented module file, to be filled from a data sheet.", new_module,
      [](CLI::App& module, NewFileArguments& arguments) {
        module.add_option("NAME", arguments.name, "name of the module")->required();
        CLI::Option* const from =
            module.add_option("--from", arguments.from, "URDF or MJCF file of the robot, instead of an example");
        from->check(not_empty);
        module
            .add_option("--lock", arguments.options.locked,
                        "name or pattern of joints of the file that are fixed at 0; may be repeated")
            ->check(not_empty)
            ->expected(1)
            ->allow_extra_args(false)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
            ->needs(from);
        module.add_option("--meshes", arguments.options.meshes, "folder of the mesh files")->check(not_empty)->needs(from);
        module.add_option("--srdf", arguments.options.srdf, "SRDF file of the robot, for pairs of links that never collide")
            ->check(not_empty)
            ->needs(from);
        add_out(module, arguments);
      },
      &command);
  add_command<NewFileArguments>(
      commands, "scenario", "Write a commented scenario that runs: a wave along modules in a row.", new_scenario,
      [](CLI::App& scenario, NewFileArguments& arguments) {
        scenario.add_option("NAME", arguments.name, "name of the scenario")->required();
        offering(scenario.add_option("--module", arguments.module), "name that {} prints, or a module file (default: y1)",
                 {.kinds = {"module"}})
            ->check(not_empty);
        scenario
            .add_option("--count", arguments.count,
                        "number of modules in the row (default: up to 4, as many as the motors carry)")
            ->check(CLI::Range(1, 1000));
        add_out(scenario, arguments);
      },
      &command);
  add_command<NewFileArguments>(
      commands, "bench", "Write a scenario of a servo that moves an arm, for logs and `gaitlab identify`.", new_bench,
      [](CLI::App& bench, NewFileArguments& arguments) {
        constexpr double kMost = 1e3;
        bench.add_option("NAME", arguments.name, "name of the bench")->required();
        offering(bench.add_option("--servo", arguments.servo), "name that {} prints, or a servo file", {.kinds = {"servo"}})
            ->check(not_empty);
        bench.add_option("--mass", arguments.mass, "mass of the arm, kg (default 0.3)")->check(within(1e-6, kMost));
        bench.add_option("--length", arguments.length, "distance of its centre from the axis, m (default 0.1)")
            ->check(within(1e-6, kMost));
        add_out(bench, arguments);
      },
      &command);
}

}  // namespace gaitlab::app
