// Checks of motors and gears.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "core/settings/wording.h"
#include "report/analysis/row_statistics.h"
#include "report/verdict/checks.h"
#include "report/verdict/load_checks.h"
#include "report/verdict/number_texts.h"

namespace gaitlab::report {

std::string CheckedRun::unknown(TickColumn column) const {
  if (!driven()) return "nothing drives the joints";
  if (record.ticked() == 0 || record.ticks.rows() < 2)
    return "statistics of all steps were not recorded: the folder is of an older format, or the run ended at once";
  if (record.tick(0, column).empty()) return "the folder is of an older format, which does not contain this quantity";
  const std::string lacks = record.ticks_of_rows ? lacking(record, *scenario.robot, column) : "";
  return lacks.empty() ? "" : fmt::format("the trace has no column {}", lacks);
}

bool CheckedRun::faulty(std::size_t joint, CheckSpan span) const {
  const double from = span == CheckSpan::window ? summary.judged.from : 0;
  return std::ranges::any_of(
      faults, [&](const FaultSpan& fault) { return fault.joint == joint && fault.to > from && fault.from < record.simulated; });
}

std::pair<double, double> row_before(const Recording& record, double time) {
  const Series t(record.ticks, 0);
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (t[k] >= time) return {t[k - 1], t[k]};
  }
  return {time, time};
}

CheckStatus graded(double value, double pass, double warn) {
  return value <= pass ? CheckStatus::pass : value <= warn ? CheckStatus::warn : CheckStatus::fail;
}

namespace {

constexpr double kLeastTold = 1e-3;  // s; a shorter time is a few steps

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

/// Addition to the source of a threshold: the sources of the motor values.
std::string of_motors(const CheckedRun& run) {
  if (run.motor_source.empty()) return "";
  return fmt::format("; motors: {}{}{}", run.motor_source, run.motor_defaults.empty() ? "" : "; ", run.motor_defaults);
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

/// Relative error of a joint's torque, which is also that of its current; 0 if not estimated.
double error_of(const CheckedRun& run, std::size_t joint) {
  return joint < run.torque_errors.size() ? run.torque_errors[joint] : 0;
}

/// Sets Check::first to the end of the first row after row `after` in which any driven joint is `beyond`, and Check::first_part
/// to that joint. Changes neither if there is none.
template <class Beyond>
void find_first(const CheckedRun& run, std::size_t after, TickColumn column, const Beyond& beyond, Check& made) {
  const Series t(run.record.ticks, 0);
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    const Series values = run.record.tick(j, column);
    if (values.empty() || !run.judges(j, made.span)) continue;
    for (std::size_t k = after + 1; k < t.size() && !(t[k] >= made.first); ++k) {
      if (!beyond(j, values[k], values[k - 1])) continue;
      made.first = t[k];
      made.first_part = run.joint(j);
      break;
    }
  }
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

/// Error bar of a joint. Its lower end is from `at` with times shorter by the share `error`, its upper end from `widest`.
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
    constexpr double kEqual = 1e-9;  // differences of margins below this are rounding
    const double nearer = other ? other->margin() - one.margin() : 1;
    return std::abs(nearer) > kEqual ? nearer > 0 : one.share > kLarger * other->share;
  };
  Saturated made;
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    if (!run.judges(j, CheckSpan::window)) continue;
    const AtLimit one = at_limit(run, j, 0, limit);
    if (one.share > 0) ++made.joints;
    if (worse(one, made.worst)) made.worst = one;
    const double error = error_of(run, j);
    const bool known = error > 0 && error <= most_torque_error(run.limits());  // a larger error does not show anything
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
    const double begins = t[static_cast<std::size_t>(row - parts.begin())] - *row;
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
  made.part = Part::joint;
  made.worst = run.joint(worst.joint);
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

void saturation(const CheckedRun& run, Check& made, MotorLimit limit, TickColumn column) {
  made.text = run.unknown(column);
  if (!made.text.empty()) return;
  const Saturated found = saturated(run, limit);
  made.parts = found.joints;
  if (!found.worst && !run.faults.empty()) made.text = kAllFaulty;
  if (!found.worst) return;
  made.text = unstated(run, limit, found.worst->share);
  if (!made.text.empty()) return;
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
      of_motors(run);
  const char* const name = !run.has_dc_motors ? "actuator" : limit == MotorLimit::voltage ? "voltage" : "current";
  made.text = fmt::format("no joint is at the limit of its {}", name);
  if (made.parts > 0) describe(run, *found.worst, limit, name, made);
  made.certain = certain(found.bars);
  if (!found.widest || !too_close(found.bars)) return;
  made.error = error_of(run, found.widest->joint);
  made.status = CheckStatus::too_close;
  made.text +=
      fmt::format("; joint {} is within the error of its torque, {}, of that limit for up to {} of the judged time, {} on end",
                  run.joint(found.widest->joint), texts::rough_percent(made.error), texts::share_of_time(found.widest->share),
                  time_on_end(found.widest->longest.length()));
  const double error = std::max(made.error, most_torque_error(run.limits()));
  made.remedy = "take " + torque_remedy(run.scenario, error);
  made.retry = finer_setting(run.scenario, error);
}

/// Value of a joint, its limit, and the time of the value in s. NaN if not known; an infinite or 0 limit is not stated.
struct Rated {
  double value, limit, time;
};

/// Judges the joint with the least margin. `none` is the text if no joint has a limit. Returns the error bars of all joints
/// with a limit.
template <class Rate>
std::vector<ErrorBar> rated(const CheckedRun& run, Check& made, TickColumn column, const char* none, double pass, double warn,
                            Rate rate) {
  made.text = run.unknown(column);
  std::vector<ErrorBar> bars;
  if (!made.text.empty()) return bars;
  bool faulty = !run.faults.empty();
  double worst = -1;
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    if (!run.judges(j, made.span)) continue;
    faulty = false;
    const Rated of = rate(j);
    if (!std::isfinite(of.limit) || !(of.limit > 0)) continue;
    const double share = of.value / of.limit;
    bars.push_back(ErrorBar::around(run.joint(j), share, error_of(run, j)));
    if (share > (std::isfinite(warn) ? warn : pass)) ++made.parts;
    if (share <= kLarger * worst) continue;
    worst = share;
    made.value = of.value;
    made.limit = of.limit;
    made.part = Part::joint;
    made.worst = run.joint(j);
    std::tie(made.from, made.to) = row_before(run.record, of.time);
  }
  made.text = faulty ? kAllFaulty : none;
  if (worst < 0) return bars;
  made.status = graded(worst, pass, warn);
  made.source = run.motor_source;
  made.text.clear();
  return bars;
}

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kNoTime = std::numeric_limits<double>::quiet_NaN();

}  // namespace

namespace checks {

void voltage(const CheckedRun& run, Check& made) { saturation(run, made, MotorLimit::voltage, kVoltageLimited); }

void current(const CheckedRun& run, Check& made) { saturation(run, made, MotorLimit::current, kCurrentLimited); }

void envelope(const CheckedRun& run, Check& made) {
  rated(run, made, kEnvelopePeak, "the actuator states no limit", run.limits().warn_share, kNever, [&](std::size_t j) {
    const JudgedJoint& joint = run.summary.judged.joints[j];
    return Rated{joint.envelope_peak, run.motors.joint(j).command ? 1.0 : 0.0, joint.envelope_peak_time};
  });
  if (made.status == CheckStatus::not_judged) return;
  made.limit = run.limits().warn_share;
  made.source = threshold("warn_share", made.limit, Limits().warn_share) + of_motors(run);
  made.text = fmt::format("the torque of joint {} is {} of its {}'s limit at that speed", made.worst,
                          texts::percent(made.value), run.has_dc_motors ? "motor" : "actuator");
}

void speed(const CheckedRun& run, Check& made) {
  const char* const none = "the actuator has torque at any speed, and states no largest speed";
  const auto no_load = [&](std::size_t j) { return run.motors.joint(j).no_load.value_or(kNever); };
  const auto rating = [&](std::size_t j) { return run.motors.joint(j).speed_max.value_or(kNever); };
  // A landing may exceed the no-load speed, so that speed is compared with the judged window only. A maker's rating must be
  // kept from the first step on.
  const double share = run.limits().warn_share;
  Check broken = made;
  broken.span = CheckSpan::whole_run;
  rated(run, broken, kSpeedPeak, none, share, 1, [&](std::size_t j) {
    const JudgedJoint& joint = run.summary.judged.whole[j];
    return Rated{joint.speed_peak, rating(j), joint.speed_peak_time};
  });
  rated(run, made, kSpeedPeak, none, share, 1, [&](std::size_t j) {
    const JudgedJoint& joint = run.summary.judged.joints[j];
    return Rated{joint.speed_peak, no_load(j), joint.speed_peak_time};
  });
  const bool unreached = made.status != CheckStatus::not_judged;
  const bool worse = broken.status == CheckStatus::fail ||  // a longer run cannot undo a failure
                     (made.status != CheckStatus::fail && broken.value / broken.limit >= made.value / made.limit);
  const bool by_rating = broken.status != CheckStatus::not_judged && (!unreached || worse);
  if (by_rating) made = broken;
  if (made.status == CheckStatus::not_judged) return;
  made.span = by_rating ? CheckSpan::whole_run : CheckSpan::window;
  find_first(
      run, by_rating ? 0 : run.summary.judged.first_row, kSpeedPeak,
      [&](std::size_t j, double now, double) { return now > (by_rating ? rating(j) : no_load(j)); }, made);
  made.text = fmt::format("joint {} turns at up to {:.3g} rad/s of {:.3g} rad/s", made.worst, made.value, made.limit);
  if (made.status != CheckStatus::fail) return;
  made.text += by_rating ? ", more than it is rated for" : ", faster than its motor can drive it: the load does";
}

void heat(const CheckedRun& run, Check& made) {
  const std::vector<ErrorBar> bars =
      rated(run, made, kCurrentSquare, "no continuous current of the motors is stated (actuator.i_continuous)",
            run.limits().warn_share, 1, [&](std::size_t j) {
              return Rated{run.summary.judged.joints[j].current_rms, run.motors.joint(j).continuous.value_or(0), kNoTime};
            });
  if (made.status == CheckStatus::not_judged) return;
  made.text = fmt::format("the motor of joint {} takes {:.3g} A RMS, {} of its continuous rating", made.worst, made.value,
                          texts::percent(made.value / made.limit));
  widen(run.scenario, bars, made);
}

void gear_peak(const CheckedRun& run, Check& made) {
  const auto rating = [&](std::size_t j) { return run.motors.joint(j).gear_peak.value_or(0); };
  const std::vector<ErrorBar> bars = rated(
      run, made, kTorquePeak, "no largest torque of the gears is stated (actuator.gear_torque_peak)", run.limits().warn_share,
      1, [&](std::size_t j) {
        const JudgedJoint& joint = run.summary.judged.whole[j];
        const std::optional<GearPeak> passed = gear_load(run.record, j, rating(j));
        return Rated{passed ? passed->torque : joint.torque_peak, rating(j), passed ? passed->time : joint.torque_peak_time};
      });
  if (made.status == CheckStatus::not_judged) return;
  bool measured = false;
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    const std::optional<GearPeak> passed = gear_load(run.record, j, rating(j));
    measured = measured || passed;
    if (!passed || !passed->beyond || *passed->beyond >= made.first || !run.judges(j, made.span)) continue;
    made.first = *passed->beyond;
    made.first_part = run.joint(j);
  }
  if (!measured) {
    find_first(
        run, 0, kTorquePeak, [&](std::size_t j, double now, double) { return rating(j) > 0 && now > rating(j); }, made);
  }
  made.text = fmt::format("the gear of joint {} passes on up to {:.3g} N m of {:.3g} N m", made.worst, made.value, made.limit);
  widen(run.scenario, bars, made);
}

void gear_continuous(const CheckedRun& run, Check& made) {
  const std::vector<ErrorBar> bars =
      rated(run, made, kTorqueSquare, "no continuous torque of the gears is stated (actuator.gear_torque_continuous)",
            run.limits().warn_share, 1, [&](std::size_t j) {
              return Rated{run.summary.judged.joints[j].torque_rms, run.motors.joint(j).gear_continuous.value_or(0), kNoTime};
            });
  if (made.status == CheckStatus::not_judged) return;
  made.text = fmt::format("the gear of joint {} takes {:.3g} N m RMS of {:.3g} N m", made.worst, made.value, made.limit);
  widen(run.scenario, bars, made);
}

}  // namespace checks

}  // namespace gaitlab::report
