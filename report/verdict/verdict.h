// The verdict on a run: can the actual robot do this gait? Every known limit, checked in the judged window or the whole run.
#pragma once
#include <string>
#include <vector>

#include "report/analysis/collisions.h"
#include "report/analysis/summary.h"

namespace gaitlab::report {

enum class CheckStatus { pass, warn, fail, too_close, not_judged };
enum class Word { feasible, infeasible, not_judged, failed };

/// A limit, and the number of the run that is held against it. NaN: the number is not known.
struct Check {
  std::string id;     ///< `voltage`
  std::string group;  ///< run, motor, motion, structure, ground; trust: whether the run is to be believed
  std::string title;  ///< `Voltage suffices`
  CheckStatus status = CheckStatus::not_judged;
  double value, limit;       ///< of the worst joint; what it may be, both in `unit`
  std::string unit;          ///< "" of shares
  std::string joint = {};    ///< the worst
  std::size_t joints = 0;    ///< how many are beyond the limit
  double from, to;           ///< s: when the worst one was
  std::string definition;    ///< what is held against what
  std::string source = {};   ///< of the limit: who says it
  std::string text = {};     ///< a sentence for people
  std::string missing = {};  ///< how much more it takes: `11 V`; empty: not known
};

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
  std::vector<JointDemand> demands = {};  ///< empty: no joint reaches a limit, or nobody asked
  std::string demand_doubt = {};          ///< why demands are not known, or doubtful
  [[nodiscard]] std::size_t count(CheckStatus status) const;
  /// One sentence behind the word: the reason of `not judged`, else the first check that fails; empty of `feasible`.
  [[nodiscard]] std::string why() const;
};

/// Shares, peaks and spans are of all steps (Recording::ticks), or of rows (row_statistics.h). A limit that nobody states is
/// not judged, never assumed kept. Thresholds: the scenario's `limits`.
Verdict verdict(const Scenario& scenario, const Recording& record, const Summary& summary, const Overlaps& overlaps);

/// `pass`, `not judged` ...
const char* name_of(CheckStatus status);
/// `feasible` ...
const char* name_of(Word word);

/// The text of verdict.json.
std::string to_json(const Verdict& verdict);

/// `infeasible: ` and the first check that fails, or `not judged: ` and the reason; then the names of the checks that fail,
/// warn and were not judged, and last what the verdict rests on; at most 64 columns each.
std::vector<std::string> to_lines(const Verdict& verdict);

}  // namespace gaitlab::report
