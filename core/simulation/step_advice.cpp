#include "core/simulation/step_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/periods.h"
#include "core/simulation/simulation.h"

namespace gaitlab {

double usable_step(const Scenario& s, double limit) {
  constexpr double kSeries[] = {5, 2.5, 2, 1.25, 1};
  constexpr std::size_t kDecades = 9;
  double scale = 1;
  for (std::size_t decade = 0; decade < kDecades; ++decade, scale *= 10) {
    for (const double mantissa : kSeries) {
      const double step = mantissa / scale;  // has the same bits as the decimal text
      const auto divides = [&](double period) { return math::whole_steps(period, step) > 0; };
      if (step <= limit && divides(s.control_period) && divides(s.trace.period) && divides(s.duration)) return step;
    }
  }
  return 0;
}

double stable_step(const Scenario& scenario, double longest) {
  constexpr double kRoom = 0.8;
  constexpr double kContactRoom = 0.45;
  constexpr double kFine = 1e-6;  // share of the control period; short enough for every robot
  Scenario probe = scenario;
  probe.physics.step = scenario.control_period * kFine;
  probe.physics.estimate = Estimate::off;
  probe.duration = probe.trace.period = scenario.control_period;
  probe.trace.columns.clear();
  const Stability standing = Simulation({&probe, 1}).standing();
  const double room = standing.source == Stability::Source::contact ? kContactRoom : kRoom;
  const double limit = standing.rate > 0 ? std::min(longest, room / standing.rate) : longest;
  const double step = usable_step(scenario, limit);
  return step > limit / 100 ? step : 0;
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
    case Stability::Source::play:
      return "the play of joint " + robot.joints[stability.index].name;
  }
  return "";
}

std::string step_advice(const Scenario& s, const std::vector<ContactElement>& contacts, const Stability& stability,
                        const std::string& when) {
  const double limit = 1 / stability.rate;
  const double use = usable_step(s, limit);
  return fmt::format(
      "step {} s is too long: the largest allowed is {:.3g} s, set by {} ({}; h lambda = {:.3g}, allowed up to 1){}",
      s.physics.step, limit, source_of(stability, *s.robot, contacts), when, s.physics.step * stability.rate,
      use > 0 ? fmt::format("; use step: {:.4g}", use) : "");
}

}  // namespace gaitlab
