// Registration of the subcommands with the parser. Each `add_COMMAND` function is defined in the file of its command.
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <memory>

#include "app/app.h"
#include "app/shell/subcommands.h"
#include "core/files/atomic_file.h"
#include "kit/run_writer.h"

namespace gaitlab::app {

/// Adds the options that choose the extent of a printed summary.
void add_shown(CLI::App& command, SummaryOptions& shown);

/// Parser of the command line, and the function that the chosen subcommand has set.
struct Commands {
  CLI::App& app;
  std::function<int()> chosen = {};
};

/// Adds a subcommand: `options` declares its arguments. If the command line names this subcommand, `run` is called with them.
template <class Arguments, class Options>
void add_command(Commands& commands, const char* name, const char* about, int (*run)(const Arguments&), Options options,
                 CLI::App* parent = nullptr) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = (parent != nullptr ? *parent : commands.app).add_subcommand(name, about);
  options(*command, *arguments);
  command->callback([&commands, run, arguments] { commands.chosen = [run, arguments] { return run(*arguments); }; });
}

/// Values of an option or argument. Its help names the kinds, and the completion of a shell offers their items.
struct Offered {
  std::vector<std::string> kinds = {};  ///< kinds of `gaitlab list`; "": the kinds, or the names of the kind typed before
  bool settings = false;                ///< settings of a scenario; then nothing else
  bool files = true;                    ///< false if it accepts no file
  bool several = false;                 ///< names, separated by commas
};
/// Sets the help of an option to a text, with each `{}` replaced by the command that lists offered values. Returns the option.
CLI::Option* offering(CLI::Option* option, std::string text, const Offered& offered);

/// Adds the commands `new module`, `new scenario` and `new bench`.
void add_new_files(Commands& commands, CLI::App& command);
/// Adds the command `new log`.
void add_new_log(Commands& commands, CLI::App& command);
/// Throws InputError for a name that cannot be that of a new file. `what`: word of the command, such as `bench`.
void check_file_name(const std::string& what, const std::string& name);

/// Adds `--joint`, which chooses the joints of the figure.
void add_joint(CLI::App& command, std::vector<std::string>& joints);
void draw_joints(Scenario& scenario, const std::vector<std::string>& joints);

/// Adds the arguments of every command that reads a scenario. `named` is the path of the file that a user names.
void add_scenario(CLI::App& command, ScenarioArguments& arguments, std::string (*named)(const std::string&) = named_file);

/// Adds `--plugins-from-scenario` and `--plugin`.
void add_trust(CLI::App& command, PluginArguments& allowed);

/// Validator for CLI::Option::check that rejects an empty path. An empty shell variable gives an empty path, which would mean
/// the working folder.
std::string not_empty(const std::string& text);

/// Validator of numbers from `low` to `high`, which rejects NaN.
CLI::Validator within(double low, double high);

/// Throws InputError if the file exists or its folder does not.
void check_new(const std::string& name);

/// Checks that a page can be written and returns the mode of writing. Throws the InputError of check_new, except for `own`: an
/// existing page of that name may be replaced.
Existing check_page(const std::string& name, const std::filesystem::path& own = {});
/// Prints the path of a page.
void print_page(const std::filesystem::path& file);

}  // namespace gaitlab::app
