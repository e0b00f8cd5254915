// The check `creep`: feet that a real ground would hold do not move.
#include "report/analysis/motion.h"
#include "report/verdict/checks/loads.h"

namespace gaitlab::report {

constexpr double kMostCreep = 0.02;

std::vector<CheckKind> checks::creep() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    if (left_open(made, unknown_of_feet(run))) return;
    const LoadWindow window(run.record, run.summary);
    const Motion m = motion(run.record);
    const double creep = std::hypot(window.grown(window.series("creep.x")), window.grown(window.series("creep.y")));
    made.text = "the creep of feet, or the poses at control ticks, were not recorded";
    if (std::isnan(creep) || m.x.size() != window.loads.rows() || m.y.size() != m.x.size()) return;
    const double travel = std::hypot(m.x.back() - m.x[window.start], m.y.back() - m.y[window.start]);
    if (!walks(travel, made)) return;
    made.value = creep / travel;
    made.limit = kMostCreep;
    passes(made, made.limit);
    made.from = window.time(window.start);
    made.to = window.time(window.loads.rows() - 1);
    made.text = fmt::format("where a real ground would hold the feet, they creep {}, {} of the travel of {}",
                            texts::length(creep), texts::percent(made.value), texts::length(travel));
    if (made.status == CheckStatus::warn)
      made.text += fmt::format("; contact.slip_speed: {:.3g} would halve it", run.scenario.contact.penalty.v_lim / 2);
  };
  return {{"creep", CheckGroup::trust, "", "Standing feet do not creep",
           "net displacement of the feet, weighted by load, while they slide below contact.slip_speed, where a real ground "
           "would hold them; relative to that of the centre of mass",
           "", "above " + texts::percent(kMostCreep), CheckSpan::window, "contact.slip_speed", "a smaller contact.slip_speed",
           judge}};
}

}  // namespace gaitlab::report
