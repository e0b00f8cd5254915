// How the subcommands of the program register themselves: each beside its code.
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <memory>

#include "app/app.h"
#include "app/subcommands.h"
#include "core/files/atomic_file.h"

namespace gaitlab::app {

/// Options of what prints a summary.
void add_shown(CLI::App& command, SummaryOptions& shown);

/// The command line of the program, and what it chose to run.
struct Commands {
  CLI::App& app;
  std::function<int()> chosen = {};
};

/// Adds a subcommand: `options` declares what it takes, `run` gets that where the command line names the subcommand.
template <class Arguments, class Options>
void add_command(Commands& commands, const char* name, const char* about, int (*run)(const Arguments&), Options options,
                 CLI::App* parent = nullptr) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = (parent != nullptr ? *parent : commands.app).add_subcommand(name, about);
  options(*command, *arguments);
  command->callback([&commands, run, arguments] { commands.chosen = [run, arguments] { return run(*arguments); }; });
}

/// `--joint`, and what it does to a scenario.
void add_joint(CLI::App& command, std::vector<std::string>& joints);
void draw_joints(Scenario& scenario, const std::vector<std::string>& joints);

/// What every command that reads a scenario takes.
void add_scenario(CLI::App& command, ScenarioArguments& arguments);

/// `--plugins-from-scenario` and `--plugin`.
void add_trust(CLI::App& command, PluginArguments& allowed);

/// For CLI::Option::check: a path that is an empty shell variable would name the working folder.
std::string not_empty(const std::string& text);

/// InputError: a file that is to be written exists, or its folder does not.
void check_new(const std::string& name);

inline constexpr const char* kPageFile = "report.html";  ///< in a run folder
/// InputError where a page cannot be written there: as check_new, but for `own`, which it may take the place of. Returns how it
/// is to be written.
Existing check_page(const std::string& name, const std::filesystem::path& own = {});
/// Says where a page is.
void print_page(const std::filesystem::path& file);

}  // namespace gaitlab::app
