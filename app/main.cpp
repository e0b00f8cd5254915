// The program `gaitlab`: arguments in, one subcommand, an exit code out.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "app/commands.h"
#include "core/scenario/wording.h"

namespace {

using namespace gaitlab;
using namespace gaitlab::app;

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

/// Refuses what is not a command before the parser does, which does not say what is meant.
void check_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (std::find(known.begin(), known.end(), argv[1]) != known.end()) return;
  throw InputError(SourceLocation{"gaitlab"}, "unknown command " + in_quotes(argv[1]) + offer(argv[1], known, "commands"));
}

/// The options of a command and of those that were chosen within it.
std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (const CLI::App* within : command.get_subcommands()) {
    for (std::string& name : options_of(*within)) known.push_back(std::move(name));
  }
  return known;
}

/// Of arguments that the chosen command does not take: the first option that it does not know.
void check_options(const CLI::App& app, int argc, char** argv) {
  for (const CLI::App* command : app.get_subcommands()) {
    const std::vector<std::string> known = options_of(*command);
    for (int i = 2; i < argc; ++i) {
      const std::string text = argv[i];
      const std::string name = text.substr(0, text.find('='));
      if (!text.starts_with("--") || std::find(known.begin(), known.end(), name) != known.end()) continue;
      throw InputError(SourceLocation{"gaitlab " + command->get_name()},
                       "unknown option " + in_quotes(name) + offer(name, known, "options"));
    }
  }
}

int program(int argc, char** argv) {
  CLI::App app{"gaitlab: a gait lab for modular robots"};
  app.require_subcommand(1);
  app.set_version_flag("--version", [] { return version(); });
  Commands commands{app};
  for (const auto add : {add_run, add_report, add_check, add_manuals, add_converge, add_swap, add_dynamics, add_compare,
                         add_rerun, add_export, add_approve, add_test, add_new}) {
    add(commands);
  }
  check_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError& error) {
    check_options(app, argc, argv);
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : 2;
  }
  const int code = commands.chosen();
  if (std::fflush(stdout) != 0 && code == 0) throw RunError("standard output cannot be written");
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  // A file size limit is a full disk, reported as such.
  std::signal(SIGXFSZ, SIG_IGN);
  return guarded([&] { return program(argc, argv); });
}
