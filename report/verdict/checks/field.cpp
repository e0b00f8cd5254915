// The check `field`: the robot stays on its heightfield.
#include "report/analysis/motion.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::field() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    const Scenario& s = run.scenario;
    made.text = "judged only on a heightfield";
    const Motion m = motion(run.record);
    if (!s.ground.has_border() || m.x.empty() || m.y.empty()) return;
    made.status = CheckStatus::pass;
    made.text = "the robot stays on its heightfield";
    if (s.ground.beyond_border(m.x.front(), m.y.front())) {  // a warning was printed before the run
      made.status = CheckStatus::not_judged;
      made.text = "the robot starts beside its heightfield";
      return;
    }
    for (std::size_t k = 0; k < m.x.size(); ++k) {
      if (!s.ground.beyond_border(m.x[k], m.y[k])) continue;
      made.status = CheckStatus::warn;
      made.value = made.from = made.to = made.first = m.t[k];
      made.text = fmt::format(
          "the robot leaves its heightfield at t = {:.2f} s, x {:.3g} m, y {:.3g} m: beyond it the heights of "
          "the border continue",
          m.t[k], m.x[k], m.y[k]);
      made.remedy = "take a larger field or spacing";
      return;
    }
  };
  return {{"field", CheckGroup::ground, "s", "Stays on its field", "time when the centre of mass leaves the heightfield", "",
           "any", CheckSpan::whole_run, "ground.heightfield", "a larger field or spacing", judge}};
}

}  // namespace gaitlab::report
