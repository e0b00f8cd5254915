// The command line: read by CLI11, refused in the words of this program.
#pragma once
#include <string>
#include <vector>

#include "app/commands.h"

namespace gaitlab::app {

/// Has the commands read the words after the program's name; `help COMMAND` stands for `COMMAND --help`. False: help or version
/// is printed, and there is nothing to run. InputError `gaitlab COMMAND: error: ...` of words that no command takes.
bool read_command_line(CLI::App& app, std::vector<std::string> words);

}  // namespace gaitlab::app
