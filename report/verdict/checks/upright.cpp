// The check `upright`: the robot does not turn over.
#include "report/analysis/upright.h"

#include <numbers>

#include "core/recording/limit_cycle.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

constexpr double kHorizontal = std::numbers::pi / 2;  // rad

std::vector<CheckKind> checks::upright() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    made.text = run.scenario.base == Base::floating ? kNoPoses : "judged only for a floating base";
    const Judged& judged = run.summary.judged;
    std::optional<Upright> found = report::upright(run.scenario, run.record, judged, 0);
    if (!found) return;
    if (found->over && judged.periods == 0) {
      const double period = run.summary.gait.period;
      found = report::upright(run.scenario, run.record, judged, period);
      made.text =
          fmt::format("the robot turns over at {:.2f} s, and the run is too short to show whether it rolls", *found->over);
      const bool early = run.record.simulated < kPeriodsNeeded * period;
      if (!found->rolls && early && run.record.simulated - *found->over < period) return;
    }
    made.text = "the base rolls: it makes a whole turn in every period";
    if (found->over && found->rolls) return;
    made.value = found->tilt;
    made.limit = kHorizontal;
    made.source = "the horizontal";
    made.from = found->over.value_or(found->tilt_time);
    made.to = found->tilt_time;
    made.status = found->over ? CheckStatus::fail : made.value > run.limits().tilt ? CheckStatus::warn : CheckStatus::pass;
    made.text = fmt::format("the robot tilts by up to {:.3g} rad from its orientation at the start", made.value);
    if (made.status == CheckStatus::warn) made.text += fmt::format(", more than {:.3g} rad (limits.tilt)", run.limits().tilt);
    if (!found->over) return;
    made.first = *found->over;
    made.text = fmt::format("the robot turns over at {:.2f} s: it tilts by up to {:.3g} rad from its orientation at the start",
                            made.from, made.value);
    made.remedy = kMoreSupport;
  };
  return {{"upright", CheckGroup::run, "rad", "Stays upright",
           "largest tilt from the start, of the base or of the mean of all links by mass, whichever is less, at control ticks",
           "both in the base and in that mean, the axis that pointed upwards points below the horizontal; not for a base that "
           "rolls",
           "above limits.tilt", CheckSpan::whole_run, "limits.tilt", "a gait with more support", judge}};
}

}  // namespace gaitlab::report
