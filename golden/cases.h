// What `gaitlab test` is asked to test: scenarios, their goldens, and how each came out.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "golden/compare.h"
#include "golden/runs.h"

namespace gaitlab::golden {

struct TestArguments {
  std::vector<std::string> scenarios;     ///< files and folders; none: `scenarios`
  std::optional<std::string> golden;      ///< folder: of another scenario than the one that is run
  std::optional<std::string> engine;      ///< instead of the scenario's, with its own step and integrator
  std::optional<std::string> junit, out;  ///< file; folder for figures
  bool fail_infeasible = false;           ///< a run that the robot cannot do is a failure, too
  bool strict = false;                    ///< in a folder, too, every scenario must have a golden
  bool all = false;                       ///< show all columns, numbers and settings, not the worst and first
  int jobs = 1;                           ///< threads
};

/// From best to worst. The program's exit code is of the first of these that there is: bad_input 2, run_failed 1, regression 4,
/// infeasible 3.
enum class Verdict { passed, skipped, infeasible, bad_input, run_failed, regression };

struct GoldenCase {
  std::string file;                       ///< of the scenario, as given or found
  std::filesystem::path folder = {};      ///< of the golden
  bool given_golden = false;              ///< with --golden: may well be another scenario's
  std::optional<Golden> golden = {};      ///< read
  std::optional<Scenario> scenario = {};  ///< read
  bool other_engine = false;              ///< than the golden's
  GoldenRun run = {};
  GoldenDifference difference = {};
  Verdict verdict = Verdict::passed;
  std::string problem = {};  ///< what prevented the comparison: a whole text for stderr
  std::string figure = {};   ///< file that shows what strayed
  std::string page = {};     ///< file that shows both runs
  double seconds = 0;        ///< that the run took: for reports alone

  void fail(Verdict as, std::string text);
};

/// The golden beside a scenario. InputError where another scenario there (walk.yml for walk.yaml) would share it.
std::filesystem::path own_golden(const std::filesystem::path& scenario);

/// InputError where `golden` is another scenario's: another name, and a run that has left its bands. (A scenario that was only
/// renamed keeps its golden.)
void check_own(const Golden& golden, const std::filesystem::path& folder, const Scenario& scenario,
               const GoldenDifference& difference);

/// One case a scenario, in the order of the arguments, a folder's by name; each scenario once. A folder: its scenarios, and
/// those with a golden in the folders below it. A scenario without a golden is skipped, or with --strict a case that fails; so
/// is always a golden there without a scenario. Goldens and scenarios are read; what cannot be read is a verdict of that case.
/// InputError: neither scenario nor folder, a folder without scenarios, two scenarios with one golden, or --golden with
/// anything but one scenario.
std::vector<GoldenCase> golden_cases(const TestArguments& arguments, Catalog& catalog);

/// Runs and compares those that can be; `progress(share)` as of golden_runs.
void run_cases(std::vector<GoldenCase>& cases, const TestArguments& arguments,
               const std::function<void(double)>& progress = {});

/// `passed`, `FAILED`, `skipped: no golden` ...
std::string to_string(Verdict verdict);

}  // namespace gaitlab::golden
