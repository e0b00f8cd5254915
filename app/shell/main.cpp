// The program `gaitlab`: it reads arguments, runs one subcommand and returns an exit code.
#include <csignal>

#include "app/shell/program.h"

int main(int argc, char** argv) {
  using namespace gaitlab::app;
  // SIGXFSZ is ignored, so that a write beyond the file size limit fails as on a full disk and is reported.
  std::signal(SIGXFSZ, SIG_IGN);
  return guarded([&] { return program(kSubcommands, argc, argv); });
}
