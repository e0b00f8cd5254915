// The check `fall`: the centre of mass keeps its height.

#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::fall() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    if (run.scenario.base != Base::floating || !run.scenario.ground.exists()) {
      made.text = "judged only for a floating base above a ground";
      return;
    }
    if (!run.fall) {
      made.text =
          heights(run.scenario, run.record).empty() ? kNoPoses : "the centre of mass is in the ground in the start pose";
      return;
    }
    take_limit(made, "height", &Limits::height, run);
    made.value = run.fall->share;
    made.from = run.fall->time.value_or(run.fall->lowest_time);
    made.to = run.fall->lowest_time;
    made.status = run.fall->time ? CheckStatus::fail : CheckStatus::pass;
    const std::string share =
        texts::percent(made.value) + (run.fall->told ? " of the height that it would have with all joints at their set points"
                                                     : " of its height above the ground at the start");
    made.text = "the centre of mass keeps at least " + share;
    if (made.status == CheckStatus::pass) return;
    made.text =
        fmt::format("the robot falls at {:.2f} s: the centre of mass comes {}", made.from,
                    run.fall->lowest < 0 ? fmt::format("{:.3g} m below the ground", -run.fall->lowest) : "down to " + share);
    made.first = made.from;
    if (run.fall->stays) {
      made.text += ", and does not rise again";
      made.to = run.record.simulated;
    }
    made.remedy = kMoreSupport;
  };
  return {
      {"fall", CheckGroup::run, "", "Does not fall",
       "least height of the centre of mass above the ground at control ticks, relative to the lower of two heights: the one in "
       "the start pose, lowered onto the ground, and the one in the pose of the set points at that time, upright (mean "
       "orientation of all links as at the start) on its lowest contact elements",
       "below limits.height", "", CheckSpan::whole_run, "limits.height", "a gait with more support, or limits.height", judge,
       true, false, false, Lost::extreme}};
}

}  // namespace gaitlab::report
