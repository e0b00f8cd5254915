#include "core/simulation/step_advice.h"

#include <fmt/format.h>

#include <cmath>

namespace gaitlab {

namespace {

bool divides(double step, double period) {
  const double ratio = period / step;
  return std::abs(ratio - std::round(ratio)) <= 1e-9 * ratio;
}

}  // namespace

double usable_step(const Scenario& s, double limit) {
  constexpr double kSeries[] = {5, 2.5, 2, 1.25, 1};
  double decade = 1;
  while (decade > 1e-9) {
    for (const double mantissa : kSeries) {
      const double step = mantissa * decade;
      if (step <= limit && divides(step, s.control_period) && divides(step, s.trace.period) && divides(step, s.duration))
        return step;
    }
    decade /= 10;
  }
  return 0;
}

std::string source_of(const Stability& stability, const Robot& robot, const std::vector<ContactElement>& contacts) {
  switch (stability.source) {
    case Stability::Source::motor:
      return "the motor of joint " + robot.joints[stability.index].name;
    case Stability::Source::stop:
      return "the hinge stop of joint " + robot.joints[stability.index].name;
    case Stability::Source::contact:
      return "the contact " + contacts[stability.index].name;
    case Stability::Source::hinge:
      return "spring, damper and friction of joint " + robot.joints[stability.index].name;
  }
  return "";
}

std::string step_advice(const Scenario& s, const std::vector<ContactElement>& contacts, const Stability& stability,
                        const std::string& when) {
  const double limit = 1 / stability.rate;
  const double use = usable_step(s, limit);
  return fmt::format("step {} s is too long: the largest allowed is {:.3g} s, set by {} ({}; h lambda = {:.3g}, at most 1){}",
                     s.physics.step, limit, source_of(stability, *s.robot, contacts), when, s.physics.step * stability.rate,
                     use > 0 ? fmt::format("; use step: {:.4g}", use) : "");
}

}  // namespace gaitlab
