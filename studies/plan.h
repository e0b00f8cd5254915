// A study bound to its scenario: what each run is, and what its row in the journal holds.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/scenario/read_scenario.h"
#include "studies/journal.h"
#include "studies/judge.h"
#include "studies/points.h"
#include "studies/stop_rules.h"

namespace gaitlab::studies {

class Plan {
 public:
  /// Reads the scenario and checks the study against it. InputError with every problem found, before anything runs.
  Plan(Study study, const FigureOffer& offer, Catalog& catalog);

  [[nodiscard]] const Study& study() const { return study_; }
  [[nodiscard]] const Scenario& scenario() const { return nominal_scenario_; }
  [[nodiscard]] const Points& points() const { return points_; }
  /// Of a method that chooses points by what came out: its budget.
  [[nodiscard]] std::uint64_t most_runs() const { return points_.runs(); }
  [[nodiscard]] const Judge& judge() const { return *judge_; }
  [[nodiscard]] const StopRules& stops() const { return *stops_; }
  /// Ends of parameters that the scenario refuses, where the other end, the rest being nominal, is not: points near them will
  /// fail.
  [[nodiscard]] const std::vector<Problem>& notes() const { return notes_; }
  /// The same with all guards as they are by default: what makes a winner without guards suspect.
  [[nodiscard]] const Judge& gait_judge() const { return *gait_judge_; }
  [[nodiscard]] const std::vector<FigureName>& columns() const { return columns_; }
  /// Figures to show, by column: those that the study's patterns name, in the order of the patterns; without any the speed.
  [[nodiscard]] const std::vector<std::size_t>& shown() const { return shown_; }

  /// The next point of a study whose points are chosen by what came out, or by another program.
  void add(std::vector<std::string> values) { points_.add(std::move(values)); }
  /// A budget of at least so many runs, in whole points. False: the study has no budget.
  bool raise_budget(std::uint64_t runs);
  /// What a point with these values is called in the journal, the same in every study of the scenario.
  [[nodiscard]] std::string point_name(const std::vector<std::string>& values) const;

  /// Settings of a run behind the study's own, as for --set.
  [[nodiscard]] std::vector<std::string> sets(std::uint64_t run) const;
  /// With these settings, or those of a run. InputError: the scenario is refused with these values. One thread at a time.
  [[nodiscard]] Scenario with(const std::vector<std::string>& sets) const { return template_->with(sets); }
  [[nodiscard]] Scenario scenario(std::uint64_t run) const { return with(sets(run)); }
  /// Settings that take the engine of `verify`, with its own step; empty: that is the engine there is, or none.
  [[nodiscard]] const std::vector<std::string>& other_engine() const { return other_engine_; }

  /// The row of a run as far as it is known before the run.
  [[nodiscard]] Row row(std::uint64_t run) const;
  /// Fills in how it ended.
  void finish(Row& row, const Scenario& scenario, const Recording& recording, const Measure& measure) const;

  /// What makes two studies the same, as text; the number of drawn points is no part of it.
  [[nodiscard]] std::string definition() const;
  [[nodiscard]] JournalHead head() const;

 private:
  /// Of a point with these values, by key.
  [[nodiscard]] std::map<std::string, double> nominal(const std::vector<std::string>& values) const;
  [[nodiscard]] std::vector<std::string> sets(const std::vector<std::string>& values, std::uint64_t replicate) const;
  void check_corners(Problems& problems) const;
  void note_refused_ends();
  void find_other_engine(const Catalog& catalog, Problems& problems);
  void find_nominal(Problems& problems);
  void choose_shown(Problems& problems);

  Study study_;
  std::unique_ptr<ScenarioTemplate> template_;
  Scenario nominal_scenario_;
  std::string scenario_text_;  ///< resolved
  std::string scenario_digest_;
  Points points_;
  std::map<std::string, double> nominal_;  ///< of keys that vary as a multiple
  std::vector<FigureName> columns_;
  std::unique_ptr<Judge> judge_, gait_judge_;
  std::unique_ptr<StopRules> stops_;
  std::vector<std::size_t> shown_;
  std::vector<std::string> other_engine_;
  std::vector<Problem> notes_;
};

}  // namespace gaitlab::studies
