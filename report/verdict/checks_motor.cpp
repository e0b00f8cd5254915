// Checks of motors and gears.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/settings/wording.h"
#include "report/analysis/row_statistics.h"
#include "report/verdict/checks.h"
#include "report/verdict/number_texts.h"

namespace gaitlab::report {

std::string CheckedRun::unknown(TickColumn column) const {
  if (!driven()) return "nothing drives the joints";
  if (record.ticked() == 0 || record.ticks.rows() < 2)
    return "what all steps did was not recorded: the folder is of an older format, or the run ended at once";
  if (record.tick(0, column).empty()) return "the folder is of an older format, which did not keep it";
  const std::string lacks = record.ticks_of_rows ? lacking(record, *scenario.robot, column) : "";
  return lacks.empty() ? "" : fmt::format("the trace has no column {}", lacks);
}

CheckStatus graded(double value, double pass, double warn) {
  return value <= pass ? CheckStatus::pass : value <= warn ? CheckStatus::warn : CheckStatus::fail;
}

namespace {

struct Span {
  double from = 0, to = 0;
  [[nodiscard]] double length() const { return to - from; }
};

/// The longest stretch behind the first row that a joint may have been at the limit without a break: rows of ticks that were so
/// all the while, and the parts of the rows before and after them. A row that was partly at the limit, in how many pieces
/// nobody knows, counts as one piece at its end and one at its start.
Span longest_span(const Recording& record, std::size_t joint, TickColumn limited, std::size_t first) {
  constexpr double kAllTheWhile = 0.999;
  const Series t(record.ticks, 0);
  const Series at = record.tick(joint, limited);
  Span longest;
  Span now;
  for (std::size_t k = first + 1; k < t.size(); ++k) {
    const double part = at[k] - at[k - 1];
    if (now.to != t[k - 1]) now = {t[k - 1], t[k - 1]};
    now.to = t[k - 1] + part;
    if (part > kAllTheWhile * (t[k] - t[k - 1])) now.to = t[k];
    if (now.length() > longest.length()) longest = now;
    if (now.to != t[k]) now = {t[k] - part, t[k]};
    if (now.length() > longest.length()) longest = now;
  }
  return longest;
}

/// Who reports no voltage and no limit cannot be said to keep one.
std::string unstated(const CheckedRun& run, MotorLimit limit, double share) {
  if (share > 0 || run.has_dc_motors) return "";
  if (limit == MotorLimit::voltage) return "the actuator is not made of DC motors, and states no voltage";
  const bool limited = std::ranges::all_of(run.motors.kinds, [](const Envelope& motor) { return motor.command.has_value(); });
  return limited ? "" : "the actuator states no limit";
}

/// Behind a threshold on what motors have.
std::string of_motors(const CheckedRun& run) {
  return run.motor_source.empty() ? "" : fmt::format("; motors: {}", run.motor_source);
}

void saturation(const CheckedRun& run, Check& made, MotorLimit limit, TickColumn column, double JudgedJoint::*share) {
  made.text = run.unknown(column);
  if (!made.text.empty()) return;
  const Judged& judged = run.summary.judged;
  const double most = run.limits().saturated_periods * run.scenario.control_period;
  const auto long_enough = [&](double stretch) { return stretch > most * (1 + 1e-6); };
  double stretch = 0;
  double value = 0;
  CheckStatus status = CheckStatus::pass;
  for (std::size_t j = 0; j < judged.joints.size(); ++j) {
    const double part = judged.joints[j].*share;
    if (!(part > 0) || !run.scenario.robot->joints[j].driven()) continue;
    ++made.joints;
    const Span span = longest_span(run.record, j, column, judged.first_row);
    const bool fails = part > run.limits().saturated_share || long_enough(span.length());
    const CheckStatus of_joint = fails ? CheckStatus::fail : CheckStatus::warn;
    if (std::pair(of_joint, part) <= std::pair(status, value)) continue;
    status = of_joint;
    value = part;
    made.joint = run.joint(j);
    made.from = span.from;
    made.to = span.to;
    stretch = span.length();
  }
  made.text = unstated(run, limit, value);
  if (!made.text.empty()) return;
  made.value = value;
  made.status = status;
  made.limit = run.limits().saturated_share;
  made.source = threshold("saturated_share", made.limit, Limits().saturated_share) + of_motors(run);
  const char* const name = !run.has_dc_motors ? "actuator" : limit == MotorLimit::voltage ? "voltage" : "current";
  made.text = fmt::format("no joint is at the limit of its {}", name);
  if (made.joints == 0) return;
  made.text =
      fmt::format("{} of {} reach{} the limit of {} {}, ", made.joints, counted(driven_joints(*run.scenario.robot), "joint"),
                  made.joints == 1 ? "es" : "", made.joints == 1 ? "its" : "their", name);
  // What decides comes first: the share, or the stretch where the share alone would pass.
  if (value <= made.limit && long_enough(stretch)) {
    made.text += fmt::format("{} for {:.3g} s on end, more than {:g} control periods ({:.3g} s), in all {} of the window",
                             made.joint, stretch, run.limits().saturated_periods, most, texts::percent(value));
  } else {
    made.text += fmt::format("{} longest: {} of the window, up to {:.3g} s on end", made.joint, texts::percent(value), stretch);
  }
}

/// Of every joint a value and its limit; not a number: not known, not finite or 0: not stated.
struct Rated {
  double value, limit, time;
};

/// The joint that comes nearest to its limit, or is farthest beyond it, which is returned. none: what is said where no joint
/// has a limit.
template <class Rate>
std::size_t rated(const CheckedRun& run, Check& made, TickColumn column, const char* none, double pass, double warn,
                  Rate rate) {
  made.text = run.unknown(column);
  std::size_t found = 0;
  if (!made.text.empty()) return found;
  made.text = none;
  double worst = -1;
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    if (!run.scenario.robot->joints[j].driven()) continue;
    const Rated of = rate(j);
    if (!std::isfinite(of.limit) || !(of.limit > 0)) continue;
    const double share = of.value / of.limit;
    if (share > (std::isfinite(warn) ? warn : pass)) ++made.joints;
    if (share <= kLarger * worst) continue;
    worst = share;
    found = j;
    made.value = of.value;
    made.limit = of.limit;
    made.joint = run.joint(j);
    made.from = made.to = of.time;
  }
  if (worst < 0) return found;
  made.status = graded(worst, pass, warn);
  made.source = run.motor_source;
  made.text.clear();
  return found;
}

/// Share by which the torque of a joint, and so its current, may be off; 0: not estimated.
double error_of(const CheckedRun& run, std::size_t joint) {
  return joint < run.torque_errors.size() ? run.torque_errors[joint] : 0;
}

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kNoTime = std::numeric_limits<double>::quiet_NaN();

}  // namespace

namespace checks {

void voltage(const CheckedRun& run, Check& made) {
  saturation(run, made, MotorLimit::voltage, kVoltageLimited, &JudgedJoint::voltage_limited);
}

void current(const CheckedRun& run, Check& made) {
  saturation(run, made, MotorLimit::current, kCurrentLimited, &JudgedJoint::current_limited);
}

void envelope(const CheckedRun& run, Check& made) {
  rated(run, made, kEnvelopePeak, "the actuator states no limit", run.limits().margin, kNever, [&](std::size_t j) {
    const JudgedJoint& joint = run.summary.judged.joints[j];
    return Rated{joint.envelope_peak, run.motors.joint(j).command ? 1.0 : 0.0, joint.envelope_peak_time};
  });
  if (made.status == CheckStatus::not_judged) return;
  made.limit = run.limits().margin;
  made.source = threshold("margin", made.limit, Limits().margin) + of_motors(run);
  made.text = fmt::format("the torque of joint {} takes {} of what its {} has at that speed", made.joint,
                          texts::percent(made.value), run.has_dc_motors ? "motor" : "actuator");
}

void speed(const CheckedRun& run, Check& made) {
  const auto limit = [&](std::size_t j) {
    const Envelope& motor = run.motors.joint(j);
    return std::min(motor.speed_max.value_or(kNever), motor.no_load.value_or(kNever));
  };
  rated(run, made, kSpeedPeak, "the actuator has torque at any speed, and nobody states the largest one", run.limits().margin,
        1, [&](std::size_t j) {
          const JudgedJoint& joint = run.summary.judged.joints[j];
          return Rated{joint.speed_peak, limit(j), joint.speed_peak_time};
        });
  if (made.status == CheckStatus::not_judged) return;
  made.text = fmt::format("joint {} turns at up to {:.3g} rad/s of {:.3g} rad/s", made.joint, made.value, made.limit);
  if (made.status != CheckStatus::fail) return;
  const bool driven = std::ranges::any_of(run.motors.kinds, [&](const Envelope& motor) { return motor.no_load == made.limit; });
  made.text += driven ? ", faster than its motor can drive it: the load does" : ", more than it is rated for";
}

void heat(const CheckedRun& run, Check& made) {
  const std::size_t worst =
      rated(run, made, kCurrentSquare, "nobody states the continuous current of the motors (actuator.i_continuous)",
            run.limits().margin, 1, [&](std::size_t j) {
              return Rated{run.summary.judged.joints[j].current_rms, run.motors.joint(j).continuous.value_or(0), kNoTime};
            });
  if (made.status == CheckStatus::not_judged) return;
  made.text = fmt::format("the motor of joint {} takes {:.3g} A RMS, {} of what it bears for good", made.joint, made.value,
                          texts::percent(made.value / made.limit));
  widen(run.scenario, error_of(run, worst), made.limit, made);
}

void gear_peak(const CheckedRun& run, Check& made) {
  const std::size_t worst =
      rated(run, made, kTorquePeak, "nobody states the largest torque of the gears (actuator.gear_torque_peak)",
            run.limits().margin, 1, [&](std::size_t j) {
              const JudgedJoint& joint = run.summary.judged.whole[j];
              return Rated{joint.torque_peak, run.motors.joint(j).gear_peak.value_or(0), joint.torque_peak_time};
            });
  if (made.status == CheckStatus::not_judged) return;
  made.text = fmt::format("the gear of joint {} takes up to {:.3g} N m of {:.3g} N m", made.joint, made.value, made.limit);
  widen(run.scenario, error_of(run, worst), made.limit, made);
}

void gear_continuous(const CheckedRun& run, Check& made) {
  const std::size_t worst =
      rated(run, made, kTorqueSquare, "nobody states the continuous torque of the gears (actuator.gear_torque_continuous)",
            run.limits().margin, 1, [&](std::size_t j) {
              return Rated{run.summary.judged.joints[j].torque_rms, run.motors.joint(j).gear_continuous.value_or(0), kNoTime};
            });
  if (made.status == CheckStatus::not_judged) return;
  made.text = fmt::format("the gear of joint {} takes {:.3g} N m RMS of {:.3g} N m", made.joint, made.value, made.limit);
  widen(run.scenario, error_of(run, worst), made.limit, made);
}

}  // namespace checks

}  // namespace gaitlab::report
