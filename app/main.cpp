// The program `gaitlab`: arguments in, one subcommand, an exit code out.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <functional>

#include "app/app.h"

namespace {

using namespace gaitlab;
using namespace gaitlab::app;

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
  try {
    return command();
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const RunError& error) {
    fmt::print(stderr, "gaitlab: error: {}\n", error.what());
    return 1;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "gaitlab: error: out of memory\n");
    return 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "gaitlab: error: {} (this is a defect of gaitlab: please report it)\n", error.what());
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  // A file size limit is a full disk, reported as such.
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App app{"gaitlab: a gait lab for modular robots"};
  app.require_subcommand(1);
  app.set_version_flag("--version", [] { return version(); });

  std::function<int()> chosen;
  RunArguments run_arguments;
  CLI::App* run_command = app.add_subcommand("run", "simulate; write a run folder; print the summary");
  add_scenario(*run_command, run_arguments);
  run_command->add_option("--out", run_arguments.out, "run folder (default runs/NAME, then NAME-2 ...); new or empty");
  run_command->add_option("--format", run_arguments.format, "of the trace")->check(CLI::IsMember({"csv"}));
  run_command->callback([&] { chosen = [&] { return run(run_arguments); }; });

  ScenarioArguments check_arguments;
  CLI::App* check_command = app.add_subcommand("check", "validate without running; print what the scenario is made of");
  add_scenario(*check_command, check_arguments);
  check_command->callback([&] { chosen = [&] { return check(check_arguments); }; });

  std::string kind;
  std::string name;
  CLI::App* list_command = app.add_subcommand("list", "what is registered: cpg, controller, actuator, engine, module, robot");
  list_command->add_option("KIND", kind, "one of them alone");
  list_command->callback([&] { chosen = [&] { return list(kind); }; });

  CLI::App* explain_command = app.add_subcommand("explain", "the manual of KIND NAME; without them, of the scenario file");
  CLI::Option* kind_option = explain_command->add_option("KIND", kind, "cpg, controller, actuator, engine, module, robot");
  CLI::Option* name_option = explain_command->add_option("NAME", name, "as `gaitlab list` prints it");
  kind_option->needs(name_option);
  explain_command->callback([&] { chosen = [&] { return explain(kind, name); }; });

  ScenarioArguments converge_arguments;
  int halvings = 1;
  CLI::App* converge_command = app.add_subcommand("converge", "halve the step; show what changes against the finest one");
  add_scenario(*converge_command, converge_arguments);
  converge_command->add_option("--halvings", halvings, "how often (default 1)")->check(CLI::Range(1, 8));
  converge_command->callback([&] { chosen = [&] { return converge(converge_arguments, halvings); }; });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : 2;
  }
  const int code = guarded(chosen);
  if (std::fflush(stdout) == 0) return code;
  fmt::print(stderr, "gaitlab: error: standard output cannot be written\n");
  return code == 0 ? 1 : code;
}
