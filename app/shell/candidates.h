// Words that may follow on a command line, for the completion of a shell.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gaitlab::app {

struct Candidates {
  std::vector<std::string> words;  ///< words that may replace the last typed word
  bool files = false;              ///< true: the last word may also be a file or folder
};

/// Words that may replace the last of `words`, which are the words after the program's name. A `=` may be a word of its own,
/// because bash divides words there; the candidates contain the part before it, too.
Candidates candidates(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace gaitlab::app
