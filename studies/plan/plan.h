// The runs of a study, by number: the settings of each, and the content of its row in the journal.
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
  /// Binds the study to its scenarios and tries the first and the last run. InputError with every problem found, before
  /// anything runs.
  Plan(Study study, const QuantityOffer& offer, Catalog& catalog);

  [[nodiscard]] const BoundStudy& bound() const { return bound_; }
  [[nodiscard]] const Study& study() const { return bound_.study(); }
  /// The first scenario, with the study's own settings.
  [[nodiscard]] const Scenario& scenario() const { return scenarios().front().nominal; }
  [[nodiscard]] const std::vector<StudyScenario>& scenarios() const { return bound_.scenarios(); }
  [[nodiscard]] double longest() const { return bound_.longest(); }
  [[nodiscard]] const Judge& judge() const { return bound_.judge(); }
  [[nodiscard]] const StopRules& stops() const { return bound_.stops(); }
  [[nodiscard]] const std::vector<Quantity>& columns() const { return bound_.columns(); }

  [[nodiscard]] const Points& points() const { return points_; }
  /// Largest number of runs of a method that chooses points by earlier results: its budget.
  [[nodiscard]] std::uint64_t most_runs() const { return points_.runs(); }
  /// The next point of a study whose points are chosen by what came out, or by another program.
  void add(std::vector<std::string> values) { points_.add(std::move(values)); }
  /// Raises the budget to at least `runs`, in whole points. False: the study has no budget.
  bool raise_budget(std::uint64_t runs);
  /// Name of a point with these values in the journal, the same in every study of the scenario, or scenarios.
  [[nodiscard]] std::string point_name(const std::vector<std::string>& values) const;

  /// Settings of a run after the study's, in the form of --set.
  [[nodiscard]] std::vector<std::string> sets(std::uint64_t run) const;
  /// The same, were its point one with these values.
  [[nodiscard]] std::vector<std::string> sets(const std::vector<std::string>& values, std::uint64_t run) const;
  /// As BoundStudy::with; that of a run.
  [[nodiscard]] Scenario with(const std::vector<std::string>& sets, std::size_t scenario) const {
    return bound_.with(sets, scenario);
  }
  [[nodiscard]] Scenario scenario(std::uint64_t run) const { return with(sets(run), points_.scenario(run)); }
  /// Settings that select the engine of `verify`, with its default step; empty: the run's scenario has that engine, or `verify`
  /// has none.
  [[nodiscard]] const std::vector<std::string>& other_engine(std::uint64_t run) const {
    return scenarios()[points_.scenario(run)].other_engine;
  }

  /// Whether the torque error is estimated for runs of this point: drawn from the seed and its name. If the draw leaves fewer
  /// than Estimated::kFewest runs of a sweep, all are estimated.
  [[nodiscard]] bool estimates(const std::string& point) const;

  /// The row of a run with the values known before the run.
  [[nodiscard]] Row row(std::uint64_t run) const;
  /// Fills in the results of the run.
  void finish(Row& row, const Scenario& scenario, const Recording& recording, const Measure& measure) const;

 private:
  /// Numbers of a point with these values in a scenario, by key.
  [[nodiscard]] std::map<std::string, double> nominal(const std::vector<std::string>& values, std::size_t scenario) const;
  [[nodiscard]] bool drawn_for_estimate(const std::string& point) const;
  [[nodiscard]] bool draws_too_few() const;

  BoundStudy bound_;
  std::string scenario_digest_;
  Points points_;
  bool all_estimated_ = false;
};

}  // namespace gaitlab::studies
