// The check `stability`: margin of the stance against tipping.
#include "report/verdict/checks/loads.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::stability() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    if (left_open(made, run.scenario.ground.is_plane() ? unknown_of_feet(run) : "judged only on a plane without boxes")) return;
    const LoadWindow window(run.record, run.summary);
    const Series margin = window.series("stability");
    made.text = "no foot bears a load";
    std::size_t seen = 0;
    std::size_t outside = 0;
    std::size_t aloft = 0;
    for (std::size_t row = window.start + 1; row < margin.size(); ++row) {
      if (std::isnan(margin[row])) {
        ++aloft;
        continue;
      }
      ++seen;
      if (margin[row] < 0) ++outside;
      if (margin[row] >= made.value) continue;  // false if no value was found yet
      made.value = margin[row];
      made.from = made.to = window.time(row);
    }
    if (seen == 0) return;
    made.status = CheckStatus::pass;
    made.text =
        made.value >= 0 && aloft > 0
            ? fmt::format(
                  "a note: no foot bears a load for {} of the time; otherwise the centre of mass stays {} within the support "
                  "polygon",
                  texts::percent(static_cast<double>(aloft) / static_cast<double>(aloft + seen)), texts::length(made.value))
        : made.value >= 0
            ? fmt::format("statically stable: the centre of mass stays {} within the support polygon",
                          texts::length(made.value))
            : fmt::format(
                  "a note: the centre of mass leaves the support polygon by up to {} and is outside for {} of the time on the "
                  "ground, as may happen in a dynamic gait",
                  texts::length(-made.value), texts::percent(static_cast<double>(outside) / static_cast<double>(seen)));
  };
  return {{"stability", CheckGroup::ground, "m", "Stands on its feet",
           "least distance from the centre of mass to the edge of the support polygon; positive inside", "", "",
           CheckSpan::window, "cpg", "only a note: a dynamic gait may fall from foot to foot", judge, false, true}};
}

}  // namespace gaitlab::report
