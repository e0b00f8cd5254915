// Checks of motors and gears.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "core/settings/wording.h"
#include "report/verdict/checks.h"
#include "report/verdict/load_checks.h"
#include "report/verdict/number_texts.h"

namespace gaitlab::report {

std::string CheckedRun::unknown(TickColumn column) const {
  if (!driven()) return "nothing drives the joints";
  if (record.ticked() == 0 || record.ticks.rows() < 2) return "the run ended at once";
  return record.tick(0, column).empty() ? "this quantity was not recorded" : "";
}

bool CheckedRun::faulty(std::size_t joint, CheckSpan span) const {
  const double from = span == CheckSpan::window ? summary.judged.from : 0;
  return std::ranges::any_of(
      faults, [&](const FaultSpan& fault) { return fault.joint == joint && fault.to > from && fault.from < record.simulated; });
}

double CheckedRun::torque_error(std::size_t joint) const { return joint < torque_errors.size() ? torque_errors[joint] : 0; }

std::string CheckedRun::of_motors() const {
  if (motor_source.empty()) return "";
  return fmt::format("; motors: {}{}{}", motor_source, motor_defaults.empty() ? "" : "; ", motor_defaults);
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

/// Sets Check::first to the end of the first row after row `after` in which any driven joint is `beyond`, and Check::first_part
/// to that joint. Changes neither if there is none.
template <class Beyond>
void find_first(const CheckedRun& run, std::size_t after, TickColumn column, const Beyond& beyond, Check& made) {
  const Series t(run.record.ticks, 0);
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    const Series values = run.record.tick(j, column);
    if (values.empty() || !run.judges(j, made.span)) continue;
    for (std::size_t k = after + 1; k < t.size() && !(t[k] >= made.first); ++k) {
      if (!beyond(j, values[k])) continue;
      made.first = t[k];
      made.first_part = run.joint(j);
      break;
    }
  }
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
    bars.push_back(ErrorBar::around(run.joint(j), share, run.torque_error(j)));
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

void envelope(const CheckedRun& run, Check& made) {
  rated(run, made, kEnvelopePeak, "the actuator states no limit", run.limits().warn_share, kNever, [&](std::size_t j) {
    const JudgedJoint& joint = run.summary.judged.joints[j];
    return Rated{joint.envelope_peak, run.motors.joint(j).command ? 1.0 : 0.0, joint.envelope_peak_time};
  });
  if (made.status == CheckStatus::not_judged) return;
  made.limit = run.limits().warn_share;
  made.source = threshold("warn_share", made.limit, Limits().warn_share) + run.of_motors();
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
      [&](std::size_t j, double now) { return now > (by_rating ? rating(j) : no_load(j)); }, made);
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
        run, 0, kTorquePeak, [&](std::size_t j, double now) { return rating(j) > 0 && now > rating(j); }, made);
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
