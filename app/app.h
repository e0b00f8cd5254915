// Functions that the subcommands share. Each subcommand has a file, and returns the exit code (docs/commands.md: 0 ok, 1
// failed run, 2 bad input, 3 infeasible, 4 regression).
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"
#include "kit/catalog.h"
#include "kit/judged_run.h"
#include "kit/shipped.h"
#include "report/analysis/summary.h"
#include "report/verdict/screen.h"
#include "report/verdict/verdict.h"

namespace gaitlab::app {

using namespace kit;  // these functions are also needed by the Python module

/// Plugins that the command line allows a scenario or a recorded run to load. Used by commands that may read files from unknown
/// sources.
struct PluginArguments {
  bool from_scenario = false;      ///< true: all plugins that the scenario names are allowed
  std::vector<std::string> files;  ///< plugin libraries that are allowed in any case
};
/// Catalog of everything built in, which loads only the allowed plugin libraries of a scenario. Throws InputError if one of
/// `allowed.files` does not exist.
Catalog careful_catalog(const PluginArguments& allowed);
/// The command line as typed, for messages.
std::string& typed();

/// Arguments of every command that reads a scenario.
struct ScenarioArguments {
  std::string file;
  std::vector<std::string> sets;
  std::optional<std::string> seed;
  bool quiet = false;
};

/// Reads the scenario and applies --set and --seed. Prints the notes of the reader on stderr unless quiet.
Scenario read(const ScenarioArguments& arguments, Catalog& catalog);
/// Prints on stderr each check that does not pass and has a remedy, at the place of the setting to change. Also prints the
/// numbers of the run that are not finite.
void warn_of_run(const Scenario& scenario, const Recording& recording, const report::Verdict& verdict);
/// Prints a warning on stderr if part of the robot starts below the ground.
void warn_of_start(const Scenario& scenario, bool quiet);

/// Extent of a printed summary.
struct SummaryOptions {
  bool verbose = false;          ///< also print the energy ledger and the limits of the step
  bool joints = false;           ///< also print a row for each joint
  bool fail_infeasible = false;  ///< exit code 3 for an infeasible verdict, 1 for a failed run
  bool demand = false;           ///< also run the demand twin, with 20 times the motor limits (report/verdict/demand.h)
};

struct RunArguments : ScenarioArguments {
  std::optional<std::string> out;
  std::string format = "h5";
  bool no_page = false;     ///< do not write report.html
  bool names_files = true;  ///< true: print the names of the files
  SummaryOptions shown;
  std::vector<std::string> joints;          ///< names of the joints in the figure; if empty, those that the scenario chooses
  int draws = 1;                            ///< number of seeds, starting with the scenario's
  int jobs = 1;                             ///< threads for the draws and the remedy
  std::vector<std::string> libraries = {};  ///< plugin libraries that are not beside the scenario that names them
  bool no_retry = false;                    ///< true: keep a run that lacks a verdict only because of its accuracy
  bool remedy = false;                      ///< true: search for the changes that make the gait feasible, or for its reserves
  bool map = false;                         ///< true: the remedy has a map of frequency and amplitude
  std::vector<std::string> by;              ///< settings that the remedy tries; empty for all
};
/// Reads and runs a scenario as the arguments say.
[[nodiscard]] int run(const RunArguments& arguments);
/// Runs a scenario and further `draws` of it, writes the run folder and prints the summary. Returns the exit code.
[[nodiscard]] int run(const Scenario& scenario, const RunArguments& arguments, std::span<const Scenario> draws = {});

/// Result of take_remedy(): the lines to print, the text of remedy.json, and false if the search was interrupted or impossible.
/// The reason has then been reported.
struct Remedied {
  std::vector<report::ScreenLine> lines = {};
  std::string json = {};
  bool complete = true;
};
/// Searches for a remedy for a judged run if the arguments ask for it, and stores the results for the page in the verdict.
Remedied take_remedy(const Scenario& scenario, report::Verdict& verdict, const RunArguments& arguments);
/// Prints lines of a summary, in colour on a terminal.
void print_lines(const std::vector<report::ScreenLine>& lines);
/// Prints a text. On a terminal, lines that are wider than the terminal are wrapped by wrapped().
void print_fitted(const std::string& text);

/// Prints the summary of a run; the verdict is its first line.
void print_summary(const Scenario& scenario, const Recording& recording, const report::Summary& summary,
                   const report::Verdict& verdict, const SummaryOptions& shown);
/// Prints the command for another run that is expected to have a verdict, if Verdict::retry has one. `arguments` name the
/// scenario.
void print_retry(const ScenarioArguments& arguments, const report::Verdict& verdict);
/// Simulates the demand twin of a run, with its progress unless `quiet`, and adds its results to the verdict.
void take_demand(const Scenario& scenario, const Recording& recording, const report::Summary& summary, report::Verdict& verdict,
                 bool quiet = false);
/// Simulates an infeasible run again without the friction of its servos that is only chosen, if there is any, and adds the word
/// of that run to the verdict. Memory that is short, or a plugin that throws, leaves the verdict as it is.
void take_word_without_friction(const Scenario& scenario, report::Verdict& verdict, bool quiet);
/// Exit code of a run. If `shown.fail_infeasible`, it is 1 for a failed run, and 3 unless this run and every draw are feasible;
/// otherwise it is 0, also for a run that was not judged.
[[nodiscard]] int exit_code(const report::Verdict& verdict, const SummaryOptions& shown);

/// Text `version, build id, Bullet version and precision` of --version.
std::string version();

}  // namespace gaitlab::app
