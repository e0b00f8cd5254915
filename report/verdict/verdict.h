// The verdict on a run: can the actual robot do this gait? Every known limit, checked in the judged window or the whole run.
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

/// What a joint that reaches a limit would take without limits (demand.h): largest magnitudes in the judged window.
struct JointDemand {
  std::string joint;
  double voltage, current, torque, speed;  ///< V, A, N m, rad/s
};

struct Verdict {
  /// failed: the run ended early. infeasible: a check fails. feasible: none fails, none is too close to its limit, at least one
  /// limit of the motors was judged, of a robot on a ground `fall` and `in_ground` too, and there is evidence (evidence.h).
  /// not judged: all else; also where a check fails that more time could pass, and the run is too short.
  Word word = Word::not_judged;
  std::string reason = {};    ///< of `not judged`: what is missing, and what to set
  std::string rests_on = {};  ///< of the evidence: `3 periods of 4 s`
  double from = 0, to = 0;    ///< s, the judged window
  std::vector<Check> checks;
  /// Whether a check that was judged rests on figures of motors that are chosen, not a maker's, or have no source.
  bool chosen_motors = false;
  bool chosen_docks = false;     ///< the same of what docks hold
  std::string figures = {};      ///< the same in a sentence (motors.h): `motors: chosen figures`
  std::string first_joint = {};  ///< the first of the whole run at a limit of its motor, however shortly; empty: none is
  double first_time = 0;         ///< s, when that was
  /// That peaks, shares and spans are of the trace's rows, because the folder has nothing else; empty: they are of all steps.
  std::string of_rows = {};
  std::string window_of_rows = {};        ///< motion_sentence of an older folder; empty: all else is of control ticks
  std::vector<JointDemand> demands = {};  ///< empty: no joint reaches a limit, or nobody asked
  std::string demand_doubt = {};          ///< why demands are not known, or doubtful
  /// Of `failed` and `infeasible`: the check that the word rests on: of those that make it one of the robot as a whole (group
  /// run), else the one with the least margin.
  std::string decided_by = {};
  [[nodiscard]] std::size_t count(CheckStatus status) const;
  /// What fails, in the same order.
  [[nodiscard]] std::vector<const Check*> failures() const;
  /// The check that can fail with the least margin; nullptr: no margin is known. Limits of 0 count only where they fail.
  [[nodiscard]] const Check* tightest() const;
  /// One sentence behind the word: the reason of `not judged`, else the check that the word rests on; empty of `feasible`.
  [[nodiscard]] std::string why() const;
};

/// Shares, peaks and spans are of all steps (Recording::ticks), or of rows (row_statistics.h). A limit that nobody states is
/// not judged, never assumed kept. Thresholds: the scenario's `limits`.
Verdict verdict(const Scenario& scenario, const Recording& record, const Summary& summary, const Overlaps& overlaps);

/// The text of verdict.json.
std::string to_json(const Verdict& verdict);

}  // namespace gaitlab::report
