// What the subcommands of the program share. Each has a file, and returns the exit code (docs/conventions.md: 0 ok, 1 failed
// run, 2 bad input, 3 infeasible, 4 regression).
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

/// Everything built in, and what these libraries register.
Catalog standard_catalog(const std::vector<std::string>& plugins = {});

/// What the command line allows of the plugins that scenarios and recorded runs name, where a command looks at what may be a
/// stranger's.
struct PluginArguments {
  bool from_scenario = false;      ///< all of them
  std::vector<std::string> files;  ///< these
};
/// Everything built in; of libraries that a scenario names those that are allowed. InputError: a file that is not there.
Catalog careful_catalog(const PluginArguments& allowed);
/// The command line as it was typed, for messages.
std::string& typed();

/// Module types or robots (`kind`: module, robot) that come with the program: name -> file.
std::map<std::string, std::string> shipped_files(const std::string& kind);

/// What every command that reads a scenario takes.
struct ScenarioArguments {
  std::string file;
  std::vector<std::string> sets;
  std::optional<std::string> seed;
  bool quiet = false;
};

/// Reads it with --set and --seed applied; prints its notes on stderr unless quiet.
Scenario read(const ScenarioArguments& arguments, Catalog& catalog);
/// Prints on stderr the checks that do not pass and have a remedy, at the place of the setting, and numbers that are not
/// finite.
void warn_of_run(const Scenario& scenario, const Recording& recording, const report::Verdict& verdict);
/// Prints on stderr that part of the robot starts below the ground, where it does.
void warn_of_start(const Scenario& scenario, bool quiet);

/// How much of a summary is printed.
struct SummaryOptions {
  bool verbose = false;          ///< the energy ledger and the step's limit, too
  bool joints = false;           ///< a row per joint
  bool fail_infeasible = false;  ///< exit code 3 where the verdict is so, 1 of a failed run
  bool demand = false;           ///< also run the demand twin (report/verdict/demand.h)
};

struct RunArguments : ScenarioArguments {
  std::optional<std::string> out;
  std::string format = "h5";
  bool no_page = false;  ///< without report.html
  SummaryOptions shown;
  std::vector<std::string> joints;  ///< names, of the figure; none: those of the scenario
};
/// Runs a scenario that is read: writes the run folder, prints the summary; the exit code.
int run(const Scenario& scenario, const RunArguments& arguments);

/// Prints the summary of a run, the verdict first.
void print_summary(const Scenario& scenario, const Recording& recording, const report::Summary& summary,
                   const report::Verdict& verdict, const SummaryOptions& shown);
/// The verdict on a run; where that is asked for with what its demand twin, which is simulated, takes.
report::Verdict judged(const Scenario& scenario, const Recording& recording, const report::Summary& summary,
                       const report::Overlaps& overlaps, const SummaryOptions& shown);
/// Where that is asked for 3 of an infeasible verdict and 1 of a failed run; else 0, also of what was not judged.
int exit_code(const report::Verdict& verdict, const SummaryOptions& shown);

/// `version, build id, Bullet version and precision`
std::string version();

}  // namespace gaitlab::app
