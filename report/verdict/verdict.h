// The verdict on a run: can the actual robot do this gait? Every known limit, checked in the judged window or the whole run.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "report/analysis/collisions.h"
#include "report/analysis/summary.h"

namespace gaitlab::report {

enum class CheckStatus { pass, warn, fail, too_close, not_judged };
enum class Word { feasible, infeasible, not_judged, failed };
/// The stretch of a run that a check is of. A failure in the whole run cannot be undone by more time.
enum class CheckSpan { window, whole_run };
/// The kind of part that a check names as the worst.
enum class Part { none, joint, body, dock, foot };

/// A number of the run and the limit beyond which a check fails, or warns where it never fails; both in `unit`.
struct Criterion {
  double value, limit;
  std::string unit = {};  ///< "" of shares
  bool least = false;     ///< the limit is the least that is allowed
  /// (limit - value) / |limit|, of a least one with the opposite sign; of a limit of 0 without the division. 0 or more: kept.
  [[nodiscard]] double margin() const { return margin(limit); }
  [[nodiscard]] double margin(double other_limit) const;
};

/// A limit, and the number of the run that is held against it. NaN: the number is not known.
struct Check {
  std::string id;     ///< `voltage`
  std::string group;  ///< run, motor, motion, structure, ground; trust: accuracy of the run itself
  std::string title;  ///< `Voltage suffices`
  CheckStatus status = CheckStatus::not_judged;
  CheckSpan span = CheckSpan::window;
  bool can_fail = true;  ///< false: it only warns
  bool least = false;    ///< the limit is the least that is allowed
  double value, limit;   ///< of the worst part: of the criterion that decides
  std::string unit;      ///< "" of shares
  /// Of the criterion that decides. Orders the checks, and is a quantity of studies.
  double margin = value;
  std::vector<Criterion> criteria = {};  ///< those of a check that has several, the main one first
  double error = 0;                      ///< share by which the value may be off; 0: not estimated
  Part part = Part::none;                ///< of `worst`
  std::string worst = {};                ///< the part with the least margin: `m3/passive`, `m5`
  std::size_t parts = 0;                 ///< how many are beyond the limit
  double from, to;                       ///< s: when the worst one was
  double first;                          ///< s: when any part was beyond the limit first
  std::string first_part = {};           ///< which that was; empty: not known, or none was
  std::string definition;                ///< what is held against what
  std::string source = {};               ///< of the limit
  std::string text = {};                 ///< a sentence for people
  std::string remedy = {};               ///< what to set: `take a smaller amplitude`; empty: no setting is known to help
  std::string missing = {};              ///< how much more it takes: `11 V`; empty: not known
  SourceLocation place = {};             ///< of the setting to look at

  /// The least margin if the limit of the main criterion were `limit`.
  [[nodiscard]] double margin_of(double limit) const;
};

struct CheckedRun;

/// The constant parts of a check: one row of the list that verdict, terminal, page, studies, `explain` and docs are loops over.
struct CheckKind {
  const char *id, *group, *unit, *title;
  const char* definition;  ///< value of the main criterion
  const char *fails, *warns;
  CheckSpan span;
  const char* key;     ///< setting of the scenario that a message points at
  const char* remedy;  ///< advice of `explain`
  void (*judge)(const CheckedRun& run, Check& made);
  bool least = false;  ///< the limit is the least that is allowed
  [[nodiscard]] bool can_fail() const { return *fails != '\0'; }
};
/// All checks, in the order of the verdict.
std::span<const CheckKind> check_kinds();

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
  /// Whether a check that was judged rests on figures of motors that are chosen, not a maker's.
  bool chosen_motors = false;
  bool chosen_docks = false;     ///< the same of what docks hold
  std::string first_joint = {};  ///< the first of the whole run at a limit of its motor, however shortly; empty: none is
  double first_time = 0;         ///< s, when that was
  /// That peaks, shares and spans are of the trace's rows, because the folder has nothing else; empty: they are of all steps.
  std::string of_rows = {};
  std::vector<JointDemand> demands = {};  ///< empty: no joint reaches a limit, or nobody asked
  std::string demand_doubt = {};          ///< why demands are not known, or doubtful
  [[nodiscard]] std::size_t count(CheckStatus status) const;
  /// The check that can fail with the least margin; nullptr: no margin is known. Limits of 0 count only where they fail.
  [[nodiscard]] const Check* tightest() const;
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
const char* name_of(CheckSpan span);
const char* name_of(Part part);

/// The text of verdict.json.
std::string to_json(const Verdict& verdict);

/// `infeasible: ` and the first check that fails, or `not judged: ` and the reason; then the names of the checks that fail,
/// warn and were not judged; at most 64 columns each.
std::vector<std::string> to_lines(const Verdict& verdict);

}  // namespace gaitlab::report
