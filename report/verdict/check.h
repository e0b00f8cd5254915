// A check of the verdict: a limit, and the number of the run that is held against it.
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

/// A limit, and the number of the run that is held against it. NaN: the number is not known.
struct Check {
  std::string id;                      ///< `voltage`
  CheckGroup group = CheckGroup::run;  ///< trust: accuracy of the run itself
  std::string title;                   ///< `Voltage suffices`
  CheckStatus status = CheckStatus::not_judged;
  CheckSpan span = CheckSpan::window;
  bool can_fail = true;  ///< false: it only warns
  bool least = false;    ///< the limit is the least that is allowed
  double value, limit;   ///< of the worst part: of the criterion that decides
  std::string unit;      ///< "" of shares
  /// Of the criterion that decides. Orders the checks, and is a quantity of studies.
  double margin = std::numeric_limits<double>::quiet_NaN();
  std::vector<Criterion> criteria = {};  ///< those of a check that has several, the main one first
  double error = 0;                      ///< share by which the value may be off; 0: not estimated
  Part part = Part::none;                ///< of `worst`
  std::string worst = {};                ///< the part with the least margin: `m3/passive`, `m5`
  std::size_t parts = 0;                 ///< how many are beyond the limit
  double from, to;                       ///< s: when the worst one was
  double first;                          ///< s: when any part was beyond the limit first
  std::string first_part = {};           ///< the part that was; empty: none, or not known
  std::string definition;                ///< what is held against what
  std::string source = {};               ///< of the limit
  std::string text = {};                 ///< a sentence for people
  std::string remedy = {};               ///< what to set: `take a smaller amplitude`; empty: no setting is known to help
  std::string missing = {};              ///< how much more it takes: `11 V`; empty: not known
  SourceLocation place = {};             ///< of the setting to look at

  /// `text`, the time of what was at one instant, and what is missing.
  [[nodiscard]] std::string sentence() const;
  /// The least margin if the limit of the main criterion were `limit`.
  [[nodiscard]] double margin_of(double limit) const;
};

struct CheckedRun;

/// The constant parts of a check: one row of the list that verdict, terminal, page, studies, `explain` and docs are loops over.
struct CheckKind {
  const char* id;
  CheckGroup group;
  const char *unit, *title;
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

}  // namespace report
}  // namespace gaitlab
