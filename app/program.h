// Common main function of the programs: reads arguments, runs one subcommand, returns an exit code.
#pragma once
#include <functional>
#include <span>
#include <string_view>

#include "app/subcommands.h"

namespace gaitlab::app {

/// Returns exit code 2 for bad arguments and bad input, 1 for failed runs; no exception escapes. `tell` receives the message,
/// piece by piece.
int guarded(const std::function<int()>& command, void (*tell)(std::string_view text));

/// Runs the command that the arguments name, among the given ones. Throws its exceptions, and RunError if standard output could
/// not be written in full, for help as for any other command.
int program(std::span<void (*const)(Commands&)> commands, int argc, char** argv);

}  // namespace gaitlab::app
