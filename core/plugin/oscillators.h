// The keys that every oscillator CPG shares, and the coupling graph they describe. Standard library only.
#pragma once
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/plugin/fields.h"
#include "core/plugin/robot_info.h"

namespace gaitlab {

/// Limit cycle phi_to = phi_from + phase_lag.
struct Coupling {
  std::int64_t from = 0, to = 0;
  double weight = 1, phase_lag = 0;

  void fields(Fields& f) {
    f.joint("from", from, "The joint that is followed.");
    f.joint("to", to, "The joint that follows.");
    f.number("weight", weight, {"1/s", -1000, 1000, "Strength of the pull."});
    f.number("phase_lag", phase_lag, {"rad", -100, 100, "Lead of `to` over `from` on the limit cycle."});
  }
};

/// The common keys: frequency, amplitude, offset, phase_lag, couplings.
struct OscillatorKeys {
  PerJoint frequency{0.25}, amplitude{0.6}, offset{0}, phase_lag{1.2};
  int rule = 0;  ///< chain; -1: the list
  std::vector<Coupling> couplings;

  void fields(Fields& f) {
    static constexpr const char* kRules[] = {"chain"};
    f.per_joint("frequency", frequency, {"Hz", 0, 20, "Own frequency of the oscillator."});
    f.per_joint("amplitude", amplitude, {"rad", 0, 3.2, "Peak of the set point about its offset."});
    f.per_joint("offset", offset, {"rad", -3.2, 3.2, "Mean of the set point."});
    f.per_joint("phase_lag", phase_lag, {"rad", -100, 100, "Lead of each joint over its predecessor (rule chain)."});
    f.rule_or_list("couplings", rule, kRules, couplings, "chain: each joint follows the one numbered before it; or a list.");
  }

  /// Throws std::invalid_argument for a joint that would hold a set point outside its range. One that only passes there is
  /// reported by the run, not refused.
  void check(const RobotInfo& robot) const {
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const JointInfo& joint = robot.joints[j];
      if (amplitude[j] != 0 || (offset[j] >= joint.lo && offset[j] <= joint.hi)) continue;
      throw std::invalid_argument("joint " + joint.name + " would hold its offset, outside its range (amplitude 0)");
    }
  }

  /// The coupling graph; the rule's couplings get `weight`.
  [[nodiscard]] std::vector<Coupling> graph(std::size_t joints, double weight) const {
    if (rule < 0) return couplings;
    std::vector<Coupling> chain;
    for (std::size_t i = 1; i < joints; ++i) {
      chain.push_back({static_cast<std::int64_t>(i) - 1, static_cast<std::int64_t>(i), weight, phase_lag[i]});
    }
    return chain;
  }
};

/// Phases on the limit cycle: sums of lags along the couplings from the lowest joint of each connected part (phase 0).
/// Empty where couplings contradict one another around a cycle: no phases keep all lags.
inline std::vector<double> phases_of(const std::vector<Coupling>& graph, std::size_t joints) {
  std::vector<double> phase(joints, 0.0);
  std::vector<bool> known(joints, false);
  for (std::size_t root = 0; root < joints; ++root) {
    if (known[root]) continue;
    known[root] = true;
    for (bool grown = true; grown;) {
      grown = false;
      for (const Coupling& c : graph) {
        const auto from = static_cast<std::size_t>(c.from);
        const auto to = static_cast<std::size_t>(c.to);
        if (known[from] == known[to]) continue;
        if (known[from]) {
          phase[to] = phase[from] + c.phase_lag;
        } else {
          phase[from] = phase[to] - c.phase_lag;
        }
        known[from] = known[to] = grown = true;
      }
    }
  }
  for (const Coupling& c : graph) {
    const double miss = phase[static_cast<std::size_t>(c.to)] - phase[static_cast<std::size_t>(c.from)] - c.phase_lag;
    if (std::abs(std::remainder(miss, 2 * std::numbers::pi)) > 1e-9) return {};
  }
  return phase;
}

}  // namespace gaitlab
