// The runs of a study by number: the settings of each run, and the content of its row in the journal.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "studies/journal/journal.h"
#include "studies/plan/bound_study.h"
#include "studies/plan/points.h"

namespace gaitlab::studies {

class Plan {
 public:
  /// Reads and checks the study with its scenarios, and tries the settings of the first and the last run, and each listed
  /// value. Throws InputError with every problem found, before any run starts.
  Plan(Study study, const QuantityOffer& offer, Catalog& catalog);

  [[nodiscard]] const BoundStudy& bound() const { return bound_; }
  [[nodiscard]] const Study& study() const { return bound_.study(); }
  /// The first scenario, with the settings that the study applies to all runs.
  [[nodiscard]] const Scenario& scenario() const { return scenarios().front().nominal; }
  [[nodiscard]] const std::vector<StudyScenario>& scenarios() const { return bound_.scenarios(); }
  [[nodiscard]] double longest() const { return bound_.longest(); }
  [[nodiscard]] const Scorer& scorer() const { return bound_.scorer(); }
  [[nodiscard]] const StopRules& stops() const { return bound_.stops(); }
  [[nodiscard]] const std::vector<Quantity>& columns() const { return bound_.columns(); }

  [[nodiscard]] const Points& points() const { return points_; }
  /// Largest number of runs (budget) of a method that chooses points by earlier results.
  [[nodiscard]] std::uint64_t most_runs() const { return points_.runs(); }
  /// Adds the next point of a search, or of another program that chooses the points.
  void add(std::vector<std::string> values) { points_.add(std::move(values)); }
  /// Raises the budget to at least `runs`, rounded to whole points. Returns false if the study does not have a budget.
  bool raise_budget(std::uint64_t runs);
  /// Name in the journal of a point with these values. The name is the same in every study of the same scenarios.
  [[nodiscard]] std::string point_name(const std::vector<std::string>& values) const;

  /// Settings of a run in addition to those of the study, in the form of --set.
  [[nodiscard]] std::vector<std::string> sets(std::uint64_t run) const;
  /// Settings of a run as if its point had these values.
  [[nodiscard]] std::vector<std::string> sets(const std::vector<std::string>& values, std::uint64_t run) const;
  /// The scenario with this number and with additional settings, as in BoundStudy::with.
  [[nodiscard]] Scenario with(const std::vector<std::string>& sets, std::size_t scenario) const {
    return bound_.with(sets, scenario);
  }
  [[nodiscard]] Scenario scenario(std::uint64_t run) const { return with(sets(run), points_.scenario(run)); }
  /// Settings that select the engine of `verify` with its default step. Empty if `verify` names no engine, or if the run's
  /// scenario uses that engine already.
  [[nodiscard]] const std::vector<std::string>& other_engine(std::uint64_t run) const {
    return scenarios()[points_.scenario(run)].other_engine;
  }

  /// True if the torque error of this point's runs is estimated. The choice is drawn from the seed and the name of the point.
  /// If fewer than Estimated::kFewest runs of a sweep would be drawn, all points have an estimate.
  [[nodiscard]] bool estimates(const std::string& point) const;

  /// The row of a run with the values that are known before the run.
  [[nodiscard]] Row row(std::uint64_t run) const;
  /// Writes the results of the run into its row.
  void finish(Row& row, const Scenario& scenario, const Recording& recording, const Measure& measure) const;
  /// Scores a row with quantities. A stopped run that breaks no limit gets no score, because it must not be kept.
  void score(Row& row) const;

 private:
  /// Settings of the run's world in a robust study. `sets` are those of the run itself. Empty for the nominal run, and if the
  /// scenario refuses `sets`.
  [[nodiscard]] std::vector<std::string> of_world(const std::vector<std::string>& sets, std::uint64_t run) const;
  /// Seed of a run.
  [[nodiscard]] std::int64_t seed(std::uint64_t run) const;
  /// Numeric values of a scenario's keys at a point with these parameter values.
  [[nodiscard]] std::map<std::string, double> nominal(const std::vector<std::string>& values, std::size_t scenario) const;
  [[nodiscard]] bool drawn_for_estimate(const std::string& point) const;
  [[nodiscard]] bool draws_too_few() const;

  /// Tries each listed value of each parameter with the scenario's other keys. If it is refused, tries it with every
  /// combination of the other listed values, at the low and then the high ends of the ranges. Adds the values that are always
  /// refused, because no run could have them. A value counts as possible if there are more than 1000 combinations. If no value
  /// is added, tries the settings of the first and the last run. If both are refused, adds the problems of the first, such as a
  /// misspelt key. Adds nothing at places that already have a problem.
  void check_settings(Problems& problems) const;

  BoundStudy bound_;
  std::string scenario_digest_;
  Points points_;
  bool all_estimated_ = false;
};

}  // namespace gaitlab::studies
