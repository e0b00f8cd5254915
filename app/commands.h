// Registration of the subcommands with the parser; each is defined beside its command's code.
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <memory>

#include "app/app.h"
#include "app/subcommands.h"
#include "core/files/atomic_file.h"

namespace gaitlab::app {

/// Adds the options of commands that print a summary.
void add_shown(CLI::App& command, SummaryOptions& shown);

/// The command line of the program, and the function of the chosen command.
struct Commands {
  CLI::App& app;
  std::function<int()> chosen = {};
};

/// Adds a subcommand: `options` declares its arguments, `run` receives them if the command line names the subcommand.
template <class Arguments, class Options>
void add_command(Commands& commands, const char* name, const char* about, int (*run)(const Arguments&), Options options,
                 CLI::App* parent = nullptr) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = (parent != nullptr ? *parent : commands.app).add_subcommand(name, about);
  options(*command, *arguments);
  command->callback([&commands, run, arguments] { commands.chosen = [run, arguments] { return run(*arguments); }; });
}

/// Adds `--joint`, which chooses the joints of the figure.
void add_joint(CLI::App& command, std::vector<std::string>& joints);
void draw_joints(Scenario& scenario, const std::vector<std::string>& joints);

/// Adds the arguments of every command that reads a scenario.
void add_scenario(CLI::App& command, ScenarioArguments& arguments);

/// Adds `--plugins-from-scenario` and `--plugin`.
void add_trust(CLI::App& command, PluginArguments& allowed);

/// For CLI::Option::check: a path from an empty shell variable would name the working folder.
std::string not_empty(const std::string& text);

/// Throws InputError if a file to be written exists, or its folder does not.
void check_new(const std::string& name);

inline constexpr const char* kPageFile = "report.html";  ///< in a run folder
/// Checks that a page can be written; throws InputError as check_new, except for `own`, which may be replaced. Returns the mode
/// of writing.
Existing check_page(const std::string& name, const std::filesystem::path& own = {});
/// Prints the place of a page.
void print_page(const std::filesystem::path& file);

}  // namespace gaitlab::app
