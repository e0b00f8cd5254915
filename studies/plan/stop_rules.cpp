#include "studies/plan/stop_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/settings/wording.h"

namespace gaitlab::studies {

StopRules::StopRules(const Study& study, const QuantityOffer& offer, const std::vector<std::string>& joints,
                     std::span<const MarginGuard> guards, Problems& problems)
    : guards_(guards.begin(), guards.end()), offer_(offer) {
  const auto is_of = [](const std::vector<Quantity>& quantities, const std::string& name) {
    return std::ranges::find(quantities, name, &Quantity::name) != quantities.end();
  };
  const Names names = [&](const std::string& name, const std::string& joint) -> Naming {
    const bool of_joint = !joint.empty();
    if (!is_of(of_joint ? offer.of_joints : offer.common, name))
      return {{}, "unknown quantity " + in_quotes(name) + gaitlab::offer(name, offer.so_far, "quantities")};
    if (of_joint && std::ranges::find(joints, joint) == joints.end())
      return {{}, "no joint is called " + in_quotes(joint) + gaitlab::offer(joint, joints, "joints")};
    if (std::ranges::find(offer.so_far, name) == offer.so_far.end()) {
      return {
          {},
          fmt::format("{} is known only after a run has ended; a stop rule can use {}", name, fmt::join(offer.so_far, ", "))};
    }
    const std::pair quantity{name, joint};
    const auto at = std::ranges::find(quantities_, quantity);
    const auto number = static_cast<std::size_t>(at - quantities_.begin());
    if (at == quantities_.end()) quantities_.push_back(quantity);
    return {number};
  };
  for (const StopText& stop : study.stops) {
    std::optional<Formula> when;
    if (stop.when.text != kHopeless) when.emplace(stop.when, names, problems);
    rules_.push_back({stop.when.text + (stop.after > 0 ? fmt::format(" after {}", number_text(stop.after)) : ""), stop.after,
                      std::move(when)});
  }
}

std::string StopRules::reason(const Scenario& scenario, const Recording& so_far, bool whole) const {
  constexpr double kSlack = 1e-9;  // s: the time is a number of steps times the step, which may round below a whole second
  std::vector<double> values;
  for (const Rule& rule : rules_) {
    if (so_far.simulated < rule.after - kSlack) continue;
    const auto text = [&] { return fmt::format("stopped by {} at t = {:.6g} s", rule.text, so_far.simulated); };
    if (!rule.when) {
      const Cause lost = whole || guards_.empty() ? Cause() : offer_.lost_so_far(guards_, scenario, so_far);
      if (!lost.check.empty()) return text() + ": " + lost.text();
      continue;
    }
    if (values.empty()) {
      for (const auto& [name, joint] : quantities_) values.push_back(offer_.value_so_far(name, joint, scenario, so_far));
    }
    const double holds = rule.when->value(values);
    if (std::isfinite(holds) && holds != 0) return text();
  }
  return "";
}

std::vector<std::string> StopRules::texts() const {
  std::vector<std::string> all;
  for (const Rule& rule : rules_) all.push_back(rule.text);
  return all;
}

}  // namespace gaitlab::studies
