// Rules that end a run early.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/study/scorer.h"

namespace gaitlab::studies {

/// The stop rules of a study, as in `stop: [hopeless, fell, "saturated.voltage > 0.3 after 4"]`.
class StopRules {
 public:
  /// Adds a problem at its place for each faulty expression, and for each quantity that is not known during a run. A hopeless
  /// run has lost one of `guards`.
  StopRules(const Study& study, const QuantityOffer& offer, const std::vector<std::string>& joints,
            std::span<const MarginGuard> guards, Problems& problems);

  [[nodiscard]] bool empty() const { return rules_.empty(); }
  /// Reason `stopped by RULE at t = 4 s` for the first rule that is true in `so_far`, the recording from Simulation::watch;
  /// `hopeless` adds the lost check. "" if no rule is true. If `whole` is true, a hopeless run continues.
  [[nodiscard]] std::string reason(const Scenario& scenario, const Recording& so_far, bool whole = false) const;
  /// Texts of all rules.
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  struct Rule {
    std::string text;
    double after;
    std::optional<Formula> when;  ///< nothing for `hopeless`
  };
  std::vector<Rule> rules_;
  std::vector<std::pair<std::string, std::string>> quantities_;  ///< name and joint, by their index in the formulas
  std::vector<MarginGuard> guards_;
  QuantityOffer offer_;
};

}  // namespace gaitlab::studies
