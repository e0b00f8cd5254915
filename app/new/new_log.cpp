// The command `gaitlab new log`: the trajectories with which a servo on a bench is recorded.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <numbers>

#include "app/shell/commands.h"
#include "core/files/atomic_file.h"
#include "core/robot_files/servo_file.h"
#include "core/settings/reader.h"
#include "core/settings/shell_word.h"
#include "core/settings/wording.h"
#include "identify/trajectories.h"

namespace gaitlab::app {

namespace {

namespace fs = std::filesystem;

struct NewLogArguments {
  std::string name;
  std::string out;    ///< folder
  std::string servo;  ///< name or file of a servo, whose speed replaces that of `of`
  identify::TrajectorySettings of;
};

/// No-load speed of a servo, rad/s.
double speed_of(const std::string& servo) {
  Problems problems;
  std::vector<Problem> notes;
  Node document = parse_yaml(fmt::format("actuator: {{model: {}}}\n", yaml_text(servo)), "--servo");
  insert_servos(document, fs::path(".").string(), problems, notes);
  problems.raise();
  Reader actuator(*document.find("actuator"), "actuator", problems, nullptr);
  double speed = 0;
  actuator.number("no_load_speed", speed, {"rad/s", kPositive, 1e6, ""});
  problems.raise();
  if (speed > 0) return speed;
  throw InputError(SourceLocation{"--servo"},
                   fmt::format("{} states no no_load_speed; expected --speed instead", in_quotes(servo)));
}

/// Writes new files, or none of them.
void write_all(const std::vector<std::pair<std::string, std::string>>& files) {
  for (const auto& [name, text] : files) check_new(name);
  std::vector<std::string> written;
  try {
    for (const auto& [name, text] : files) {
      write_file(name, text, Existing::refused);
      written.push_back(name);
    }
  } catch (...) {
    std::error_code none;
    for (const std::string& name : written) fs::remove(name, none);
    throw;
  }
}

int new_log(const NewLogArguments& arguments) {
  check_file_name("log", arguments.name);
  identify::TrajectorySettings settings = arguments.of;
  if (!arguments.servo.empty()) settings.speed = speed_of(arguments.servo);
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<std::string> names;
  for (const identify::Trajectory& one : identify::trajectories(settings)) {
    const fs::path file = fs::path(arguments.out) / fmt::format("{}-{}.csv", arguments.name, one.name);
    files.emplace_back(file.string(), identify::trajectory_text(one));
    names.push_back(shell_word(file.string()));
  }
  write_all(files);
  const std::string& name = arguments.name;
  const std::string first = names.front();
  fmt::print("{}: goals of a joint for {:.4g} s, {} rows per second, up to {:.4g} rad and {:.4g} rad/s\n",
             fmt::join(names, ", "), settings.duration, settings.rate, settings.amplitude, settings.speed);
  fmt::print(
      "{}",
      wrapped(
          "Play each of them on the bench at two gains, or with two masses; where `on` is 0, switch the torque off. Record t "
          "(s), goal and angle (rad), `on`, and the duty, voltage or current that the servo reports, at 100 Hz or "
          "more. A table names the logs and their gains: `file,controller.P`.\n"));
  fmt::print(
      "next:\n"
      "  gaitlab new bench {0}{1}\n"
      "  gaitlab run {0}.yaml --set cpg.model.file={2} --set measured.file={2} --set measured.on=on --set "
      "measured.columns.m0/hinge.angle=goal   # plays it in the program\n"
      "  gaitlab identify {0}.yaml LOGS.csv --to servo.yaml\n",
      name, arguments.servo.empty() ? "" : " --servo " + shell_word(arguments.servo), first);
  return 0;
}

}  // namespace

void add_new_log(Commands& commands, CLI::App& command) {
  add_command<NewLogArguments>(
      commands, "log", "Write the motions with which a servo on a bench is recorded, for `gaitlab identify`.", new_log,
      [](CLI::App& log, NewLogArguments& arguments) {
        identify::TrajectorySettings& of = arguments.of;
        log.add_option("NAME", arguments.name, "first part of the names of the four files")->required();
        CLI::Option* const servo =
            offering(log.add_option("--servo", arguments.servo),
                     "name that {} prints, or a servo file: goals up to its speed without load", {.kinds = {"servo"}})
                ->check(not_empty);
        log.add_option("--speed", of.speed, "largest speed of a goal, rad/s (default 6)")
            ->check(within(0.1, 1000))
            ->excludes(servo);
        log.add_option("--amplitude", of.amplitude, "largest goal, rad (default 1.57)")->check(within(0.01, std::numbers::pi));
        log.add_option("--duration", of.duration, "duration of each motion, s (default 6)")->check(within(1, 600));
        log.add_option("--rate", of.rate, "rows per second (default 200)")->check(CLI::Range(20, 5000));
        log.add_option("--out", arguments.out, "folder for the files (default: this one)")->check(not_empty);
      },
      &command);
}

}  // namespace gaitlab::app
