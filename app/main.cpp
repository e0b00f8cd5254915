// The program `gaitlab`: arguments in, one subcommand, an exit code out.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <functional>
#include <system_error>

#include "app/app.h"

namespace {

using namespace gaitlab;
using namespace gaitlab::app;

constexpr const char* kDynamicsHelp =
    "The state: {\"q\": [], \"qd\": [], \"tau\": [], \"qdd\": [], \"base\": {\"position\", \"quaternion\": [w, x, y, z],\n"
    "\"velocity\", \"angular_velocity\", \"acceleration\", \"angular_acceleration\"}, \"wrenches\": [{\"body\", \"point\",\n"
    "\"force\", \"torque\"}]}; SI, world axes, joints in the order of `gaitlab check`. What is missing: q, qd, pose and twist "
    "are\n"
    "those the scenario starts with, a wrench's point is the origin of its body's frame, all else is 0.\n"
    "Gravity, tau and the wrenches act; motors, hinge stops and the ground do not. tau is the torque on the joint.\n\n"
    "Out, forward (tau in, by the scenario's engine): qdd, base, mass_matrix, bias, with\n"
    "    mass_matrix [base acceleration; qdd] + bias = [0; tau]\n"
    "and of the base what it can move: all (floating), nothing (fixed), x, z, turn about y (planar).\n"
    "Out, --inverse (qdd and the base's accelerations in): tau, base_wrench (from outside, about the origin of the base "
    "frame),\n"
    "reactions: of the parent on the child at every hinge and dock (m3/dock), about its origin.";

void add_scenario(CLI::App& command, ScenarioArguments& arguments) {
  command.add_option("SCENARIO", arguments.file, "scenario file (YAML)")->required();
  command.add_option("--set", arguments.sets, "key.path=value, as if it stood in the file")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--seed", arguments.seed, "seed of everything random");
  command.add_flag("--quiet", arguments.quiet, "no notes, no progress, no summary on the terminal");
}

/// Bad arguments and bad input exit with 2, failed runs with 1; nobody sees a raw exception.
int guarded(const std::function<int()>& command) {
  // fputs, not fmt: nothing may throw any more.
  const auto say = [](const char* before, const char* what, const char* after) {
    for (const char* text : {before, what, after}) (void)std::fputs(text, stderr);
  };
  try {
    return command();
  } catch (const InputError& error) {
    say("", error.what(), "\n");
    return 2;
  } catch (const RunError& error) {
    say("gaitlab: error: ", error.what(), "\n");
  } catch (const std::system_error& error) {  // of fmt: standard output
    say("gaitlab: error: ", error.what(), "\n");
  } catch (const std::bad_alloc&) {
    say("gaitlab: error: ", "out of memory", "\n");
  } catch (const std::exception& error) {
    say("gaitlab: error: ", error.what(), " (this is a defect of gaitlab: please report it)\n");
  }
  return 1;
}

/// A path that is an empty shell variable would name the working folder.
std::string not_empty(const std::string& text) { return text.empty() ? "is empty" : ""; }

int program(int argc, char** argv) {
  CLI::App app{"gaitlab: a gait lab for modular robots"};
  app.require_subcommand(1);
  app.set_version_flag("--version", [] { return version(); });

  std::function<int()> chosen;
  RunArguments run_arguments;
  CLI::App* run_command = app.add_subcommand("run", "simulate; write a run folder; print the summary");
  add_scenario(*run_command, run_arguments);
  run_command->add_option("--out", run_arguments.out, "run folder (default runs/NAME, then NAME-2 ...); new or empty");
  run_command->add_option("--format", run_arguments.format, "of the trace: h5 (default) or csv")
      ->check(CLI::IsMember({"h5", "csv"}));
  run_command->callback([&] { chosen = [&] { return run(run_arguments); }; });

  ScenarioArguments check_arguments;
  CLI::App* check_command = app.add_subcommand("check", "validate without running; print what the scenario is made of");
  add_scenario(*check_command, check_arguments);
  check_command->callback([&] { chosen = [&] { return check(check_arguments); }; });

  ManualArguments manual_arguments;
  const auto add_plugins = [&](CLI::App& command) {
    command.add_option("--plugin", manual_arguments.plugins, "load this library first; may be repeated")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  CLI::App* list_command = app.add_subcommand("list", "what is registered: cpg, controller, actuator, engine, module, robot");
  list_command->add_option("KIND", manual_arguments.kind, "one of them alone");
  add_plugins(*list_command);
  list_command->callback([&] { chosen = [&] { return list(manual_arguments); }; });

  CLI::App* explain_command = app.add_subcommand("explain", "the manual of KIND NAME; without them, of the scenario file");
  CLI::Option* kind_option =
      explain_command->add_option("KIND", manual_arguments.kind, "cpg, controller, actuator, engine, module, robot");
  CLI::Option* name_option = explain_command->add_option("NAME", manual_arguments.name, "as `gaitlab list` prints it");
  kind_option->needs(name_option);
  add_plugins(*explain_command);
  explain_command->callback([&] { chosen = [&] { return explain(manual_arguments); }; });

  CLI::App* schema_command = app.add_subcommand("schema", "JSON Schema of the scenario file, for editors");
  add_plugins(*schema_command);
  schema_command->callback([&] { chosen = [&] { return schema(manual_arguments); }; });

  CLI::App* reference_command = app.add_subcommand("reference", "a page of docs/reference")->group("");  // not in the help
  reference_command->add_option("PAGE", manual_arguments.kind, "scenario or plugins")
      ->required()
      ->check(CLI::IsMember({"scenario", "plugins"}));
  reference_command->callback([&] { chosen = [&] { return reference(manual_arguments); }; });

  ConvergeArguments converge_arguments;
  CLI::App* converge_command = app.add_subcommand(
      "converge", "halve the step: errors against the finest one, their order, the step that is good for 1 %");
  add_scenario(*converge_command, converge_arguments);
  converge_command->add_option("--halvings", converge_arguments.halvings, "how often (default 2; an order needs 2)")
      ->check(CLI::Range(1, 8));
  converge_command
      ->add_option("--columns", converge_arguments.columns,
                   "trace columns that match this pattern (default joint.*.torque; without motors joint.*.angle)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  converge_command->add_option("-j,--jobs", converge_arguments.jobs, "threads (default 1)")->check(CLI::Range(1, 1024));
  converge_command->callback([&] { chosen = [&] { return converge(converge_arguments); }; });

  SwapArguments swap_arguments;
  CLI::App* swap_command = app.add_subcommand("swap", "the scenario under several CPGs: one table, one figure");
  add_scenario(*swap_command, swap_arguments);
  swap_command
      ->add_option("--cpg", swap_arguments.cpgs, "their types, with commas between; common keys stay, `model` falls back")
      ->required();
  swap_command->add_option("--out", swap_arguments.out, "folder of the figure (default runs/swap-NAME)");
  swap_command->add_option("-j,--jobs", swap_arguments.jobs, "threads (default 1)")->check(CLI::Range(1, 1024));
  swap_command->callback([&] { chosen = [&] { return swap_cpgs(swap_arguments); }; });

  DynamicsArguments dynamics_arguments;
  CLI::App* dynamics_command = app.add_subcommand("dynamics", "one evaluation of the equations of motion, as JSON");
  dynamics_command->footer(kDynamicsHelp);
  add_scenario(*dynamics_command, dynamics_arguments);
  dynamics_command->add_option("--state", dynamics_arguments.state, "JSON file: where and how fast, and what acts")->required();
  dynamics_command->add_flag("--inverse", dynamics_arguments.inverse, "accelerations in; torques and reactions out");
  dynamics_command->callback([&] { chosen = [&] { return dynamics(dynamics_arguments); }; });

  CompareArguments compare_arguments;
  CLI::App* compare_command = app.add_subcommand(
      "compare", "what differs between two runs, column by column; a report: exit code 0 whether or not they differ");
  compare_command->add_option("RUN_A", compare_arguments.a, "run folder or trace file: the reference")->required();
  compare_command->add_option("RUN_B", compare_arguments.b, "run folder or trace file")->required();
  compare_command->add_option("--columns", compare_arguments.columns, "only columns that match this pattern (with * and ?)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  compare_command->callback([&] { chosen = [&] { return compare(compare_arguments); }; });

  RerunArguments rerun_arguments;
  CLI::App* rerun_command = app.add_subcommand("rerun", "run again from a run folder alone");
  rerun_command->add_option("RUN", rerun_arguments.run, "run folder, or its trace.h5")->required();
  CLI::Option* out_option = rerun_command->add_option("--out", rerun_arguments.out, "run folder, as for run");
  rerun_command->add_flag("--verify", rerun_arguments.verify, "write nothing; compare with the recorded trace; 4: it differs")
      ->excludes(out_option);
  rerun_command->add_flag("--quiet", rerun_arguments.quiet, "no progress, no summary on the terminal");
  rerun_command->callback([&] { chosen = [&] { return rerun(rerun_arguments); }; });

  ExportArguments export_arguments;
  CLI::App* export_command = app.add_subcommand("export", "write a run's trace, or a scenario's robot, in another format");
  export_command->add_option("SOURCE", export_arguments.source.file, "csv: run folder or trace file; mjcf, urdf: scenario file")
      ->required();
  export_command->add_option("--to", export_arguments.format, "csv; mjcf (MuJoCo), urdf")
      ->required()
      ->check(CLI::IsMember({"csv", "mjcf", "urdf"}));
  export_command->add_option("FILE", export_arguments.file, "file to write; must not exist")->required();
  export_command->add_option("--set", export_arguments.source.sets, "key.path=value in the scenario")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  export_command->callback([&] { chosen = [&] { return export_to(export_arguments); }; });

  ApproveArguments approve_arguments;
  CLI::App* approve_command = app.add_subcommand("approve", "bless a scenario's torques as they are now: its golden");
  approve_command->add_option("SCENARIO", approve_arguments.file, "scenario file (YAML)")->required();
  approve_command->add_option("--reason", approve_arguments.reason, "why these numbers are right; kept in the golden");
  approve_command->add_flag("--calibrate", approve_arguments.calibrate,
                            "make new bands, from five more runs, even where the run is within the old ones");
  approve_command->add_flag("--replace", approve_arguments.replace,
                            "begin anew where the golden cannot be read or is another scenario's: its history is lost");
  approve_command->add_option("-j,--jobs", approve_arguments.jobs, "threads (default 1)")->check(CLI::Range(1, 1024));
  approve_command->callback([&] { chosen = [&] { return approve(approve_arguments); }; });

  TestArguments test_arguments;
  CLI::App* test_command = app.add_subcommand("test", "run scenarios and compare with their goldens; 4: a torque drifted");
  test_command->add_option("SCENARIO", test_arguments.scenarios, "scenario files, or folders of them (default: scenarios)")
      ->check(not_empty);
  test_command->add_option("-j,--jobs", test_arguments.jobs, "threads (default 1)")->check(CLI::Range(1, 1024));
  test_command->add_option("--junit", test_arguments.junit, "also write the result as JUnit XML to this file")
      ->check(not_empty);
  test_command->add_option("--engine", test_arguments.engine,
                           "run with this engine, at the golden's step (articulated: extrapolated); torque peaks, which depend "
                           "on the method, are left out");
  test_command->add_option("--golden", test_arguments.golden, "golden folder to compare one scenario with, not its own")
      ->check(not_empty);
  test_command->add_option("--out", test_arguments.out, "folder for figures of what failed (default runs/test)");
  test_command->add_flag("--strict", test_arguments.strict, "in a folder, too, a scenario without a golden is an error");
  test_command->callback([&] { chosen = [&] { return test_goldens(test_arguments); }; });

  NewPluginArguments new_arguments;
  CLI::App* new_command = app.add_subcommand("new", "start something of your own");
  new_command->require_subcommand(1);
  CLI::App* plugin_command = new_command->add_subcommand("plugin", "a folder with a working plugin, its scenario and its test");
  plugin_command->add_option("KIND", new_arguments.kind, "cpg, controller or actuator")->required();
  plugin_command->add_option("NAME", new_arguments.name, "what scenarios will call it")->required();
  plugin_command->add_option("--out", new_arguments.out, "folder to make (default: NAME); must not exist");
  plugin_command->callback([&] { chosen = [&] { return new_plugin(new_arguments); }; });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : 2;
  }
  const int code = chosen();
  if (std::fflush(stdout) != 0 && code == 0) throw RunError("standard output cannot be written");
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  // A file size limit is a full disk, reported as such.
  std::signal(SIGXFSZ, SIG_IGN);
  return guarded([&] { return program(argc, argv); });
}
