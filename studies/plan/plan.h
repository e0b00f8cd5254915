// A study bound to its scenarios: what each run is, and what its row in the journal holds.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "studies/journal/journal.h"
#include "studies/plan/points.h"
#include "studies/plan/stop_rules.h"
#include "studies/study/followers.h"
#include "studies/study/judge.h"
#include "studies/study/scenarios.h"

namespace gaitlab::studies {

class Plan {
 public:
  /// Reads the scenarios and checks the study against each. InputError with every problem found, before anything runs.
  Plan(Study study, const QuantityOffer& offer, Catalog& catalog);

  [[nodiscard]] const Study& study() const { return study_; }
  /// The first scenario, with the study's own settings.
  [[nodiscard]] const Scenario& scenario() const { return scenarios_.front().nominal; }
  [[nodiscard]] const std::vector<StudyScenario>& scenarios() const { return scenarios_; }
  /// Duration of the longest scenario, s.
  [[nodiscard]] double longest() const;
  [[nodiscard]] const Points& points() const { return points_; }
  /// Of a method that chooses points by what came out: its budget.
  [[nodiscard]] std::uint64_t most_runs() const { return points_.runs(); }
  [[nodiscard]] const Judge& judge() const { return *judge_; }
  [[nodiscard]] const StopRules& stops() const { return *stops_; }
  /// Ends of parameters that a scenario refuses, its other keys as they are.
  [[nodiscard]] std::vector<Problem> refused_ends() const;
  /// Parameters whose slowest gait does not have the three periods in the run that a verdict needs.
  [[nodiscard]] std::vector<Problem> short_runs() const;
  [[nodiscard]] const std::vector<Quantity>& columns() const { return columns_; }
  /// Quantities to show, by column: those that the study's patterns name, in the order of the patterns; without any the speed.
  [[nodiscard]] const std::vector<std::size_t>& shown() const { return shown_; }

  /// The next point of a study whose points are chosen by what came out, or by another program.
  void add(std::vector<std::string> values) { points_.add(std::move(values)); }
  /// A budget of at least so many runs, in whole points. False: the study has no budget.
  bool raise_budget(std::uint64_t runs);
  /// What a point with these values is called in the journal, the same in every study of the scenario, or scenarios.
  [[nodiscard]] std::string point_name(const std::vector<std::string>& values) const;

  /// Settings of a run behind the study's own, as for --set.
  [[nodiscard]] std::vector<std::string> sets(std::uint64_t run) const;
  /// A scenario by its number with these settings; that of a run. InputError: it is refused with these values. One thread at a
  /// time.
  [[nodiscard]] Scenario with(const std::vector<std::string>& sets, std::size_t scenario) const {
    return scenarios_[scenario].file->with(sets);
  }
  [[nodiscard]] Scenario scenario(std::uint64_t run) const { return with(sets(run), points_.scenario(run)); }
  /// Settings that take the engine of `verify`, with its own step; empty: that is the engine of the run's scenario, or none.
  [[nodiscard]] const std::vector<std::string>& other_engine(std::uint64_t run) const {
    return scenarios_[points_.scenario(run)].other_engine;
  }
  [[nodiscard]] bool has_other_engine() const;

  /// Whether the torque error of a run of this point is estimated: drawn by the seed and its name.
  [[nodiscard]] bool estimates(const std::string& point) const;

  /// The row of a run as far as it is known before the run.
  [[nodiscard]] Row row(std::uint64_t run) const;
  /// Fills in how it ended.
  void finish(Row& row, const Scenario& scenario, const Recording& recording, const Measure& measure) const;

  /// What makes two studies the same, as text; the number of drawn points is no part of it.
  [[nodiscard]] std::string definition() const;
  [[nodiscard]] JournalHead head() const;

 private:
  /// Of a point with these values in a scenario, by key.
  [[nodiscard]] std::map<std::string, double> nominal(const std::vector<std::string>& values, std::size_t scenario) const;
  [[nodiscard]] std::vector<std::string> sets(const std::vector<std::string>& values, std::uint64_t run) const;
  void check_corners(std::size_t scenario, Problems& problems) const;
  void check_own_names(std::size_t scenario, Problems& problems) const;
  void find_nominal(StudyScenario& scenario, Problems& problems) const;
  void find_columns(const QuantityOffer& offer, Problems& problems);
  void choose_shown(Problems& problems);
  void check_stops(Problems& problems) const;
  void make_judges(const QuantityOffer& offer, const Catalog& catalog, Problems& problems);

  Study study_;
  std::vector<StudyScenario> scenarios_;
  std::string scenario_text_;  ///< of all, resolved
  std::string scenario_digest_;
  Points points_;
  std::unique_ptr<Followers> followers_;
  std::vector<Quantity> columns_;
  std::unique_ptr<Judge> judge_;
  std::unique_ptr<StopRules> stops_;
  std::vector<std::size_t> shown_;
};

}  // namespace gaitlab::studies
