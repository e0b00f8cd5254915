#include "report/verdict/trust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/scenario/sensor_section.h"
#include "core/settings/wording.h"
#include "core/simulation/step_advice.h"
#include "core/simulation/step_error.h"
#include "report/analysis/summary.h"
#include "report/verdict/numbers/number_texts.h"

namespace gaitlab::report {

namespace {

constexpr double kLeastAccuracy = 1e-6;  // least value that a scenario may request
constexpr double kMargin = 2;            // factor by which a remedy is stricter than necessary

/// Rounds down to one digit: 0.0037 becomes 0.003.
double one_digit(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  return std::floor(value / decade) * decade;
}

}  // namespace

std::string finer_setting(const Scenario& s, double share) {
  if (quantised(s)) return "";
  const Physics& physics = s.physics;
  const double ratio = std::min({kAccurate, torque_error_limit(s), s.limits.most_torque_error()}) / share / kMargin;
  if (physics.adapts())
    return fmt::format("physics.accuracy={:.1g}", std::max(one_digit(physics.accuracy * ratio), kLeastAccuracy));
  const int order = std::max(1, physics.integrator->order);
  const double step = usable_step(s, physics.step * std::pow(ratio, 1.0 / order));
  return step > 0 ? fmt::format("physics.step={:.4g}", step) : "";
}

std::string torque_remedy(const Scenario& s, double share) {
  if (quantised(s))
    return "for sensors, noise of deviation resolution/sqrt(12) instead of a resolution, which amplifies rounding errors";
  std::string text = finer_setting(s, share);
  if (const std::size_t sign = text.find('='); sign != std::string::npos) text.replace(sign, 1, ": ");
  if (s.physics.adapts()) return text;
  if (text.empty()) text = "a smaller physics.step";
  if (const Integrator* adaptive = s.physics.engine->adaptive(); adaptive != nullptr) {
    text += fmt::format(", or physics.integrator: {} without a step", adaptive->name);
  }
  return text;
}

std::vector<double> torque_errors(const Recording& r) {
  double largest = 0;
  for (const double peak : r.tally.torque_peak) largest = std::max(largest, peak);
  if (!r.tally.estimated || !(largest > 0)) return {};
  std::vector<double> shares;
  for (std::size_t j = 0; j < r.joints.size(); ++j)
    shares.push_back(r.tally.torque_error[j] / std::max(r.tally.torque_peak[j], StepError::kLeastPeak * largest));
  return shares;
}

TorqueError torque_error(const Recording& r) {
  TorqueError worst;
  const std::vector<double> shares = torque_errors(r);
  for (std::size_t j = 0; j < shares.size(); ++j) {
    if (!(shares[j] <= worst.share)) worst = {true, shares[j], j};  // also true if the share is NaN
    if (std::isnan(worst.share)) break;
  }
  worst.estimated = !(worst.share <= 0);  // the difference has no meaning if both rollouts took the same steps
  return worst;
}

std::string step_text(const Physics& physics) {
  std::string text = physics.adaptive_step ? fmt::format("step auto (at most {:.4g} s)", physics.step)
                                           : fmt::format("step {} s", number_text(physics.step));
  if (physics.adapts()) text += fmt::format(", accuracy {}", texts::rough_percent(physics.accuracy));
  return text;
}

std::string steps_text(const Scenario& scenario, const Recording& r) {
  std::string text = step_text(scenario.physics);
  if (r.tally.solves > 0) text += fmt::format(", {:.0f} solves", r.tally.solves);
  const TorqueError error = torque_error(r);
  if (error.estimated) {
    text += fmt::format("; torque error about {} (joint {})", texts::rough_percent(error.share),
                        scenario.robot->joints[error.joint].name);
    if (r.tally.event.time >= 0 && error.share > torque_error_limit(scenario)) {
      text += fmt::format(", beyond the accuracy first at {:.4g} s (joint {})", r.tally.event.time,
                          scenario.robot->joints[r.tally.event.joint].name);
    }
  } else if (scenario.actuator.entry != nullptr && !r.joints.empty()) {
    text += "; torque error not estimated";
  }
  return text;
}

Predictability predictability(const Scenario& s, const Recording& r) {
  if (!s.physics.adapts() || !r.tally.estimated || !(r.tally.chaotic.share > 0)) return Predictability::unknown;
  const double limit = predictability_limit(s);
  if (!(r.tally.chaotic.share <= limit)) return Predictability::chaotic;
  return r.tally.ill.share <= limit ? Predictability::predictable : Predictability::ill;
}

const Parting& parting(const Scenario& s, const Recording& r) {
  return predictability(s, r) == Predictability::chaotic ? r.tally.chaotic : r.tally.ill;
}

std::string disturbed(double change) { return fmt::format("1 + 1e{:.0f}", std::log10(change)); }

std::string predictability_text(const Scenario& s, const Recording& r) {
  const Predictability found = predictability(s, r);
  const Parting& apart = parting(s, r);
  if (found == Predictability::unknown) {
    return s.physics.adapts() && r.tally.estimated ? "not tested: a disturbed gravity changes no torque of this robot"
                                                   : "not tested: no rollout under a disturbed gravity was made";
  }
  const bool chaotic = found == Predictability::chaotic;
  const std::string share = texts::rough_percent(apart.share);
  const std::string by = disturbed(StepError::kChaotic);
  std::string does = chaotic
                         ? fmt::format("gravity times {} changes the torques by {} of their peak", by, share)
                         : fmt::format("gravity times {} changes the torques by about {} of their peak (in proportion to {})",
                                       disturbed(StepError::kIll), share, by);
  if (found == Predictability::predictable) return does;
  return fmt::format("from t = {:.4g} s on (joint {}) the motion is {}: {}", apart.time, s.robot->joints[apart.joint].name,
                     chaotic ? "not predictable" : "ill-conditioned", does);
}

double least_energy(const Scenario& s) {
  return std::max(s.robot->mass * s.physics.gravity.norm() * kLifted, std::numeric_limits<double>::min());
}

double energy_scale(const Scenario& s, const Recording& r) {
  return std::max({std::abs(r.ledger.electrical), std::abs(r.ledger.stored), least_energy(s)});
}

double residual_share(const Scenario& s, const Recording& r) { return std::abs(r.ledger.residual()) / energy_scale(s, r); }

double created_share(const Scenario& s, const Recording& r) { return texts::created(r) / energy_scale(s, r); }

double torque_error_limit(const Scenario& s) { return s.physics.adapts() ? s.physics.accuracy : kAccurate; }
double predictability_limit(const Scenario& s) {
  return s.physics.adapts() ? std::max(kAccurate, s.physics.accuracy) : kAccurate;
}

std::vector<std::string> not_finite(const Scenario& s, const Recording& r) {
  std::vector<std::string> names;
  const auto look = [&](double value, const std::string& name) {
    if (!std::isfinite(value)) names.push_back(name);
  };
  const Ledger& ledger = r.ledger;
  for (const auto& [name, value] : {std::pair("electrical", ledger.electrical),
                                    {"copper", ledger.copper},
                                    {"gear", ledger.gear},
                                    {"stored", ledger.stored},
                                    {"contact", ledger.contact},
                                    {"friction", ledger.friction},
                                    {"stops", ledger.stops},
                                    {"hinges", ledger.hinges},
                                    {"dry", ledger.dry}})
    look(value, std::string("energy.") + name);
  for (std::size_t j = 0; j < r.joints.size(); ++j) {
    for (const JointStatistic& one : kJointStatistics)
      look(r.joints[j].*one.member, std::string(one.name) + " of " + s.robot->joints[j].name);
  }
  const Summary way = travelled(r);
  look(way.distance, "distance");
  look(way.path_length, "path_length");
  return names;
}

}  // namespace gaitlab::report
