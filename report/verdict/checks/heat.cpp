// The check `heat`: currents that motors bear permanently.
#include "report/verdict/checks/rated.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::heat() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    const std::vector<ErrorBar> bars = rated(
        run, made, kCurrentSquare, "no continuous current of the motors is stated (actuator.i_continuous)",
        run.limits().warn_share, 1, [&](std::size_t j) {
          return JointRated{run.summary.judged.joints[j].current_rms, run.motors.joint(j).continuous.value_or(0), kNoTime};
        });
    if (made.status == CheckStatus::not_judged) return;
    made.text = fmt::format("the motor of joint {} takes {:.3g} A RMS, {} of its continuous rating", made.worst, made.value,
                            texts::percent(made.value / made.limit));
    widen(run.scenario, bars, made);
  };
  return {{"heat", CheckGroup::motor, "A", "Motors stay cool",
           "RMS current in the window, over all steps, compared with the continuous rating", "above actuator.i_continuous",
           "above limits.warn_share of the rating", CheckSpan::window, "actuator.i_continuous", kGentler, judge, false, false,
           true}};
}

}  // namespace gaitlab::report
