// The checks `gear_peak` and `gear_continuous`: torques within the ratings of the gears.
#include "report/verdict/checks/loads.h"
#include "report/verdict/checks/rated.h"

namespace gaitlab::report {

namespace {

void judge_gear_peak(const CheckedRun& run, Check& made) {
  const auto rating = [&](std::size_t j) { return run.motors.joint(j).gear_peak.value_or(0); };
  const std::vector<ErrorBar> bars =
      rated(run, made, kTorquePeak, "no largest torque of the gears is stated (actuator.gear_torque_peak)",
            run.limits().warn_share, 1, [&](std::size_t j) {
              const JudgedJoint& joint = run.summary.judged.whole[j];
              const std::optional<GearPeak> passed = gear_load(run.record, j, rating(j));
              return JointRated{passed ? passed->torque : joint.torque_peak, rating(j),
                                passed ? passed->time : joint.torque_peak_time};
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
  made.text =
      fmt::format("the gear of joint {} passes on up to {:.3g} N m (rated {:.3g} N m)", made.worst, made.value, made.limit);
  widen(run.scenario, bars, made);
}

void judge_gear_continuous(const CheckedRun& run, Check& made) {
  const std::vector<ErrorBar> bars = rated(
      run, made, kTorqueSquare, "no continuous torque of the gears is stated (actuator.gear_torque_continuous)",
      run.limits().warn_share, 1, [&](std::size_t j) {
        return JointRated{run.summary.judged.joints[j].torque_rms, run.motors.joint(j).gear_continuous.value_or(0), kNoTime};
      });
  if (made.status == CheckStatus::not_judged) return;
  made.text = fmt::format("the gear of joint {} takes {:.3g} N m RMS (rated {:.3g} N m)", made.worst, made.value, made.limit);
  widen(run.scenario, bars, made);
}

}  // namespace

std::optional<GearPeak> gear_load(const Recording& record, std::size_t joint, double limit) {
  const std::size_t column = record.loads.find(fmt::format("gear.{}.torque", joint));
  if (column == record.loads.columns.size() || record.loads.rows() == 0) return {};
  const Series torque(record.loads, column);
  const Series time(record.loads, 0);
  GearPeak peak;
  for (std::size_t row = 0; row < torque.size(); ++row) {
    const double now = std::abs(torque[row]);
    if (limit > 0 && now > limit && !peak.beyond) peak.beyond = time[row];
    if (!(now > peak.torque)) continue;
    peak.torque = now;
    peak.time = time[row];
  }
  return peak;
}

std::vector<CheckKind> checks::gears() {
  return {{"gear_peak", CheckGroup::motor, "N m", "Gears bear the peaks",
           "largest torque that the gear passes on (the motor's torque minus the torque that turns its rotor), compared with "
           "its rating",
           "above actuator.gear_torque_peak", "above limits.warn_share of the rating", CheckSpan::whole_run,
           "actuator.gear_torque_peak", "a softer start or landing, or another gear", judge_gear_peak, false, false, true,
           Lost::extreme},
          {"gear_continuous", CheckGroup::motor, "N m", "Gears last",
           "RMS torque in the window, over all steps, compared with the gear's rating",
           "above "
           "actuator.gear_torque_continuous",
           "above limits.warn_share of the rating", CheckSpan::window, "actuator.gear_torque_continuous", kGentler,
           judge_gear_continuous, false, false, true}};
}

}  // namespace gaitlab::report
