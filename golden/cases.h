// Test cases of `gaitlab test`, with their scenarios, goldens and results.
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
  std::vector<std::string> scenarios;     ///< files and folders; empty for the folder `scenarios`
  std::optional<std::string> golden;      ///< folder of the golden to compare with, instead of the scenario's own
  std::optional<std::string> engine;      ///< engine in place of the scenario's, with its default step and integrator
  std::optional<std::string> junit, out;  ///< junit: file for results as XML; out: folder for figures
  bool fail_infeasible = false;           ///< true if an infeasible run is a failure
  bool strict = false;                    ///< true if every scenario in a folder must have a golden
  /// True to show all columns, numbers and settings. Otherwise only the worst columns and numbers and the first settings are
  /// shown.
  bool all = false;
  int jobs = 1;  ///< number of threads
};

/// Result of a case, in the order from best to worst. The exit code of the program is that of the first of these results that
/// any case has: bad_input 2, run_failed 1, regression 4, infeasible 3.
enum class CaseVerdict { passed, skipped, infeasible, bad_input, run_failed, regression };

struct GoldenCase {
  std::string file;                       ///< path of the scenario, as given or found
  std::filesystem::path folder = {};      ///< folder of the golden
  bool given_golden = false;              ///< true if given by --golden: the golden may belong to another scenario
  std::optional<Golden> golden = {};      ///< empty until it has been read, and for a scenario that only bounds measured.*
  std::optional<Scenario> scenario = {};  ///< empty until it has been read
  bool other_engine = false;              ///< true if the run uses another engine than the golden
  std::optional<Scenario> halved = {};    ///< the scenario with half its step, if the golden's bands are not those of its step
  GoldenRun run = {};
  GoldenDifference difference = {};
  CaseVerdict verdict = CaseVerdict::passed;
  std::string problem = {};  ///< text for stderr with the reason why no comparison was possible
  std::string figure = {};   ///< path of a file with the columns outside their bands
  std::string page = {};     ///< path of a file with both runs
  double seconds = 0;        ///< duration of the run, for reports only, s

  void fail(CaseVerdict as, std::string text);
};

/// Path of the golden of a scenario. Throws InputError if another scenario in the same folder (walk.yml for walk.yaml) would
/// share it.
std::filesystem::path own_golden(const std::filesystem::path& scenario);

/// Throws InputError if `golden` belongs to another scenario: it has another name, and the run is outside the bands. A scenario
/// that was only renamed keeps its golden.
void check_own(const Golden& golden, const std::filesystem::path& folder, const Scenario& scenario,
               const GoldenDifference& difference);

/// Collects one case per scenario, in the order of the arguments, with the scenarios of a folder sorted by name. Each scenario
/// occurs once. A folder means its scenarios, and the scenarios with a golden in the folders below it. A scenario without a
/// golden is skipped, or is a failing case with --strict, unless it states `measured.bound`. The case of a golden without a
/// scenario always fails. Goldens and scenarios are read here; an error in either is the result of its case. Throws InputError
/// for an argument that is neither scenario nor folder, for a folder without scenarios, for two scenarios with one golden, and
/// for --golden unless there is exactly one scenario.
std::vector<GoldenCase> golden_cases(const TestArguments& arguments, Catalog& catalog);

/// Runs all cases that can run and compares the results with the goldens. `progress(share)` is as in golden_runs().
void run_cases(std::vector<GoldenCase>& cases, const TestArguments& arguments,
               const std::function<void(double)>& progress = {});

/// Text such as `passed`, `FAILED` or `skipped: no golden`.
std::string to_string(CaseVerdict verdict);

}  // namespace gaitlab::golden
