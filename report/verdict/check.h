// A check of the verdict: a limit, and the number of the run that is compared with it.
#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/names.h"

namespace gaitlab {

namespace report {

enum class CheckStatus { pass, warn, fail, too_close, not_judged };
enum class CheckGroup { run, motor, motion, structure, ground, trust };
/// The part of a run to which a check applies. A longer run cannot undo a failure in the whole run.
enum class CheckSpan { window, whole_run };
/// Kind of the part that a check names as the worst.
enum class Part { none, joint, body, dock, foot };

/// A number of the run, with the limit beyond which a check fails, or warns if it never fails; both in `unit`.
struct Criterion {
  double value, limit;
  std::string unit = {};  ///< "" for shares
  bool least = false;     ///< the limit is a lower limit
  /// (limit - value) / |limit|, with the opposite sign for a lower limit; for a limit of 0 without the division. 0 or more:
  /// kept.
  [[nodiscard]] double margin() const { return margin(limit); }
  [[nodiscard]] double margin(double other_limit) const;
};

}  // namespace report

template <>
struct EnumNames<report::CheckStatus> {
  using enum report::CheckStatus;
  static constexpr EnumName<report::CheckStatus> kTable[] = {
      {pass, "pass"}, {warn, "warn"}, {fail, "fail"}, {too_close, "too close"}, {not_judged, "not judged"}};
};

template <>
struct EnumNames<report::CheckGroup> {
  using enum report::CheckGroup;
  static constexpr EnumName<report::CheckGroup> kTable[] = {
      {run, "run"}, {motor, "motor"}, {motion, "motion"}, {structure, "structure"}, {ground, "ground"}, {trust, "trust"}};
};

template <>
struct EnumNames<report::CheckSpan> {
  using enum report::CheckSpan;
  static constexpr EnumName<report::CheckSpan> kTable[] = {{window, "window"}, {whole_run, "whole run"}};
};

template <>
struct EnumNames<report::Part> {
  using enum report::Part;
  static constexpr EnumName<report::Part> kTable[] = {
      {none, "none"}, {joint, "joint"}, {body, "body"}, {dock, "dock"}, {foot, "foot"}};
};

namespace report {

/// Result of a check: a limit, and the number of the run that is compared with it. NaN: the number is not known.
struct Check {
  std::string id;                      ///< `voltage`
  CheckGroup group = CheckGroup::run;  ///< trust: accuracy of the run itself
  std::string title;                   ///< `Voltage suffices`
  CheckStatus status = CheckStatus::not_judged;
  CheckSpan span = CheckSpan::window;
  bool can_fail = true;  ///< false: it only warns
  bool least = false;    ///< the limit is a lower limit
  double value, limit;   ///< of the worst part, by the criterion that decides
  std::string unit;      ///< "" for shares
  /// Margin of the criterion that decides. Orders the checks, and is a quantity of studies.
  double margin = std::numeric_limits<double>::quiet_NaN();
  std::vector<Criterion> criteria = {};  ///< for a check with several criteria: all, the main one first
  double error = 0;                      ///< relative error of the value; 0: not estimated
  Part part = Part::none;                ///< kind of `worst`
  std::string worst = {};                ///< the part with the least margin: `m3/passive`, `m5`
  std::size_t parts = 0;                 ///< number of parts beyond the limit
  double from, to;                       ///< s: time of the worst one
  double first;                          ///< s: when a part was first beyond the limit
  std::string first_part = {};           ///< that part; empty: none, or not known
  std::string definition;                ///< definition of the value
  std::string source = {};               ///< source of the limit
  std::string text = {};                 ///< sentence for the user
  std::string remedy = {};               ///< setting to change: `take a smaller amplitude`; empty: no setting is known to help
  std::string missing = {};              ///< shortfall: `11 V`; empty: not known
  SourceLocation place = {};             ///< place of the setting concerned

  /// `text`, with the time if the value is of one instant, and the shortfall.
  [[nodiscard]] std::string sentence() const;
  /// The least margin with `limit` as the limit of the main criterion.
  [[nodiscard]] double margin_of(double limit) const;
};

struct CheckedRun;

/// The constant parts of a check: one row of the list from which verdict, terminal, page, studies, `explain` and docs are
/// generated.
struct CheckKind {
  const char* id;
  CheckGroup group;
  const char *unit, *title;
  const char* definition;  ///< value of the main criterion
  const char *fails, *warns;
  CheckSpan span;
  const char* key;     ///< setting of the scenario to which a message refers
  const char* remedy;  ///< advice of `explain`
  void (*judge)(const CheckedRun& run, Check& made);
  bool least = false;         ///< the limit is a lower limit
  bool of_all_loads = false;  ///< without a stated limit its number needs Loads::recorded
  [[nodiscard]] bool can_fail() const { return *fails != '\0'; }
};
/// All checks, in the order of the verdict.
std::span<const CheckKind> check_kinds();

}  // namespace report
}  // namespace gaitlab
