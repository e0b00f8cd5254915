// What the programs share: arguments in, one subcommand, an exit code out.
#pragma once
#include <functional>
#include <span>
#include <string_view>

#include "app/subcommands.h"

namespace gaitlab::app {

/// Bad arguments and bad input exit with 2, failed runs with 1; nobody sees a raw exception. `tell` is told why, piece by
/// piece.
int guarded(const std::function<int()>& command, void (*tell)(std::string_view text));

/// Runs the command that the arguments name, of those that are given. Throws what that throws, and
/// RunError where standard output took less than what was printed, of help as of any other command.
int program(std::span<void (*const)(Commands&)> commands, int argc, char** argv);

}  // namespace gaitlab::app
