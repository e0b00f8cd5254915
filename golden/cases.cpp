#include "golden/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/scenario/other_engine.h"
#include "core/scenario/read_scenario.h"
#include "golden/runs.h"
#include "report/verdict/numbers/numbers.h"
#include "report/verdict/plausible/plausibility.h"
#include "report/verdict/verdict.h"

namespace gaitlab::golden {

namespace {

namespace fs = std::filesystem;

bool is_scenario(const fs::path& file) { return file.extension() == ".yaml" || file.extension() == ".yml"; }

/// True if a file or a broken link exists at a path. If this cannot be determined the result is false, and a later attempt to
/// read reports the reason.
bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

/// Scenarios in folders, and orphans: goldens without a scenario, which may have been lost unnoticed.
struct Found {
  std::vector<fs::path> scenarios, orphans;
};

/// Path of a golden's scenario, or an empty path.
fs::path scenario_of(const fs::path& golden) {
  for (const char* extension : {".yaml", ".yml"}) {
    fs::path file = fs::path(golden).replace_extension(extension);
    if (is_there(file)) return file;
  }
  return {};
}

/// Finds all scenarios of a folder and, in its subfolders, only scenarios with a golden, because other YAML files need not be
/// scenarios.
void find_in(const fs::path& folder, bool top, Found& found) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    std::error_code unknown;  // a loop of links is not a folder; its case reports that
    const bool is_folder = fs::is_directory(path, unknown);
    if (top && is_scenario(path) && !is_folder) found.scenarios.push_back(path);
    if (!is_folder) continue;
    if (path.extension() != ".golden") {
      if (!entry.is_symlink()) find_in(path, false, found);
      continue;
    }
    const fs::path scenario = scenario_of(path);
    if (scenario.empty()) found.orphans.push_back(path);
    if (!scenario.empty() && !top) found.scenarios.push_back(scenario);
  }
  if (error) throw InputError(SourceLocation{folder.string()}, "cannot be read: " + error.message());
}

Found found_in(const fs::path& folder) {
  Found found;
  find_in(folder, true, found);
  if (found.scenarios.empty()) throw InputError(SourceLocation{folder.string()}, "holds no scenario (*.yaml, *.yml)");
  std::sort(found.scenarios.begin(), found.scenarios.end());
  std::sort(found.orphans.begin(), found.orphans.end());
  return found;
}

/// True if the scenario bounds its differences from a log, so that it is a case without a golden. An error in the file is
/// reported where its golden is looked for.
bool states_bound(const fs::path& file) {
  try {
    const Node root = read_yaml(file.string());
    const Node* const measured = root.find(kMeasuredSection);
    return measured != nullptr && measured->find("bound") != nullptr;
  } catch (const InputError&) {
    return false;
  }
}

GoldenCase case_of(const fs::path& file, const std::optional<std::string>& golden, bool must) {
  GoldenCase c{file.string()};
  try {
    c.folder = golden ? fs::path(*golden) : own_golden(file);
    c.given_golden = golden.has_value();
    if (kind_of(file) == fs::file_type::not_found)
      throw InputError(SourceLocation{c.file}, "is a link to a file that does not exist");
    if (golden || is_there(c.folder)) {
      c.golden = read_golden(c.folder);
    } else if (states_bound(file)) {
      return c;
    } else if (!must) {
      c.verdict = CaseVerdict::skipped;
    } else {
      throw InputError(SourceLocation{c.file},
                       fmt::format("has no golden ({} does not exist); make it: gaitlab approve {} --reason TEXT",
                                   c.folder.string(), c.file));
    }
  } catch (const InputError& error) {
    c.fail(CaseVerdict::bad_input, error.what());
  }
  return c;
}

GoldenCase orphan(const fs::path& golden) {
  GoldenCase c{golden.string()};
  c.fail(CaseVerdict::bad_input,
         fmt::format(
             "{}: error: has no scenario ({} does not exist); rename or remove this golden in the same way as its scenario",
             c.file, fs::path(golden).replace_extension(".yaml").string()));
  return c;
}

// Scenario with another engine, or with the explicit integrator of the golden's own engine, which shares nothing with the
// golden. A golden with given steps keeps its step, which belongs to its bands, and its integrator; otherwise order 2.
Scenario with_engine(const std::string& file, const Scenario& scenario, const std::string& name, double step,
                     Catalog& catalog) {
  const Engine* engine = catalog.engine(name);
  if (engine == nullptr) {
    const std::string near = nearest(name, catalog.engines());
    throw InputError(SourceLocation{"--engine"},
                     fmt::format("engine '{}' is unknown; {}", name,
                                 near.empty() ? fmt::format("there are: {}", fmt::join(catalog.engines(), ", "))
                                              : "did you mean '" + near + "'?"));
  }
  const bool adaptive = scenario.physics.adaptive_step;
  if (scenario.physics.engine == engine && !(adaptive && engine->choose_step != nullptr)) return scenario;
  const Integrator* wanted = engine->choose_step != nullptr ? &engine->fixed() : engine->adaptive();
  if (!adaptive) wanted = engine->integrator(scenario.physics.integrator->name);
  if (wanted == nullptr) wanted = engine->integrator("extrapolated");
  const Integrator& integrator = wanted != nullptr ? *wanted : engine->fixed();
  return read_scenario(file, engine_settings(scenario, name, integrator, adaptive ? "auto" : fmt::format("{}", step)), catalog);
}

void read_case(GoldenCase& c, const std::optional<std::string>& engine, Catalog& catalog) {
  try {
    Scenario scenario = read_scenario(c.file, {}, catalog);
    report::check_accepted(scenario);
    const bool chosen = scenario.physics.adapts();
    if (engine) {
      const double step = c.golden ? c.golden->origin.step : scenario.physics.step;
      scenario = with_engine(c.file, scenario, *engine, step, catalog);
    }
    if (!c.golden) {
      c.scenario = std::move(scenario);
      return;
    }
    take_golden_accuracy(scenario);
    c.other_engine = scenario.physics.engine->name != c.golden->origin.engine ||
                     (engine && scenario.physics.integrator->name != c.golden->origin.integrator);
    if (chosen && !scenario.physics.adapts()) {  // the bands contain no error of a given step
      c.halved = scenario;
      c.halved->physics.refine(2);
    }
    c.scenario = std::move(scenario);
  } catch (const InputError& error) {
    if (error.problems().front().place.file == "--engine") throw;  // the error is not in the scenario
    c.fail(CaseVerdict::bad_input, error.what());
  }
}

/// Compares the run of a case with its golden; `halved` is that of GoldenCase::halved, or null.
void judge(GoldenCase& c, const Attempt& outcome, const Attempt* halved) {
  c.seconds = outcome.seconds + (halved != nullptr ? halved->seconds : 0);
  try {
    if (outcome.error) std::rethrow_exception(outcome.error);
    if (halved != nullptr && halved->error) std::rethrow_exception(halved->error);
  } catch (const InputError& error) {
    c.fail(CaseVerdict::bad_input, error.what());
    return;
  } catch (const RunError& error) {
    c.fail(CaseVerdict::run_failed, fmt::format("{}: error: {}", c.file, error.what()));
    return;
  }
  c.run = outcome.run;
  if (c.golden) c.difference = compare(*c.golden, c.run, c.other_engine, halved != nullptr ? &halved->run : nullptr);
  c.difference.bounds = c.run.bounds;
  if (!c.difference.passed()) c.verdict = CaseVerdict::regression;
  if (!c.golden) return;
  try {
    // If the columns are the same, the golden may belong to a scenario that was renamed and changed. This is a regression,
    // whose message contains both names.
    const std::size_t columns = c.golden->run.trace.columns.size();  // `t` only for means over starts
    if (!c.given_golden && (c.run.trace.columns.size() != columns || c.difference.columns.size() + 1 != columns))
      check_own(*c.golden, c.folder, *c.scenario, c.difference);
  } catch (const InputError& error) {
    c.fail(CaseVerdict::bad_input, error.what());
  }
}

}  // namespace

void GoldenCase::fail(CaseVerdict as, std::string text) {
  verdict = as;
  problem = std::move(text);
}

fs::path own_golden(const fs::path& scenario) {
  for (const char* extension : {".yaml", ".yml"}) {
    const fs::path other = fs::path(scenario).replace_extension(extension);
    if (other.extension() == scenario.extension() || !is_there(other)) continue;
    throw InputError(SourceLocation{scenario.string()},
                     fmt::format("would share its golden, {}, with {}; rename one of them", golden_folder(scenario).string(),
                                 other.filename().string()));
  }
  return golden_folder(scenario);
}

void check_own(const Golden& golden, const fs::path& folder, const Scenario& scenario, const GoldenDifference& difference) {
  if (golden.origin.name == scenario.name || difference.passed()) return;
  throw InputError(
      SourceLocation{folder.string()},
      fmt::format("is the golden of '{}', but {} ('{}') is another run; gaitlab approve --replace makes a golden of this run",
                  golden.origin.name, scenario.file, scenario.name));
}

std::vector<GoldenCase> golden_cases(const TestArguments& arguments, Catalog& catalog) {
  std::vector<std::string> given = arguments.scenarios;
  if (given.empty()) given.emplace_back("scenarios");
  if (arguments.golden && (given.size() != 1 || kind_of(given.front()) == fs::file_type::directory))
    throw InputError(SourceLocation{"--golden"}, "is the golden of one scenario; name exactly one scenario with it");
  std::vector<GoldenCase> cases;
  std::set<std::string> seen;
  const auto add = [&](const fs::path& file, bool must) {
    // A link is a separate scenario with a separate golden. Only its folder is therefore made canonical.
    const fs::path name = fs::weakly_canonical(fs::absolute(file).parent_path()) / file.filename();
    if (seen.insert(name.string()).second) cases.push_back(case_of(file, arguments.golden, must));
  };
  for (const std::string& path : given) {  // scenarios named as files are first, because they must have a golden
    const fs::file_type kind = kind_of(path);
    if (kind == fs::file_type::not_found) throw InputError(SourceLocation{path}, "there is no such scenario or folder");
    if (kind != fs::file_type::directory) add(path, true);
  }
  for (const std::string& path : given) {
    if (kind_of(path) != fs::file_type::directory) continue;
    const Found found = found_in(path);
    for (const fs::path& file : found.scenarios) add(file, arguments.strict);
    for (const fs::path& golden : found.orphans) cases.push_back(orphan(golden));
  }
  for (GoldenCase& c : cases) {
    if (c.verdict == CaseVerdict::passed) read_case(c, arguments.engine, catalog);
  }
  return cases;
}

void run_cases(std::vector<GoldenCase>& cases, const TestArguments& arguments, const std::function<void(double)>& progress) {
  std::vector<Scenario> scenarios;
  for (const GoldenCase& c : cases) {
    const auto add = [&](const Scenario& s) {
      scenarios.push_back(c.golden ? with_golden_columns(s, c.golden->selected, &c.golden->run.trace) : s);
    };
    if (c.scenario) add(*c.scenario);
    if (c.halved) add(*c.halved);
  }
  const std::vector<Attempt> outcomes = golden_runs(scenarios, arguments.jobs, progress, true);
  auto outcome = outcomes.begin();
  for (GoldenCase& c : cases) {
    if (!c.scenario) continue;
    const Attempt& run = *outcome++;
    judge(c, run, c.halved ? &*outcome++ : nullptr);
    if (arguments.fail_infeasible && c.verdict == CaseVerdict::passed && report::has_motors(*c.scenario) &&
        c.run.verdict != Word::feasible)
      c.fail(CaseVerdict::infeasible, fmt::format("{}: {}: {}", c.file, name_of(*c.run.verdict), c.run.why));
  }
}

std::string to_string(CaseVerdict verdict) {
  switch (verdict) {
    case CaseVerdict::passed:
      return "passed";
    case CaseVerdict::skipped:
      return "skipped: no golden";
    case CaseVerdict::infeasible:
      return "INFEASIBLE";
    case CaseVerdict::bad_input:
      return "NOT TESTED";
    case CaseVerdict::run_failed:
      return "RUN FAILED";
    case CaseVerdict::regression:
      break;
  }
  return "FAILED";
}

}  // namespace gaitlab::golden
