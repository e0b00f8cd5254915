#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "app/gait/run_time.h"
#include "app/look/module_table.h"
#include "app/shell/commands.h"
#include "core/dynamics/rotor_inertia.h"
#include "core/files/atomic_file.h"
#include "core/plugin/robot_info.h"
#include "core/scenario/built_robot.h"
#include "core/settings/settings_numbers.h"
#include "core/settings/wording.h"
#include "core/simulation/recorder.h"
#include "core/simulation/simulation.h"
#include "core/simulation/start.h"
#include "report/analysis/legs.h"
#include "report/analysis/start_row.h"
#include "report/page/page.h"
#include "report/verdict/position_loop.h"
#include "report/verdict/trust.h"

namespace gaitlab::app {

namespace {

std::string_view plugin_name(const PluginSelection& choice) { return choice.entry == nullptr ? "none" : choice.entry->name; }

/// Makes the simulation, which checks the trace columns, the step and the memory. If the run would be long, an error message
/// also states its estimated duration.
std::unique_ptr<Simulation> made(const Scenario& s) try {
  return std::make_unique<Simulation>(std::span<const Scenario>(&s, 1));
} catch (const TooManyRows& error) {
  std::vector<Problem> problems = error.problems();
  const double seconds = estimated_seconds(s);
  if (seconds > kLongRun) problems.front().notes.emplace_back(SourceLocation{s.file}, "the run " + time_text(seconds));
  throw InputError(std::move(problems));
}

struct CheckArguments : ScenarioArguments {
  std::optional<std::string> page;  ///< file for a page that shows the robot in its initial pose
  PluginArguments plugins;
};

void write_page(const Scenario& s, const std::string& file) {
  const Recording start = report::start_row(s);
  report::Verdict verdict;
  verdict.word = Word::not_judged;
  write_file(file, report::page(report::page_data(s, start, report::summarise(s, start, 0), verdict)), Existing::refused);
}

constexpr double kLittleCreep = 0.001;  // m/s, slip speed with little creep (docs/modules.md, wheels)

/// Rounds to two decimals and turns -0 into 0.
double rounded(double part) { return std::round(100 * part) / 100 + 0.0; }

/// Prints a note on robots with wheels: feet and wheels creep, because friction is a damper at low speed.
void print_creep(const Scenario& s) {
  std::vector<std::string> names;
  for (const Joint& joint : s.robot->joints) {
    if (joint.turns_freely()) names.push_back(joint.name);
  }
  if (names.empty() || !s.contact.model().penalty_settings || !s.ground.exists() || s.contact.on == ContactSet::none) return;
  print_fitted(
      fmt::format("  note: {} turn{} freely: feet and wheels that should stand still creep, because friction is viscous below\n"
                  "    contact.slip_speed, {:g} m/s in this scenario{}\n",
                  joined(names), names.size() == 1 ? "s" : "", s.contact.penalty.v_lim,
                  s.contact.penalty.v_lim > kLittleCreep ? fmt::format("; they creep less with {:g} m/s", kLittleCreep) : ""));
}

void print_joints(const Robot& robot) {
  const RobotInfo seen = info(robot);
  print_fitted(fmt::format("  joints (number, name, axis in the base frame at zero angles, range in rad):\n"));
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const Joint& joint = robot.joints[j];
    const std::string range = joint.turns_freely() ? "free" : fmt::format("{:+.4f} {:+.4f}", joint.lo, joint.hi);
    const std::array<double, 3>& axis = seen.joints[j].axis;
    const std::string play = joint.play.any() ? fmt::format("  play {:.4g}", joint.play.width) : "";
    print_fitted(fmt::format("  {:5}  {:<16} {:5.2f} {:5.2f} {:5.2f}  {}{}{}\n", j, joint.name, rounded(axis[0]),
                             rounded(axis[1]), rounded(axis[2]), range, joint.driven() ? "" : "  without a motor", play));
  }
}

/// Prints how gears with play are simulated.
void print_play(const Scenario& s) {
  const std::vector<std::size_t> joints = joints_with_play(*s.robot);
  if (joints.empty()) return;
  const std::vector<double> rotors = rotors_beside(*s.robot, make_motors(s).get(), 0, 1);
  double fastest = 0;
  for (std::size_t k = 0; k < joints.size(); ++k)
    fastest = std::max(fastest, std::sqrt(s.robot->joints[joints[k]].play.stiffness / rotors[k]));
  print_fitted(
      fmt::format("  play of {}: each motor is a wheel of its own with the inertia of its rotor, between two stops on its\n"
                  "    link (natural frequency up to {:.0f} rad/s); angles are those of links, torques those of motors\n",
                  counted(joints.size(), "gear"), fastest));
}

/// Prints the estimated time of a run and, if another engine is faster, the estimated time with that engine.
void print_time(const CheckArguments& arguments, Catalog& catalog, const Scenario& s, const RowsNeeded& rows) {
  const double seconds = estimated_seconds(s, rows);
  if (seconds > 0) print_fitted(fmt::format("  {}\n", time_text(seconds)));
  const std::string advice = faster_engine(s, seconds, rows, arguments, catalog);
  if (!advice.empty()) print_fitted(fmt::format("  {}\n", advice));
}

void note_boxes(const Scenario& s, const CheckArguments& arguments) {
  constexpr std::size_t kManyBoxes = 1000;
  const std::size_t boxes = s.ground.boxes().size();
  if (boxes <= kManyBoxes || arguments.quiet) return;
  say(arguments.file, "note",
      fmt::format("simulates one step with {} boxes, which takes seconds if many of them are close together", boxes));
}

/// Notes that a run would print at its end, on gravity that lifts the robot and on a gait that stands still.
void note_outcome(const Scenario& s) {
  const bool free = s.base != Base::fixed && s.ground.exists();
  if (free && s.physics.gravity.z() > 0) {
    say(to_string(s.nearest_place("physics.gravity")), "note",
        "gravity points up, so that the robot leaves the ground and its run is not judged; expected gravity: [0, 0, -9.81]");
  }
  if (s.cpg.entry == nullptr) return;
  const SettingsNumbers numbers(s.cpg);
  const SettingsNumbers::Found* frequency = numbers.find("frequency");
  bool still = frequency != nullptr;
  for (std::size_t j = 0; still && j < s.robot->joints.size(); ++j) still = frequency->value[j] == 0;
  if (still) {
    say(to_string(s.nearest_place("cpg.frequency")), "note",
        "cpg.frequency is 0, so that the joints and the robot do not move; expected more than 0");
  }
}

void print_legs(const Scenario& s) {
  const std::vector<Leg> legs = report::legs_that_walk(s);
  if (legs.empty()) return;
  std::string text;
  for (const Leg& leg : legs) {
    const std::string& first = s.robot->joints[static_cast<std::size_t>(leg.joints.front())].name;
    const std::string& last = s.robot->joints[static_cast<std::size_t>(leg.joints.back())].name;
    text += fmt::format("{}{} ({}{}{})", text.empty() ? "" : ", ", report::leg_name(leg), first, first == last ? "" : " to ",
                        first == last ? "" : last);
  }
  print_fitted(fmt::format("  legs: {}\n", text));
}

int check(const CheckArguments& arguments) {
  if (arguments.page) check_page(*arguments.page);
  Catalog catalog = careful_catalog(arguments.plugins);
  const Scenario s = read(arguments, catalog);
  warn_of_start(s, arguments.quiet);
  note_boxes(s, arguments);
  if (!arguments.quiet) note_outcome(s);
  const auto simulation = made(s);
  if (!arguments.quiet) note_rows(s, *simulation);
  const Robot& robot = *s.robot;
  const auto contacts = contact_elements(robot, s.contact.on);
  print_fitted(fmt::format("{}: valid\n", s.name));
  print_fitted(fmt::format("  {}, {} {} (moving as {}), {} degrees of freedom, {:.3f} kg, {}\n",
                           counted(robot.modules.size(), "module"), robot.bodies.size(),
                           robot.bodies.size() == 1 ? "body" : "bodies", robot.links.size(), robot.dof(s.base), robot.mass,
                           size_text(robot)));
  const double rate = simulation->standing().rate;
  print_fitted(
      fmt::format("  engine {} ({}), {}{}\n", s.physics.engine->name, s.physics.integrator->name, report::step_text(s.physics),
                  rate > 0 ? fmt::format(": step times damping rate h lambda = {:.2f} for the standing robot (allowed up to 1)",
                                         s.physics.step * rate)
                           : ""));
  const Vec3 start = start_state(s).position;
  print_fitted(fmt::format("  base frame at [{:.4g}, {:.4g}, {:.4g}] m at the start: {}\n", start.x(), start.y(), start.z(),
                           !s.ground.exists() ? "there is no ground"
                           : s.on_ground      ? "lowered onto the ground"
                                              : "at the height in position, because on_ground is off"));
  print_fitted(fmt::format("  cpg {}, controller {}, actuator {}, {} contact elements\n", plugin_name(s.cpg),
                           plugin_name(s.controller), plugin_name(s.actuator), contacts.size()));
  if (const auto loops = report::position_loops(s); !loops.empty())
    print_fitted(fmt::format("  position loop: {}\n", report::loop_text(s, loops)));
  print_legs(s);
  const RowsNeeded needed = simulation->rows_needed(0);
  print_fitted(fmt::format("  records {:.0f} rows of {:.0f} columns ({:.3g} MB) in {:g} s\n", needed.rows, needed.columns,
                           needed.bytes() / 1e6, s.duration));
  print_time(arguments, catalog, s, needed);
  if (const std::string failure = early_failure(*simulation, s); !failure.empty())
    print_fitted(fmt::format("  fails early: {}\n", failure));
  for (const PluginFile& plugin : s.plugins) print_fitted(fmt::format("  plugin {} ({})\n", plugin.path, plugin.hash));
  print_joints(robot);
  print_play(s);
  print_creep(s);
  if (arguments.page) {
    write_page(s, *arguments.page);
    print_page(*arguments.page);
  }
  return 0;
}

}  // namespace

void add_check(Commands& commands) {
  add_command<CheckArguments>(
      commands, "check", "Validate a scenario without running it, and print its parts.", check,
      [](CLI::App& command, CheckArguments& arguments) {
        add_scenario(command, arguments);
        add_trust(command, arguments.plugins);
        command
            .add_option("--page", arguments.page,
                        "page (HTML) to write, with the robot at its start and the numbers of its faces; must not exist")
            ->check(not_empty);
      });
}

}  // namespace gaitlab::app
