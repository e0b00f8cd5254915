// Rules that end hopeless runs early.
#pragma once
#include <string>
#include <vector>

#include "studies/study/judge.h"

namespace gaitlab::studies {

/// The rules of a study, written as `stop: [fell, "saturated.voltage > 0.3 after 4"]`.
class StopRules {
 public:
  /// Faults of expressions, and quantities that are not known during a run, are problems at their places.
  StopRules(const Study& study, const QuantityOffer& offer, const std::vector<std::string>& joints, Problems& problems);

  [[nodiscard]] bool empty() const { return rules_.empty(); }
  /// `stopped by RULE at t = 4 s` for the first rule that is true in the recording so far (Simulation::watch); "": none is.
  [[nodiscard]] std::string reason(const Scenario& scenario, const Recording& so_far) const;
  /// Texts of the rules.
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  struct Rule {
    std::string text;
    double after;
    Formula when;
  };
  std::vector<Rule> rules_;
  std::vector<std::pair<std::string, std::string>> quantities_;  ///< names and joints, by their index in the formulas
  QuantityOffer offer_;
};

}  // namespace gaitlab::studies
