// Common main function of the programs. It reads the arguments, runs one subcommand and returns its exit code.
#pragma once
#include <functional>
#include <span>

#include "app/shell/subcommands.h"

namespace gaitlab::app {

/// Prints the parts of an error message as a line. It does not throw.
void say_error(const char* before, const char* text, const char* remark);

/// Runs `command` and returns its exit code, or 2 for bad arguments and bad input, or 1 for a failed run. No exception escapes.
/// `tell` receives the parts of the error message: the beginning of the line, such as `gaitlab: error: `, text and remark. The
/// default prints them.
int guarded(const std::function<int()>& command,
            void (*tell)(const char* before, const char* text, const char* remark) = say_error);

/// Runs the command that the arguments name; `commands` lists the functions that register the known commands. Passes on
/// exceptions of the command. Throws RunError if standard output cannot be written in full, also after --help.
int program(std::span<void (*const)(Commands&)> commands, int argc, char** argv);

}  // namespace gaitlab::app
