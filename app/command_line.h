// Reader of the command line: parsed by CLI11, with gaitlab's messages for errors.
#pragma once
#include <string>
#include <vector>

#include "app/commands.h"

namespace gaitlab::app {

/// Passes the words after the program's name to the commands; `help COMMAND` means `COMMAND --help`. False: help or version was
/// printed, and there is nothing to run. Throws InputError `gaitlab COMMAND: error: ...` for words that no command accepts.
bool read_command_line(CLI::App& app, std::vector<std::string> words);

}  // namespace gaitlab::app
