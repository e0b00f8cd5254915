// Common keys of all oscillator CPGs, and the network of oscillators. Standard library only.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "core/plugin/couplings.h"
#include "core/plugin/cpg.h"

namespace gaitlab {

/// The common keys: frequency, amplitude, offset, phase_lag, couplings.
struct OscillatorKeys {
  PerJoint frequency{0.25}, amplitude{0.6}, offset{0}, phase_lag{1.2};
  std::optional<CouplingRule> rule = CouplingRule::chain;  ///< empty if the list `couplings` applies
  std::vector<Coupling> couplings;

  void fields(Fields& f) {
    f.per_joint("frequency", frequency, {"Hz", 0, 20, "Frequency of the uncoupled oscillator."});
    f.per_joint("amplitude", amplitude,
                {"rad", 0, 1000, "Peak of the set point about its offset; up to 3.2 for a hinge with a range."});
    f.per_joint("offset", offset, {"rad", -1000, 1000, "Mean of the set point; within +-3.2 for a hinge with a range."});
    f.per_joint(
        "phase_lag", phase_lag,
        {"rad", -100, 100,
         "Lead of each joint over the joint that it follows by the rule of the couplings; joints of amplitude 0 are followed, "
         "too."});
    f.rule_or_list("couplings", rule, kCouplingRules, couplings, kCouplingRulesAbout);
  }

  /// Throws SettingError if the set point of a joint is outside its range at all times, or if amplitude or offset of a hinge
  /// with a range is beyond 3.2 rad. A set point that leaves the range only temporarily is allowed; the run reports it.
  void check(const RobotInfo& robot) const {
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const JointInfo& joint = robot.joints[j];
      if (!joint.driven) continue;
      check_angle(joint, "amplitude", amplitude[j]);
      check_angle(joint, "offset", offset[j]);
      if (amplitude[j] != 0 || (offset[j] >= joint.lo && offset[j] <= joint.hi)) continue;
      throw SettingError("offset", "joint " + joint.name + " would hold its offset, outside its range (amplitude 0)");
    }
  }

  /// The coupling graph. The couplings of a rule have the weight `weight`.
  [[nodiscard]] std::vector<Coupling> graph(const RobotInfo& robot, double weight) const {
    return rule ? couple(robot, *rule, weight, phase_lag) : couplings;
  }
};

/// Settings of an oscillator CPG: the common keys, and under `model` the keys of one model. Model is a struct with `void
/// fields(Fields&)`.
template <class Model>
struct OscillatorSettings : OscillatorKeys {
  Model model;

  void fields(Fields& f) {
    OscillatorKeys::fields(f);
    f.group("model", model, "Keys of this model.");
  }
};

/// Couplings and the phases of their limit cycle, for oscillators that start on this cycle.
struct OscillatorNetwork {
  std::vector<Coupling> couplings;
  std::vector<double> phases;  ///< rad; all 0 if the lags contradict one another around a cycle
  bool consistent = true;

  /// Throws std::invalid_argument under the conditions of OscillatorKeys::check.
  OscillatorNetwork(const RobotInfo& robot, const OscillatorKeys& keys, double weight)
      : couplings(keys.graph(robot, weight)), phases(phases_of(couplings, robot.joints.size())) {
    keys.check(robot);
    consistent = phases.size() == robot.joints.size();
    if (!consistent) phases.assign(robot.joints.size(), 0.0);
  }

  [[nodiscard]] std::string note() const {
    return consistent ? "" : "the couplings' lags contradict one another around a cycle: all phases start at 0";
  }
};

/// Time in which r' = rate (R - r) takes r from 0 to 98 % of R, s; 0 if `rate` is 0, because r is then constant.
inline double rise_time(double rate) {
  constexpr double kFirstOrder = 3.912;  // ln 50
  return rate > 0 ? kFirstOrder / rate : 0;
}

/// A CPG with one oscillator per joint. Its states are blocks of one number per joint. A derived class defines start(),
/// derivative() and output(). The couplings of a rule have the weight `coupling` of the model.
template <class Model>
requires requires(Model model) { model.coupling + 1.0; }
class OscillatorCpg : public Cpg {
 public:
  using Settings = OscillatorSettings<Model>;

  [[nodiscard]] std::size_t states() const override { return blocks_.size() * joints_; }
  [[nodiscard]] std::string state_name(std::size_t index) const override {
    return blocks_[index / joints_] + ("." + std::to_string(index % joints_));
  }
  [[nodiscard]] std::string note() const override { return network_.note(); }

 protected:
  /// `blocks` are the names of the states, whose addresses are kept. Throws std::invalid_argument as OscillatorKeys::check.
  OscillatorCpg(const RobotInfo& robot, const Settings& settings, std::span<const char* const> blocks)
      : joints_(robot.joints.size()), s_(settings), network_(robot, settings, settings.model.coupling), blocks_(blocks) {}

  std::size_t joints_;
  Settings s_;
  OscillatorNetwork network_;

 private:
  std::span<const char* const> blocks_;
};

}  // namespace gaitlab
