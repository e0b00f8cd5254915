// A check of the verdict, which compares a number of the run with a limit.
#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/names.h"

namespace gaitlab {

struct Scenario;

namespace report {

enum class CheckStatus { pass, warn, fail, too_close, not_judged };
enum class CheckGroup { run, motor, motion, structure, ground, trust };
/// Time interval to which a check applies: the judged window or the whole run. A failure of a whole-run check remains a failure
/// if the run is continued.
enum class CheckSpan { window, whole_run };
/// Value from which a check of a run that has not ended counts as lost (hopeless.h): `never`; beyond its limit, for the
/// `extreme` of a whole run, which does not recover; beyond 1.5 times its limit, for a `peak` in the judged window; beyond five
/// times its limit, for a `share` of the time, which the rest of the run can reduce.
enum class Lost { never, extreme, peak, share };
/// Kind of the robot's part with the least margin, named in Check::worst.
enum class Part { none, joint, body, dock, foot };

/// A number of the run and its limit, both in `unit`. Beyond the limit the check fails or, if it never fails, warns.
struct Criterion {
  double value, limit;
  std::string unit = {};  ///< "" for shares and counts
  bool least = false;     ///< the limit is a lower limit
  /// Margin (limit - value) / |limit|, with the opposite sign for a lower limit. For a limit of 0 it is not divided. It is
  /// negative beyond the limit.
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

/// Result of a check, which compares a number of the run with a limit. Numbers that are not known are NaN.
struct Check {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::string id;                      ///< identifier, for example `voltage`
  CheckGroup group = CheckGroup::run;  ///< the group `trust` contains the checks of the run's accuracy
  std::string title;                   ///< for example `Voltage suffices`
  CheckStatus status = CheckStatus::not_judged;
  bool concerns = true;  ///< CheckKind::concerns of the scenario; if false, the check is not shown
  CheckSpan span = CheckSpan::window;
  bool can_fail = true;                 ///< false: beyond the limit the check warns and does not fail
  bool least = false;                   ///< the limit is a lower limit
  double value = kNone, limit = kNone;  ///< number and limit of the worst part, by the criterion with the least margin
  std::string unit;                     ///< "" for shares and counts
  /// Margin of the criterion with the least margin. It orders the checks, and studies can use it as a quantity.
  double margin = kNone;
  std::vector<Criterion> criteria = {};  ///< all criteria of a check that has several, the main criterion first
  double error = 0;                      ///< relative error of the value; 0 if not estimated
  bool certain = false;             ///< true if it fails by more than the error of the torques; only for checks with error bars
  Part part = Part::none;           ///< kind of the part `worst`
  std::string worst = {};           ///< the part with the least margin, for example `m3/passive` or `m5`
  std::size_t parts = 0;            ///< number of parts beyond the limit
  double from = kNone, to = kNone;  ///< s, time interval in which the worst part reached `value`
  double first = kNone;             ///< s, time when a part was first beyond the limit
  std::string first_part = {};      ///< part that was first beyond the limit; empty if none is known
  std::string definition;           ///< definition of the value
  std::string source = {};          ///< source of the limit
  std::string text = {};            ///< sentence about the result, printed for the user
  std::string remedy = {};          ///< change of a setting that helps: `take a smaller amplitude`; empty if none is known
  std::string retry = {};           ///< setting that decides a check that is too close, in the form of --set; else empty
  std::string missing = {};         ///< shortfall of the motor, for example `11 V`; empty if not known
  SourceLocation place = {};        ///< line of the scenario with the setting that the check concerns

  /// `text`, followed by the time if the value belongs to one instant, and by the shortfall.
  [[nodiscard]] std::string sentence() const;
  /// Least margin of all criteria if `limit` replaces the limit of the main criterion.
  [[nodiscard]] double margin_of(double limit) const;
};

struct CheckedRun;

/// Constant data of a check. The list of all kinds is the source of the verdict, the terminal output, the page, the columns of
/// studies, `gaitlab explain` and the documentation.
struct CheckKind {
  const char* id;
  CheckGroup group;
  const char *unit, *title;
  std::string definition;    ///< definition of the number that the main criterion compares
  std::string fails, warns;  ///< texts of the limits beyond which it fails or warns; empty if it never does
  CheckSpan span;
  const char* key;     ///< key of the scenario setting at which messages about the check are placed
  const char* remedy;  ///< advice printed by `gaitlab explain`
  void (*judge)(const CheckedRun& run, Check& made);
  bool least = false;         ///< the limit is a lower limit
  bool of_all_loads = false;  ///< true: without a stated limit the check needs Loads::recorded to compute its number
  bool rating = false;        ///< true: the limit is a rated load, which does not act on the motion
  Lost lost = Lost::never;
  /// True if the scenario has the part that is judged, such as a supply; null if every scenario has it.
  bool (*concerns)(const Scenario& scenario) = nullptr;
  [[nodiscard]] bool can_fail() const { return !fails.empty(); }
};
/// All kinds of checks, in the order of the verdict.
std::span<const CheckKind> check_kinds();

}  // namespace report
}  // namespace gaitlab
