// The check `envelope`: torques within reach of the actuators at their speeds.
#include "report/verdict/checks/rated.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::envelope() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    rated(run, made, kEnvelopePeak, "the actuator states no limit", run.limits().warn_share, kNever, [&](std::size_t j) {
      const JudgedJoint& joint = run.summary.judged.joints[j];
      return JointRated{joint.envelope_peak, run.motors.joint(j).command ? 1.0 : 0.0, joint.envelope_peak_time};
    });
    if (made.status == CheckStatus::not_judged) return;
    made.limit = run.limits().warn_share;
    made.source = threshold("warn_share", made.limit, Limits().warn_share) + run.of_motors();
    made.text = fmt::format("the torque of joint {} is {} of its {}'s limit at that speed", made.worst,
                            texts::percent(made.value), run.has_dc_motors ? "motor" : "actuator");
  };
  return {{"envelope", CheckGroup::motor, "", "Torque within reach",
           "largest torque, as a share of the actuator's torque at that speed and in that direction, over all steps", "",
           "above limits.warn_share", CheckSpan::window, "actuator", kGentler, judge}};
}

}  // namespace gaitlab::report
