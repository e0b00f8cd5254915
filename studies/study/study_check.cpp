// Checks for contradictory settings of a study.
#include <fmt/format.h>

#include <algorithm>

#include "studies/study/population.h"
#include "studies/study/study_file.h"

namespace gaitlab::studies {

namespace {

void check_search(const Study& study, Problems& problems) {
  const SourceLocation& place = study.place;
  const std::string method = std::string("method ") + name_of(study.method);
  const std::int64_t population = study.search.population;
  if (std::ranges::none_of(study.parameters, [](const Parameter& p) { return p.values.empty(); }))
    problems.add(place, method + " has nothing to search: no parameter has `low` and `high`");
  const auto& row = enum_row(study.method);
  if (row.several != (study.objectives.size() > 1)) {
    problems.add(place, fmt::format("{} is for {}; expected {}", method,
                                    row.several ? "two or three objectives" : "one objective", searches_text(!row.several)));
  }
  if (row.multiple > 1 && (population % row.multiple != 0 || (population > 0 && population < row.population))) {
    problems.add(place, fmt::format("a population of {} does not suit {}; expected a multiple of {} that is at least {}",
                                    population, method, row.multiple, row.population));
  } else if (population > 0 && population < row.population) {
    problems.add(
        place, fmt::format("a population of {} is too small for {}; expected at least {}", population, method, row.population));
  } else if (population > row.most) {
    problems.add(place,
                 fmt::format("a population of {} is too large for {}; expected at most {}", population, method, row.most));
  }
}

/// Refuses a second setting of a key that follows a parameter.
void check_followers(const Study& study, Problems& problems) {
  for (const Parameter& own : study.parameters) {
    for (const Follower& f : own.sets) {
      for (const Parameter& other : study.parameters) {
        const auto also = [&](const Follower& one) { return one.key == f.key; };
        if (other.key == f.key) {
          problems.add(f.place, fmt::format("{} is computed from {} and is also a parameter; expected only one of the two",
                                            f.key, own.key));
        }
        if (&other < &own && std::ranges::any_of(other.sets, also)) {
          problems.add(f.place, fmt::format("{} is computed from {} and from {}; expected only one of the two", f.key,
                                            other.key, own.key));
        }
      }
      const auto drawn = [&](const Variation& v) { return v.key == f.key && !v.times; };
      if (std::ranges::any_of(study.replicates.vary, drawn)) {
        problems.add(f.place, fmt::format("{} is computed from {} and also drawn for every replicate; expected vary: {{{}: "
                                          "{{times: ...}}}}, or only one of the two",
                                          f.key, own.key, f.key));
      }
    }
  }
}

/// Refuses the seed as a parameter, follower or variation, because the replicates set it.
void check_seed(const Study& study, Problems& problems) {
  constexpr const char* kWhy = "seed cannot be chosen here; expected replicates: {count: N}, whose runs differ in their seed";
  for (const Parameter& p : study.parameters) {
    if (p.key == "seed") problems.add(p.place, kWhy);
    for (const Follower& f : p.sets) {
      if (f.key == "seed") problems.add(f.place, kWhy);
    }
  }
  for (const Variation& v : study.replicates.vary) {
    if (v.key == "seed") problems.add(v.place, kWhy);
  }
}

/// Checks the values of a parameter against the method and the replicates.
void check_parameter(const Study& study, const Parameter& p, Problems& problems) {
  if (study.method == Method::grid && !p.in_grid())
    problems.add(p.place, p.key + " has no count; expected one for a grid, or method: {type: random} or sobol");
  if (study.of_sensitivity() && !p.values.empty()) {
    problems.add(p.place,
                 fmt::format("{} has a list of values, but method {} needs `low` and `high`", p.key, name_of(study.method)));
  }
  if (study.method != Method::grid && p.count > 0 && !study.asked) {
    problems.add(p.place,
                 fmt::format("{} has a count, which only method grid uses; method.type is {}", p.key, name_of(study.method)));
  }
  const auto same = [&](const Variation& v) { return v.key == p.key && !v.times; };
  if (std::ranges::any_of(study.replicates.vary, same)) {
    problems.add(p.place, p.key + " is a parameter and drawn for every replicate; expected vary: {" + p.key +
                              ": {times: ...}}, or one of the two");
  }
}

/// Checks the number of runs of methods without a budget.
void check_size(const Study& study, Problems& problems) {
  constexpr double kMostRuns = 1e9;
  double runs = static_cast<double>(study.runs_of_point());
  for (const Parameter& p : study.parameters)
    runs *= static_cast<double>(p.values.empty() ? p.count : static_cast<std::int64_t>(p.values.size()));
  const auto blocks = static_cast<double>(study.method == Method::morris ? study.trajectories : study.samples);
  const double runs_of_blocks = blocks * static_cast<double>((study.parameters.size() + 2) * study.runs_of_point());
  if (study.of_sensitivity() && runs_of_blocks > kMostRuns)
    problems.add(study.place, fmt::format("the study has {:.3g} runs; expected at most {:g}", runs_of_blocks, kMostRuns));
  if (study.method == Method::grid && runs > kMostRuns)
    problems.add(study.place, fmt::format("the grid has {:.3g} runs; expected at most {:g}", runs, kMostRuns));
}

/// Reason why the number of runs of a study is impossible; empty if it is possible.
std::string wrong_budget(const Study& study) {
  const std::string method = std::string("method ") + name_of(study.method);
  const auto runs = static_cast<std::uint64_t>(study.runs);
  if (study.method == Method::grid) return runs > 0 ? method + " runs every combination; remove `budget: {runs: ...}`" : "";
  if (study.of_sensitivity()) {
    if (runs == 0) return "";
    return fmt::format("{} takes no budget of runs; expected method: {{{}: N}}", method,
                       study.method == Method::morris ? "trajectories" : "samples");
  }
  if (runs == 0) return fmt::format("missing budget: {{runs: N}}, which {} needs", method);
  if (is_search(study.method) && runs < least_runs(study)) {
    return fmt::format("a budget of {} runs is too small: the first generation of all searches has {} runs", runs,
                       least_runs(study));
  }
  if (runs >= study.runs_of_point()) return "";
  return fmt::format("a budget of {} runs is less than the {} {} of one point", runs, study.runs_of_point(),
                     study.scenarios.empty() ? "replicates" : "runs");
}

/// Least number of runs that a study can have; 0 for a method without a budget.
std::uint64_t least_budget(const Study& study) {
  if (is_search(study.method)) return least_runs(study);
  return study.method == Method::grid || study.of_sensitivity() ? 0 : study.runs_of_point();
}

}  // namespace

void check_study(const Study& study, Problems& problems) {
  if (is_search(study.method)) check_search(study, problems);
  check_followers(study, problems);
  check_seed(study, problems);
  for (const Parameter& p : study.parameters) check_parameter(study, p, problems);
  if (study.asked) return;
  if (!study.starts.empty() && !is_search(study.method)) {
    problems.add(study.starts.front().place,
                 fmt::format("start is for searches such as scbo; method {} does not search", name_of(study.method)));
  }
  check_size(study, problems);
}

void check_budget(Study& study, Problems& problems) {
  if (study.asked) return;
  const std::string wrong = wrong_budget(study);
  if (wrong.empty()) return;
  problems.add(study.place, wrong);
  study.runs = static_cast<std::int64_t>(least_budget(study));
}

}  // namespace gaitlab::studies
