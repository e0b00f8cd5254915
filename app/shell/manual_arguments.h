// Arguments of the commands that print manuals.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gaitlab::app {

struct ManualArguments {
  std::string kind, name;            ///< `kind` is empty for all kinds, `name` for all entries of the kind
  std::vector<std::string> plugins;  ///< plugin libraries to load first
};

/// Adds `--plugin`.
void add_plugins(CLI::App& command, ManualArguments& arguments);

}  // namespace gaitlab::app
