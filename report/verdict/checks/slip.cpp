// The check `slip`: loaded feet hold.
#include "core/model/pattern.h"
#include "report/analysis/legs.h"
#include "report/verdict/checks/loads.h"

namespace gaitlab::report {

std::vector<CheckKind> checks::slip() {
  const auto judge = [](const CheckedRun& run, Check& made) {
    made.source = threshold("slip", run.limits().slip, Limits().slip);
    if (left_open(made, unknown_of_feet(run))) return;
    const LoadWindow window(run.record, run.summary);
    const double way = window.grown(window.series("path"));
    const double slip = window.grown(window.series("slip"));
    std::vector<std::size_t> feet;  // bodies of the feet
    std::size_t worst = 0;
    double farthest = 0;
    for (const Column& column : run.record.loads.columns) {
      if (!glob("foot.*.slid", column.name)) continue;
      const std::string body = column.name.substr(5, column.name.size() - 10);
      const std::vector<Body>& bodies = run.scenario.robot->bodies;
      const auto at = static_cast<std::size_t>(std::ranges::find(bodies, body, &Body::name) - bodies.begin());
      const double slid = window.grown(window.series(column.name));
      if (at == bodies.size()) continue;
      if (slid > farthest) {
        farthest = slid;
        worst = feet.size();
        made.part = Part::foot;
        made.worst = body;
      }
      feet.push_back(at);
    }
    if (!walks(way, made)) return;
    made.value = slip / way;
    made.limit = run.limits().slip;
    passes(made, made.limit);
    made.from = window.time(window.start);
    made.to = window.loads.at(window.loads.rows() - 1, 0);
    made.text = made.worst.empty() ? "no foot slides under load"
                                   : fmt::format(
                                         "feet under load slide {} on average, {} of the way of {}; farthest foot {}, "
                                         "{}",
                                         texts::length(slip), texts::percent(made.value), texts::length(way),
                                         foot_names(run.scenario, feet)[worst], texts::length(farthest));
  };
  return {{"slip", CheckGroup::ground, "", "Feet hold",
           "slip distance of the feet, weighted by load, relative to the distance of the centre of mass, both at control ticks",
           "", "above limits.slip", CheckSpan::window, "ground.friction", "feet that are lifted higher, or ground.friction",
           judge}};
}

}  // namespace gaitlab::report
