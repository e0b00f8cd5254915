// The check `stall`: motors that hold a joint at rest.

#include "report/verdict/checks/rated.h"

namespace gaitlab::report {

namespace {

constexpr double kAtRest = 0.05;           // share of the no-load speed
constexpr double kLeastRest = 0.1;         // s, least time at rest that counts
constexpr double kRoundedDown = 1 - 1e-9;  // tolerance of a time that is a difference
constexpr double kMostAtRest = 0.5;  // largest RMS without a warning, share of the stall torque (chosen: as at largest power)

/// Torque of a joint at rest, N m.
struct Held {
  double rms = 0;           ///< over its whole time at rest in the window; 0 if this time is below kLeastRest
  double stretch = 0;       ///< largest RMS over kLeastRest without interruption at rest
  double from = 0, to = 0;  ///< s, of this stretch
  double first = kNever;    ///< s, end of the first stretch beyond the stall torque
  [[nodiscard]] double most() const { return std::max(rms, stretch); }
};

Held held(const CheckedRun& run, std::size_t joint, double slow, double stall) {
  const Series t(run.record.ticks, 0);
  const Series speed = run.record.tick(joint, kSpeedPeak);
  const Series square = run.record.tick(joint, kTorqueSquare);
  Held made;
  double sum = 0;  // integral of torque^2 at rest
  double time = 0;
  std::size_t from = run.summary.judged.first_row;
  for (std::size_t k = from + 1; k < t.size(); ++k) {
    if (!(speed[k] < slow)) {
      from = k;
      continue;
    }
    sum += square[k] - square[k - 1];
    time += t[k] - t[k - 1];
    while (from + 1 < k && t[k] - t[from + 1] >= kLeastRest * kRoundedDown) ++from;
    if (t[k] - t[from] < kLeastRest * kRoundedDown) continue;
    const double rms = std::sqrt(std::max(0.0, square[k] - square[from]) / (t[k] - t[from]));
    if (rms > stall) made.first = std::min(made.first, t[k]);
    if (!(rms > made.stretch)) continue;
    made.stretch = rms;
    made.from = t[from];
    made.to = t[k];
  }
  if (time >= kLeastRest * kRoundedDown) made.rms = std::sqrt(sum / time);
  return made;
}

/// A joint with its torque at rest.
struct Rest {
  std::size_t joint = 0;
  Held held;
  double stall = 0;  ///< N m
  ErrorBar bar;
  [[nodiscard]] double most() const { return held.most() / stall; }
  [[nodiscard]] double rms() const { return held.rms / stall; }
};

/// Every joint with a stall torque. It does not have an error bar if its motor cannot exceed this torque.
std::vector<Rest> rests(const CheckedRun& run, Check& made) {
  constexpr double kEqual = 1 + 1e-9;
  std::vector<Rest> all;
  for (std::size_t j = 0; j < run.summary.judged.joints.size(); ++j) {
    const Envelope& motor = run.motors.joint(j);
    if (!motor.stall || !(*motor.stall > 0) || !motor.no_load || !run.scenario.robot->joints[j].driven()) continue;
    made.text = kAllFaulty;
    if (!run.judges(j, made.span)) continue;
    Rest one{j, held(run, j, kAtRest * *motor.no_load, *motor.stall), *motor.stall, {}};
    const bool bounded = motor.holds && *motor.holds <= kEqual * one.stall;
    if (bounded) {
      one.held.rms = std::min(one.held.rms, one.stall);
      one.held.stretch = std::min(one.held.stretch, one.stall);
      one.held.first = kNever;
    }
    one.bar = ErrorBar::around(run.joint(j), one.most(), bounded ? 0 : run.torque_error(j));
    all.push_back(one);
  }
  return all;
}

/// The joint that decides the check: the joint with the least margin or, if this joint passes, the joint with the largest RMS
/// if this RMS causes a warning.
const Rest& decisive(const std::vector<Rest>& all) {
  const Rest& worst = *std::ranges::max_element(all, {}, &Rest::most);
  const Rest& warmest = *std::ranges::max_element(all, {}, &Rest::rms);
  return worst.most() <= 1 && warmest.rms() > kMostAtRest ? warmest : worst;
}

}  // namespace

std::vector<CheckKind> checks::stall() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    if (left_open(made, run.unknown(kTorqueSquare))) return;
    made.text = "the actuator is not made of DC motors, and has no stall torque";
    const std::vector<Rest> all = rests(run, made);
    if (all.empty()) return;
    const Rest& worst = decisive(all);
    const Held& torque = worst.held;
    made.limit = worst.stall;
    made.criteria = {{torque.rms, made.limit, made.unit}, {torque.stretch, made.limit, made.unit}};
    made.margin = 1 - worst.most();
    made.status = worst.most() > 1 ? CheckStatus::fail : graded(worst.rms(), kMostAtRest, 1);
    made.source = run.motor_source;
    made.text = "no driven joint rests";
    made.value = worst.held.most();
    if (!(made.value > 0)) return;
    const bool whole = torque.rms > made.limit || made.status == CheckStatus::warn || torque.rms >= torque.stretch;
    made.value = whole ? torque.rms : torque.stretch;
    name_joint(made, run, worst.joint);
    made.parts = static_cast<std::size_t>(std::ranges::count_if(all, [](const Rest& one) { return one.most() > 1; }));
    if (const Rest& soonest = *std::ranges::min_element(all, {}, [](const Rest& one) { return one.held.first; });
        soonest.held.first < kNever) {
      made.first = soonest.held.first;
      made.first_part = run.joint(soonest.joint);
    }
    made.text = fmt::format("joint {} has a stall torque of {:.3g} N m and holds {:.3g} N m at rest", made.worst, made.limit,
                            made.value);
    if (!whole) {
      made.from = torque.from;
      made.to = torque.to;
      made.text += fmt::format(" for {:g} s from {:.2f} s", kLeastRest, made.from);
    }
    std::vector<ErrorBar> bars;
    for (const Rest& one : all) bars.push_back(one.bar);
    widen(run.scenario, bars, made);
  };
  return {{"stall", CheckGroup::motor, "N m", "Motors hold at rest",
           fmt::format("torque of a joint while it turns at less than {} of its no-load speed, RMS over all this time and over "
                       "any {:g} s on end, compared with the stall torque at the supply voltage",
                       texts::percent(kAtRest), kLeastRest),
           "above the stall torque, if the motor's law allows that",
           "RMS over all the time at rest above half of the stall "
           "torque",
           CheckSpan::window, "actuator.stall_torque",
           "a pose with less load, or a stronger motor; what friction and gear hold beyond that is not counted", judge}};
}

}  // namespace gaitlab::report
