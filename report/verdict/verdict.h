// The verdict on a run: whether the actual robot can do this gait. Every known limit, checked in the judged window or the whole
// run.
#pragma once
#include <string>
#include <vector>

#include "core/names.h"
#include "report/analysis/collisions.h"
#include "report/analysis/summary.h"
#include "report/verdict/check.h"

namespace gaitlab {

namespace report {
enum class Word { feasible, infeasible, not_judged, failed };
}

template <>
struct EnumNames<report::Word> {
  using enum report::Word;
  static constexpr EnumName<report::Word> kTable[] = {
      {feasible, "feasible"}, {infeasible, "infeasible"}, {not_judged, "not judged"}, {failed, "failed"}};
};

}  // namespace gaitlab

namespace gaitlab::report {

/// Demand of a joint that reaches a limit, without limits (demand.h): largest magnitudes in the judged window.
struct JointDemand {
  std::string joint;
  double voltage, current, torque, speed;  ///< V, A, N m, rad/s
};

struct Verdict {
  /// failed: the run ended early. infeasible: a check fails. feasible: no check fails or is too close to its limit, at least
  /// one limit of the motors was judged, for a robot on a ground also `fall` and `in_ground`, and there is evidence
  /// (evidence.h). not judged: otherwise; also if a check fails that a longer run could pass, and the run is too short.
  Word word = Word::not_judged;
  std::string reason = {};    ///< of `not judged`: the missing evidence, and the setting to change
  std::string rests_on = {};  ///< of the evidence: `3 periods of 4 s`
  double from = 0, to = 0;    ///< s, the judged window
  std::vector<Check> checks;
  /// Whether a judged check uses motor values that are chosen, not a maker's, or have no source.
  bool chosen_motors = false;
  bool chosen_docks = false;     ///< the same for the load limits of docks
  std::string figures = {};      ///< these sources in a sentence (motors.h): `motors: chosen figures`
  std::string first_joint = {};  ///< the first joint of the whole run at a limit of its motor, for any time; empty: none
  double first_time = 0;         ///< s, the time of that
  /// Note that peaks, shares and durations are from the trace's rows, because the folder has nothing else; empty: they are from
  /// all steps.
  std::string of_rows = {};
  std::string window_of_rows = {};        ///< motion_sentence of an older folder; empty: the rest is from control ticks
  std::vector<JointDemand> demands = {};  ///< empty: no joint reaches a limit, or not computed
  std::string demand_doubt = {};          ///< reason why demands are unknown or doubtful
  /// For `failed` and `infeasible`: the deciding check. Among the checks that give the word, one of the robot as a whole (group
  /// run), else the one with the least margin.
  std::string decided_by = {};
  [[nodiscard]] std::size_t count(CheckStatus status) const;
  /// Failing checks, in the same order.
  [[nodiscard]] std::vector<const Check*> failures() const;
  /// The check that can fail with the least margin; nullptr: no margin is known. Limits of 0 count only if they fail.
  [[nodiscard]] const Check* tightest() const;
  /// One sentence after the word: the reason of `not judged`, else the deciding check; empty for `feasible`.
  [[nodiscard]] std::string why() const;
};

/// Judges a run. Shares, peaks and durations are from all steps (Recording::ticks), or from rows (row_statistics.h). A limit
/// that is not stated is not judged, never assumed kept. Thresholds: the scenario's `limits`.
Verdict verdict(const Scenario& scenario, const Recording& record, const Summary& summary, const Overlaps& overlaps);

/// Optional tables of a recording that summary, verdict and quantities (quantities.h) need; numbers of CheckKind::of_all_loads
/// aside.
inline constexpr Records kVerdictReads{Loads::judged, false};

/// The text of verdict.json.
std::string to_json(const Verdict& verdict);

}  // namespace gaitlab::report
