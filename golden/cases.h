// Test cases of `gaitlab test`: scenarios, their goldens and results.
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
  std::vector<std::string> scenarios;     ///< files and folders; empty: `scenarios`
  std::optional<std::string> golden;      ///< folder of another scenario's golden
  std::optional<std::string> engine;      ///< replaces the scenario's, with the engine's default step and integrator
  std::optional<std::string> junit, out;  ///< file; folder for figures
  bool fail_infeasible = false;           ///< an infeasible run is a failure also
  bool strict = false;                    ///< every scenario in a folder must have a golden also
  bool all = false;                       ///< show all columns, numbers and settings, not only the worst and first
  int jobs = 1;                           ///< threads
};

/// From best to worst. The program's exit code is that of the first of these that occurs: bad_input 2, run_failed 1, regression
/// 4, infeasible 3.
enum class Verdict { passed, skipped, infeasible, bad_input, run_failed, regression };

struct GoldenCase {
  std::string file;                       ///< of the scenario, as given or found
  std::filesystem::path folder = {};      ///< of the golden
  bool given_golden = false;              ///< by --golden: may belong to another scenario
  std::optional<Golden> golden = {};      ///< read
  std::optional<Scenario> scenario = {};  ///< read
  bool other_engine = false;              ///< the run uses another engine than the golden
  GoldenRun run = {};
  GoldenDifference difference = {};
  Verdict verdict = Verdict::passed;
  std::string problem = {};  ///< reason why the comparison was not possible: a whole text for stderr
  std::string figure = {};   ///< file with the columns outside their bands
  std::string page = {};     ///< file with both runs
  double seconds = 0;        ///< duration of the run: for reports alone

  void fail(Verdict as, std::string text);
};

/// Path of the golden beside a scenario. Throws InputError if another scenario there (walk.yml for walk.yaml) would share it.
std::filesystem::path own_golden(const std::filesystem::path& scenario);

/// Throws InputError if `golden` belongs to another scenario: another name, and a run outside its bands. (A scenario that was
/// only renamed keeps its golden.)
void check_own(const Golden& golden, const std::filesystem::path& folder, const Scenario& scenario,
               const GoldenDifference& difference);

/// Collects one case per scenario, in the order of the arguments, those of a folder by name; each scenario once. For a folder:
/// its scenarios, and those with a golden in the folders below it. A scenario without a golden is skipped, or with --strict a
/// failing case, as is always a golden there without a scenario. Goldens and scenarios are read; an unreadable one is a verdict
/// of its case. Throws InputError for an argument that is neither scenario nor folder, a folder without scenarios, two
/// scenarios with one golden, or --golden with anything but one scenario.
std::vector<GoldenCase> golden_cases(const TestArguments& arguments, Catalog& catalog);

/// Runs the cases that can run and compares them; `progress(share)` as in golden_runs.
void run_cases(std::vector<GoldenCase>& cases, const TestArguments& arguments,
               const std::function<void(double)>& progress = {});

/// `passed`, `FAILED`, `skipped: no golden` ...
std::string to_string(Verdict verdict);

}  // namespace gaitlab::golden
