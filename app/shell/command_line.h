// Reader of the command line, which parses it with CLI11 and replaces CLI11's error messages.
#pragma once
#include <string>
#include <vector>

#include "app/shell/commands.h"

namespace gaitlab::app {

/// Parses the words after the program's name. `help COMMAND` means `COMMAND --help`. Returns false if help or version was
/// printed and there is nothing to run. Throws InputError `gaitlab COMMAND: error: ...` for words that no command accepts.
bool read_command_line(CLI::App& app, std::vector<std::string> words);

}  // namespace gaitlab::app
