// Rules that end a hopeless run early.
#pragma once
#include <string>
#include <vector>

#include "studies/study/scorer.h"

namespace gaitlab::studies {

/// The stop rules of a study, as in `stop: [fell, "saturated.voltage > 0.3 after 4"]`.
class StopRules {
 public:
  /// Adds a problem at its place for each faulty expression, and for each quantity that is not known during a run.
  StopRules(const Study& study, const QuantityOffer& offer, const std::vector<std::string>& joints, Problems& problems);

  [[nodiscard]] bool empty() const { return rules_.empty(); }
  /// Reason `stopped by RULE at t = 4 s` for the first rule that is true in `so_far`, the recording from Simulation::watch. ""
  /// if no rule is true.
  [[nodiscard]] std::string reason(const Scenario& scenario, const Recording& so_far) const;
  /// Texts of all rules.
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  struct Rule {
    std::string text;
    double after;
    Formula when;
  };
  std::vector<Rule> rules_;
  std::vector<std::pair<std::string, std::string>> quantities_;  ///< name and joint, by their index in the formulas
  QuantityOffer offer_;
};

}  // namespace gaitlab::studies
