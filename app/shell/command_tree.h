// Commands and options as texts, from the parser's declarations: for messages, completion and the manual page.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gaitlab::app {

/// Name of a command with those that it follows: `gaitlab new plugin`.
std::string full_name(const CLI::App& command);
/// Subcommands that the help of a command shows, in its order.
std::vector<const CLI::App*> shown_commands(const CLI::App& command);
/// Allowed values of an option, such as h5 and csv. Empty if any text is allowed.
std::vector<std::string> choices(const CLI::Option& option);
/// True if the option expects a number.
bool is_number(const CLI::Option& option);
/// Usage of a command, `gaitlab swap SCENARIO --cpg ...`: required arguments, and optional ones in brackets.
std::string usage(const CLI::App& command);
/// Arguments of a command that are not options, in their order.
std::vector<const CLI::Option*> positionals(const CLI::App& command);

}  // namespace gaitlab::app
