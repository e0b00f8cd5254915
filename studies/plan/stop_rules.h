// Rules that end hopeless runs early.
#pragma once
#include <string>
#include <vector>

#include "studies/study/judge.h"

namespace gaitlab::studies {

/// The rules of a study, as `stop: [fell, "saturated.voltage > 0.3 after 4"]` says them.
class StopRules {
 public:
  /// Faults of expressions, and quantities that are not known while a run goes on, are problems at their places.
  StopRules(const Study& study, const QuantityOffer& offer, const std::vector<std::string>& joints, Problems& problems);

  [[nodiscard]] bool empty() const { return rules_.empty(); }
  /// `stopped by RULE at t = 4 s`, of the first rule that holds of what is recorded so far (Simulation::watch); "": none does.
  [[nodiscard]] std::string reason(const Scenario& scenario, const Recording& so_far) const;
  /// As the study says them.
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  struct Rule {
    std::string text;
    double after;
    Formula when;
  };
  std::vector<Rule> rules_;
  std::vector<std::pair<std::string, std::string>> quantities_;  ///< names and joints, by their number in the formulas
  QuantityOffer offer_;
};

}  // namespace gaitlab::studies
