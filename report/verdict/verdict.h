// The verdict on a run, a judgement of the gait on the actual robot. It compares every known limit with the judged window or
// the whole run.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/names.h"
#include "core/recording/word.h"
#include "report/analysis/collisions.h"
#include "report/analysis/summary.h"
#include "report/verdict/check.h"

namespace gaitlab {

namespace report {
/// Reason why a verdict is `not judged`.
enum class ReasonCode { none, rows_alone, impossible, lacks, too_close, no_limit, not_driven, open };
}  // namespace report

template <>
struct EnumNames<report::ReasonCode> {
  using enum report::ReasonCode;
  static constexpr EnumName<report::ReasonCode> kTable[] = {
      {none, "none"},           {rows_alone, "rows alone"}, {impossible, "impossible"}, {lacks, "lacks"},
      {too_close, "too close"}, {no_limit, "no limit"},     {not_driven, "not driven"}, {open, "open"}};
};

}  // namespace gaitlab

namespace gaitlab::report {

/// Demand of a joint that reaches a motor limit (demand.h): its largest magnitudes in the judged window of the run without
/// limits.
struct JointDemand {
  std::string joint;
  double voltage, current, torque, speed;  ///< V, A, N m, rad/s
};

/// Demand of a supply (demand.h) in the judged window.
struct SupplyDemand {
  double voltage;                    ///< V, largest magnitude of a motor's voltage: the bus must hold as much
  double current_peak, current_rms;  ///< A, from the supply at its open-circuit voltage
  double energy, duration;           ///< J, drawn in the window, and its length, s
};

/// A check that fails in a draw, and the part with the least margin ("" if there is none).
struct FailedCheck {
  std::string check, part;
};

/// Verdict on the gait with another seed (draws.h). Numbers that are not known are NaN.
struct Draw {
  std::int64_t seed = 0;
  Word word = Word::not_judged;
  double torque_peak = 0, torque_rms = 0;  ///< largest of all joints, N m
  double distance = 0;                     ///< m
  double margin = 0;                       ///< least margin of the checks that can fail
  std::vector<FailedCheck> failing = {};
};

/// Reason of `not judged`.
struct Reason {
  ReasonCode code = ReasonCode::none;
  std::string text = {};   ///< sentence with all missing evidence, and the settings to change; empty for other words
  std::string check = {};  ///< id of the check that the sentence names: too close to its limit, failing so far, or not judged
};

struct Verdict {
  /// - failed: the run ended early.
  /// - infeasible: no number of the scenario is impossible (plausibility.h), and a check fails; if the torque error exceeds its
  ///   limit, by more than that error (Check::certain).
  /// - feasible: no check fails or is too close to its limit, and the evidence is complete (evidence.h). At least one motor
  ///   limit was judged and, for a robot on a ground, also the checks `fall` and `in_ground`.
  /// - not judged: none of these, or the run is too short and each failing check could pass in a longer run.
  Word word = Word::not_judged;
  Reason reason = {};
  /// Settings that should give a `not judged` run a verdict, in the form of --set; empty if none are known.
  std::vector<std::string> retry = {};
  bool retry_is_finer = false;  ///< true if these only make the simulation more accurate
  std::string rests_on = {};    ///< extent of the run that was judged, and conditions: `3 periods of 4 s`
  std::string conditions = {};  ///< Evidence::conditions
  /// instability() (instability.h). If it is not empty, it is the only sentence of the verdict, and no check passes.
  std::string unstable = {};
  double from = 0, to = 0;  ///< s, the judged window
  std::vector<Check> checks;
  /// True if a judged check uses motor values that were chosen, or that have no source, instead of values of a maker.
  bool chosen_motors = false;
  bool chosen_docks = false;     ///< true if a judged check uses load limits of docks that were chosen or have no source
  std::string figures = {};      ///< sentence on the sources of motor and dock values (motors.h): `motors: chosen figures`
  std::string first_joint = {};  ///< joint that was first at a motor limit in the whole run; empty if none
  double first_time = 0;         ///< s, time when `first_joint` was at its limit
  std::vector<JointDemand> demands = {};           ///< empty if no joint reaches a limit, or if the demand was not computed
  std::string demand_doubt = {};                   ///< reason why the demands are unknown or doubtful; empty otherwise
  std::optional<SupplyDemand> supply_demand = {};  ///< nothing without a supply, or if the demand was not computed
  /// Word of the run without the friction that is only chosen (frictionless.h); nothing if it was not simulated.
  std::optional<Word> without_friction = {};
  /// Id of the deciding check of `failed` and `infeasible`. If a check of the robot as a whole (group `run`) causes the word,
  /// it is this check; otherwise the check with the least margin among those that cause it.
  std::string decided_by = {};
  /// Draws of `gaitlab run --draws`, this run first; empty if there are none. `word` belongs to this run alone.
  std::vector<Draw> draws = {};
  std::string draws_text = {};  ///< `feasible in 14 of 16 robots; voltage fails in 2 (m6/active)`; empty without draws
  /// Joints whose own checks are not judged: `m3/active: not judged (dead from t = 10 s)`.
  std::vector<std::string> faults = {};
  std::string remedy = {};  ///< shown_remedy() (report/remedy/remedy_text.h); empty if no remedy was searched
  [[nodiscard]] std::size_t count(CheckStatus status) const;
  /// Failing checks: first the deciding check, then those of the robot as a whole, then by margin.
  [[nodiscard]] std::vector<const Check*> failures() const;
  /// The check with the least margin among those that can fail; nullptr if no margin is known. Checks with a limit of 0 count
  /// only if they fail.
  [[nodiscard]] const Check* tightest() const;
  /// Sentence printed after the word: the reason of `not judged`, the deciding check of `failed` and `infeasible`, or nothing
  /// for `feasible`. If without_friction is `feasible`, the sentence of `infeasible` ends `, with the friction chosen; feasible
  /// without`.
  [[nodiscard]] std::string why() const;
};

/// Judges a run. Shares, peaks and durations are from all steps (Recording::ticks); without these, nothing is
/// judged. Thresholds are those of the scenario's `limits`. A quantity whose limit is not stated is not judged.
Verdict verdict(const Scenario& scenario, const Recording& record, const Summary& summary, const Overlaps& overlaps);

/// Optional tables of a recording that summary, verdict and quantities (quantities.h) read. Numbers of checks with
/// CheckKind::of_all_loads need more tables.
inline constexpr Records kVerdictReads{Loads::judged, false};

/// The text of verdict.json.
std::string to_json(const Verdict& verdict);

}  // namespace gaitlab::report
