#include "core/scenario/other_engine.h"

#include <fmt/format.h>

#include "core/settings/wording.h"

namespace gaitlab {

std::vector<std::string> engine_settings(const Scenario& scenario, const std::string& engine, const Integrator& integrator,
                                         const std::string& step) {
  if (integrator.adapts || !scenario.places->contains("physics.accuracy"))
    return {"physics.engine=" + engine, "physics.integrator=" + integrator.name, "physics.step=" + step};
  // `accuracy` can be removed only by replacing the whole section.
  const Vec3& g = scenario.physics.gravity;
  std::string whole = fmt::format("physics={{engine: {}, integrator: {}, step: {}, gravity: [{}, {}, {}]", engine,
                                  integrator.name, step, number_text(g.x()), number_text(g.y()), number_text(g.z()));
  return {whole + (scenario.physics.estimate == Estimate::off ? ", estimate: off}" : "}")};
}

}  // namespace gaitlab
