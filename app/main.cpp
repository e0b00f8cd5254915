// The program `gaitlab`: arguments in, one subcommand, an exit code out.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "app/command_line.h"
#include "core/errors.h"

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

int program(int argc, char** argv) {
  CLI::App app{"gaitlab: a gait lab for modular robots", "gaitlab"};
  app.require_subcommand(1);
  app.set_version_flag("--version", [] { return version(); });
  Commands commands{app};
  for (const auto add : {add_run, add_report, add_check, add_manuals, add_converge, add_swap, add_dynamics, add_figure,
                         add_compare, add_rerun, add_export, add_approve, add_test, add_new}) {
    add(commands);
  }
  if (!read_command_line(app, {argv + std::min(argc, 1), argv + argc})) return 0;
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
