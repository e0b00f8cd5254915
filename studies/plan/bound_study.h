// A study checked against its scenarios, with the parts that all of its runs share.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/plan/stop_rules.h"
#include "studies/study/followers.h"
#include "studies/study/scenarios.h"
#include "studies/study/scorer.h"

namespace gaitlab::studies {

class BoundStudy {
 public:
  /// Reads the scenarios and checks the study against each. Throws InputError with every problem found if these prevent further
  /// checks; otherwise problems() returns them.
  BoundStudy(Study study, const QuantityOffer& offer, Catalog& catalog);
  BoundStudy(const BoundStudy&) = delete;  // scorer and stop rules refer to the study
  BoundStudy& operator=(const BoundStudy&) = delete;

  /// Problems that do not prevent a check of the runs' settings. Plan adds the problems of the settings.
  [[nodiscard]] const Problems& problems() const { return problems_; }
  [[nodiscard]] const Study& study() const { return study_; }
  void set_runs(std::int64_t runs) { study_.runs = runs; }
  [[nodiscard]] const std::vector<StudyScenario>& scenarios() const { return scenarios_; }
  /// Text of all resolved scenarios.
  [[nodiscard]] const std::string& scenario_text() const { return scenario_text_; }
  /// Duration of the longest scenario, s.
  [[nodiscard]] double longest() const;
  [[nodiscard]] bool has_other_engine() const;
  /// Positions in worlds() of the worlds that apply to any of the scenarios. In a robust study replicate 0 is nominal, and
  /// replicate r runs in the world at position r - 1 of this list.
  [[nodiscard]] const std::vector<std::size_t>& robust_worlds() const { return robust_worlds_; }
  [[nodiscard]] const Followers& followers() const { return *followers_; }
  [[nodiscard]] const Scorer& scorer() const { return *scorer_; }
  [[nodiscard]] const StopRules& stops() const { return *stops_; }
  [[nodiscard]] const std::vector<Quantity>& columns() const { return columns_; }
  /// Columns of the quantities to show: those that match the study's patterns, in the order of the patterns. If the study has
  /// no patterns, the speed is shown.
  [[nodiscard]] const std::vector<std::size_t>& shown() const { return shown_; }
  /// First points of a search, by the values of all parameters in the form of --set: the first scenario's own values, if all
  /// are known and within the ranges, then the study's `start`.
  [[nodiscard]] const std::vector<std::vector<std::string>>& starts() const { return starts_; }
  /// Reason why `starts` lacks the scenario's own values, at the parameter that is the cause.
  [[nodiscard]] const std::optional<Problem>& not_own() const { return not_own_; }
  /// The scenario with this number and with additional settings. Throws InputError if the scenario refuses their values. Only
  /// one thread at a time may call this.
  [[nodiscard]] Scenario with(const std::vector<std::string>& sets, std::size_t scenario) const {
    return scenarios_[scenario].file->with(sets);
  }

 private:
  Study with_budget(Study study);
  void check_own_names(std::size_t scenario, Problems& problems) const;
  void find_worlds();
  void find_nominal(StudyScenario& scenario, Problems& problems) const;
  void find_starts();
  void find_columns(const QuantityOffer& offer);
  void choose_shown();
  void check_stops();
  void check_engines(const Catalog& catalog, std::vector<Problems>& found) const;
  void make_scorers(const QuantityOffer& offer, const Catalog& catalog);

  Problems problems_;
  Study study_;
  std::vector<StudyScenario> scenarios_;
  std::vector<std::size_t> robust_worlds_;  ///< empty unless the study is robust
  std::string scenario_text_;
  std::unique_ptr<Followers> followers_;
  std::vector<Quantity> columns_;
  std::unique_ptr<Scorer> scorer_;
  std::unique_ptr<StopRules> stops_;
  std::vector<std::size_t> shown_;
  std::vector<std::vector<std::string>> starts_;
  std::optional<Problem> not_own_;
};

}  // namespace gaitlab::studies
