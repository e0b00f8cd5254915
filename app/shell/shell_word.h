// A word of a command line for the shell.
#pragma once
#include <string>

namespace gaitlab::app {

/// A word as one argument of a command line, in quotes if the shell requires them.
std::string shell_word(const std::string& word);

}  // namespace gaitlab::app
