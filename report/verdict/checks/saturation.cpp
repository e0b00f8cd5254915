// The checks `voltage` and `current`: the time that motors are at these limits.
#include <numeric>

#include "core/settings/wording.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

namespace {

constexpr double kLeastTold = 1e-3;  // s; a shorter time at a limit is only a few steps

struct Span {
  double from = 0, to = 0;
  [[nodiscard]] double length() const { return to - from; }
};

/// The longest interval after row `first` in which a joint may have been at the limit without interruption. `parts` is the time
/// at the limit in each row of ticks, s. Rows that are completely at the limit are joined with the parts of the neighbouring
/// rows. Such a part may consist of several pieces at unknown times; it counts as one piece at the end and one at the start of
/// its row.
Span longest_span(const Series& t, const std::vector<double>& parts, std::size_t first) {
  constexpr double kAllTheWhile = 0.999;
  Span longest;
  Span now;
  for (std::size_t k = first + 1; k < t.size(); ++k) {
    if (now.to != t[k - 1]) now = {t[k - 1], t[k - 1]};
    now.to = t[k - 1] + parts[k];
    if (parts[k] > kAllTheWhile * (t[k] - t[k - 1])) now.to = t[k];
    if (now.length() > longest.length()) longest = now;
    if (now.to != t[k]) now = {t[k] - parts[k], t[k]};
    if (now.length() > longest.length()) longest = now;
  }
  return longest;
}

/// Reason why an actuator without a voltage or without a limit is not judged. Empty if it is judged.
std::string unstated(const CheckedRun& run, MotorLimit limit, double share) {
  if (share > 0 || run.has_dc_motors) return "";
  if (limit == MotorLimit::voltage) return "the actuator is not made of DC motors, and has no voltage";
  const bool limited = std::ranges::all_of(run.motors.kinds, [](const Envelope& motor) { return motor.command.has_value(); });
  return limited ? "" : "the actuator states no limit";
}

/// Time that a joint is at this limit in each row of ticks, s. With `error` above 0 it is an upper bound: a row at no limit
/// counts completely if the torque is within that share of this limit.
std::vector<double> parts_at_limit(const CheckedRun& run, std::size_t joint, double error, MotorLimit limit) {
  const Recording& r = run.record;
  const Series t(r.ticks, 0);
  const Series peak = r.tick(joint, kEnvelopePeak);
  const Series voltage = r.tick(joint, kVoltageLimited);
  const Series current = r.tick(joint, kCurrentLimited);
  const Series amperes = r.tick(joint, kCurrentPeak);
  const Series& at = limit == MotorLimit::voltage ? voltage : current;
  const std::optional<double> most = run.motors.joint(joint).current;
  std::vector<double> parts(t.size(), 0);
  for (std::size_t k = 1; k < t.size(); ++k) {
    parts[k] = at[k] - at[k - 1];
    if (!(error > 0) || peak.empty() || !(peak[k] >= 1 - error) || voltage[k] > voltage[k - 1] || current[k] > current[k - 1])
      continue;
    const bool by_current = !run.has_dc_motors || (most && amperes[k] >= (1 - error) * *most);
    if (by_current == (limit == MotorLimit::current)) parts[k] = t[k] - t[k - 1];
  }
  return parts;
}

/// Time that a joint is at a limit of its motor.
struct AtLimit {
  std::size_t joint = 0;
  double share = 0;  ///< share of the judged window
  Span longest;
  std::vector<Criterion> criteria;
  [[nodiscard]] const Criterion& decisive() const { return *std::ranges::min_element(criteria, {}, margin_of); }
  [[nodiscard]] double margin() const { return decisive().margin(); }
  static double margin_of(const Criterion& one) { return one.margin(); }
};

/// Time that a joint is at a limit if its torque is larger by the share `error`.
AtLimit at_limit(const CheckedRun& run, std::size_t joint, double error, MotorLimit limit) {
  constexpr double kRounding = 1 + 1e-6;  // tolerance of an interval that is a sum of rows
  const Series t(run.record.ticks, 0);
  const std::size_t first = run.summary.judged.first_row;
  const std::vector<double> parts = parts_at_limit(run, joint, error, limit);
  const double window = t.back() - t[first];
  AtLimit made{joint, 0, longest_span(t, parts, first), {}};
  if (window > 0)
    made.share = std::accumulate(parts.begin() + static_cast<std::ptrdiff_t>(first) + 1, parts.end(), 0.0) / window;
  const double stretch = run.limits().saturated_periods * run.scenario.control_period * kRounding;
  made.criteria = {{made.share, run.limits().saturated_share}, {made.longest.length(), stretch, "s"}};
  return made;
}

/// Error bar of a joint. Its lower end is computed from `at`, with times shorter by the share `error`, and its upper end from
/// `widest`.
ErrorBar bar_of(const AtLimit& at, double error, const AtLimit& widest) {
  ErrorBar bar{"", error, 0, 1 - widest.margin()};
  for (const Criterion& one : at.criteria)
    bar.least = std::max(bar.least, 1 - Criterion{one.value * (1 - error), one.limit}.margin());
  return bar;
}

/// Driven joints that are at a limit of their motors.
struct Saturated {
  std::size_t joints = 0;  ///< number of joints at the limit for some time
  std::optional<AtLimit> worst;
  std::optional<AtLimit> widest;  ///< joint with the least margin if torques are larger by their errors, provided that it fails
  std::vector<ErrorBar> bars;
};

Saturated saturated(const CheckedRun& run, MotorLimit limit) {
  const auto worse = [](const AtLimit& one, const std::optional<AtLimit>& other) {
    constexpr double kEqual = 1e-9;  // smaller differences of margins are rounding errors
    const double nearer = other ? other->margin() - one.margin() : 1;
    return std::abs(nearer) > kEqual ? nearer > 0 : one.share > kLarger * other->share;
  };
  Saturated made;
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    if (!run.judges(j, CheckSpan::window)) continue;
    const AtLimit one = at_limit(run, j, 0, limit);
    if (one.share > 0) ++made.joints;
    if (worse(one, made.worst)) made.worst = one;
    const double error = run.torque_error(j);
    const bool known = error > 0 && error <= run.limits().most_torque_error();  // a larger error does not show anything
    const AtLimit wide = known ? at_limit(run, j, error, limit) : one;
    made.bars.push_back(bar_of(one, error, wide));
    if (known && wide.margin() < 0 && worse(wide, made.widest)) made.widest = wide;
  }
  return made;
}

/// Sets Check::first and Check::first_part to the joint that is first at this limit in the judged window.
void find_first_at_limit(const CheckedRun& run, MotorLimit limit, Check& made) {
  const Series t(run.record.ticks, 0);
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    if (!run.judges(j, made.span)) continue;
    const std::vector<double> parts = parts_at_limit(run, j, 0, limit);
    const auto from = parts.begin() + static_cast<std::ptrdiff_t>(run.summary.judged.first_row) + 1;
    const auto row = std::find_if(from, parts.end(), [](double part) { return part > 0; });
    if (row == parts.end()) continue;
    // The first row may begin before the window, which does not begin at a row.
    const double begins = std::max(t[static_cast<std::size_t>(row - parts.begin())] - *row, run.summary.judged.from);
    if (begins >= made.first) continue;
    made.first = begins;
    made.first_part = run.joint(j);
  }
}

/// Text of a time at a limit, which consists of steps: `0.837 s`.
std::string time_on_end(double seconds) { return seconds < kLeastTold ? "less than 1 ms" : fmt::format("{:.3g} s", seconds); }

/// Fills in joint, time and sentence of the worst joint at a limit. `name` is the quantity that is limited, for example
/// `voltage`.
void describe(const CheckedRun& run, const AtLimit& worst, MotorLimit limit, const char* name, Check& made) {
  name_joint(made, run, worst.joint);
  made.from = worst.longest.from;
  made.to = worst.longest.to;
  find_first_at_limit(run, limit, made);
  const std::string on_end = fmt::format("{} on end from {:.2f} s", time_on_end(worst.longest.length()), made.from);
  const bool one = made.parts == 1;
  made.text = fmt::format("{} of {} reach{} the limit of {} {}: first {}, at {:.2f} s; {}{}", made.parts,
                          counted(driven_joints(*run.scenario.robot), "joint"), one ? "es" : "", one ? "its" : "their", name,
                          made.first_part, made.first, one ? "" : "worst ", one ? "" : made.worst + ", ");
  made.text += made.unit.empty() ? fmt::format("{} of the judged time, up to {}", texts::share_of_time(worst.share), on_end)
                                 : fmt::format("{}, {}{:g} control periods ({:.3g} s), in all {} of the judged time", on_end,
                                               made.margin < 0 ? "more than " : "of at most ", run.limits().saturated_periods,
                                               made.limit, texts::share_of_time(worst.share));
}

template <MotorLimit limit, TickColumn column>
void judge_saturation(const CheckedRun& run, Check& made) {
  if (left_open(made, run.unknown(column))) return;
  const Saturated found = saturated(run, limit);
  made.parts = found.joints;
  if (!found.worst && !run.faults.empty()) made.text = kAllFaulty;
  if (!found.worst) return;
  if (left_open(made, unstated(run, limit, found.worst->share))) return;
  made.criteria = found.worst->criteria;
  const Criterion& decisive = found.worst->share > 0 ? found.worst->decisive() : found.worst->criteria.front();
  made.value = decisive.value;
  made.limit = decisive.limit;
  made.unit = decisive.unit;
  made.margin = found.worst->margin();
  made.status = made.margin < 0 ? CheckStatus::fail : made.parts > 0 ? CheckStatus::warn : CheckStatus::pass;
  made.source =
      (made.unit.empty() ? threshold("saturated_share", run.limits().saturated_share, Limits().saturated_share)
                         : threshold("saturated_periods", run.limits().saturated_periods, Limits().saturated_periods)) +
      run.of_motors();
  const char* const name = !run.has_dc_motors ? "actuator" : limit == MotorLimit::voltage ? "voltage" : "current";
  made.text = fmt::format("no joint is at the limit of its {}", name);
  if (made.parts > 0) describe(run, *found.worst, limit, name, made);
  made.certain = certain(found.bars);
  if (!found.widest || !too_close(found.bars)) return;
  made.error = run.torque_error(found.widest->joint);
  made.status = CheckStatus::too_close;
  made.text += fmt::format(
      "; joint {} may be at that limit, within the error of its torque ({}), for up to {} of the judged time, {} "
      "on end",
      run.joint(found.widest->joint), texts::rough_percent(made.error), texts::share_of_time(found.widest->share),
      time_on_end(found.widest->longest.length()));
  const double error = std::max(made.error, run.limits().most_torque_error());
  made.remedy = "take " + torque_remedy(run.scenario, error);
  made.retry = finer_setting(run.scenario, error);
}

constexpr const char* kSaturated =
    "above limits.saturated_share, or a stretch of more than limits.saturated_periods control periods";

}  // namespace

std::vector<CheckKind> checks::saturation() {
  return {{"voltage", CheckGroup::motor, "", "Voltage suffices", "share of the window at the voltage limit, over all steps",
           kSaturated, "any", CheckSpan::window, "actuator.u_max", kGentler,
           judge_saturation<MotorLimit::voltage, kVoltageLimited>, false, false, false, Lost::share},
          {"current", CheckGroup::motor, "", "Current suffices",
           "share of the window at the current limit (of other actuators: at their limit), over all steps", kSaturated, "any",
           CheckSpan::window, "actuator.i_max", kGentler, judge_saturation<MotorLimit::current, kCurrentLimited>, false, false,
           false, Lost::share}};
}

}  // namespace gaitlab::report
