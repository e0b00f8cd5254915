// Functions that the subcommands share. Each subcommand has a file, and returns the exit code (docs/conventions.md: 0 ok, 1
// failed run, 2 bad input, 3 infeasible, 4 regression).
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"
#include "report/analysis/summary.h"
#include "report/verdict/verdict.h"

namespace gaitlab::app {

/// Catalog of everything built in and of these plugin libraries.
Catalog standard_catalog(const std::vector<std::string>& plugins = {});

/// Plugins allowed by the command line among those named by scenarios and recorded runs, for commands that may read files from
/// unknown sources.
struct PluginArguments {
  bool from_scenario = false;      ///< all plugins
  std::vector<std::string> files;  ///< these plugins
};
/// Catalog of everything built in, which loads only allowed libraries of a scenario. Throws InputError for a file that does not
/// exist.
Catalog careful_catalog(const PluginArguments& allowed);
/// The command line as typed, for messages.
std::string& typed();

/// Module types or robots (`kind`: module, robot) shipped with the program: name -> file.
std::map<std::string, std::string> shipped_files(const std::string& kind);

/// Arguments of every command that reads a scenario.
struct ScenarioArguments {
  std::string file;
  std::vector<std::string> sets;
  std::optional<std::string> seed;
  bool quiet = false;
};

/// Reads the scenario with --set and --seed applied; prints its notes on stderr unless quiet.
Scenario read(const ScenarioArguments& arguments, Catalog& catalog);
/// Prints on stderr the checks that do not pass and have a remedy, at the place of the setting, and numbers that are not
/// finite.
void warn_of_run(const Scenario& scenario, const Recording& recording, const report::Verdict& verdict);
/// Prints a warning on stderr if part of the robot starts below the ground.
void warn_of_start(const Scenario& scenario, bool quiet);

/// Extent of a printed summary.
struct SummaryOptions {
  bool verbose = false;          ///< also the energy ledger and the step's limit
  bool joints = false;           ///< a row per joint
  bool fail_infeasible = false;  ///< exit code 3 for an infeasible verdict, 1 for a failed run
  bool demand = false;           ///< also run the demand twin (report/verdict/demand.h)
};

struct RunArguments : ScenarioArguments {
  std::optional<std::string> out;
  std::string format = "h5";
  bool no_page = false;  ///< without report.html
  SummaryOptions shown;
  std::vector<std::string> joints;  ///< names, in the figure; empty: those of the scenario
};
/// Runs a scenario: writes the run folder and prints the summary; returns the exit code.
int run(const Scenario& scenario, const RunArguments& arguments);

/// Prints the summary of a run, the verdict first.
void print_summary(const Scenario& scenario, const Recording& recording, const report::Summary& summary,
                   const report::Verdict& verdict, const SummaryOptions& shown);
/// Verdict on a run, on request with the results of its demand twin, which is simulated.
report::Verdict judged(const Scenario& scenario, const Recording& recording, const report::Summary& summary,
                       const report::Overlaps& overlaps, const SummaryOptions& shown);
/// Exit code: on request 3 for an infeasible verdict and 1 for a failed run; else 0, also for a run that was not judged.
int exit_code(const report::Verdict& verdict, const SummaryOptions& shown);

/// `version, build id, Bullet version and precision`
std::string version();

}  // namespace gaitlab::app
