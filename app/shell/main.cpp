// The program `gaitlab`: it reads arguments, runs one subcommand and returns an exit code.
#include <csignal>

#include "app/shell/program.h"

int main(int argc, char** argv) {
  using namespace gaitlab::app;
  // SIGXFSZ is ignored, so that a write beyond the file size limit fails as on a full disk and is reported.
  std::signal(SIGXFSZ, SIG_IGN);
  constexpr void (*kCommands[])(Commands&) = {add_run,     add_watch,    add_report, add_check,      add_demo,     add_remedy,
                                              add_manuals, add_converge, add_swap,   add_sweep,      add_optimize, add_evaluate,
                                              add_study,   add_dynamics, add_figure, add_compare,    add_rerun,    add_export,
                                              add_approve, add_test,     add_new,    add_completion, add_man};
  return guarded([&] { return program(kCommands, argc, argv); });
}
