// The check `speed`: speeds within reach of the actuators, and within their ratings.
#include "report/verdict/checks/rated.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::speed() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    const char* const none = "the actuator has torque at any speed, and states no largest speed";
    const auto no_load = [&](std::size_t j) { return run.motors.joint(j).no_load.value_or(kNever); };
    const auto rating = [&](std::size_t j) { return run.motors.joint(j).speed_max.value_or(kNever); };
    // A landing may exceed the no-load speed, so that only speeds in the judged window are compared with it. A maker's rating
    // must not be exceeded from the first step on.
    const double share = run.limits().warn_share;
    Check broken = made;
    broken.span = CheckSpan::whole_run;
    rated(run, broken, kSpeedPeak, none, share, 1, [&](std::size_t j) {
      const JudgedJoint& joint = run.summary.judged.whole[j];
      return JointRated{joint.speed_peak, rating(j), joint.speed_peak_time};
    });
    rated(run, made, kSpeedPeak, none, share, 1, [&](std::size_t j) {
      const JudgedJoint& joint = run.summary.judged.joints[j];
      return JointRated{joint.speed_peak, no_load(j), joint.speed_peak_time};
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
    made.text = fmt::format("joint {} turns at up to {:.3g} rad/s (limit {:.3g} rad/s)", made.worst, made.value, made.limit);
    if (made.status != CheckStatus::fail) return;
    made.text += by_rating ? ", more than it is rated for" : ", faster than its motor can drive it: the load drives it";
  };
  return {
      {"speed", CheckGroup::motor, "rad/s", "Speed within reach",
       "largest speed, over all steps: in the window, compared with the speed at which the actuator has no torque left; in the "
       "whole run, with the rated speed",
       "above the speed limit", "above limits.warn_share of the speed limit", CheckSpan::window, "actuator.speed_max", kGentler,
       judge}};
}

}  // namespace gaitlab::report
