#include "studies/plan/plan_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/recording/limit_cycle.h"
#include "core/settings/wording.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

/// Low (or first) values of all parameters; with `high`, high (or last) values.
std::vector<std::string> corner(const Study& study, bool high) {
  std::vector<std::string> values;
  for (const Parameter& p : study.parameters)
    values.push_back(p.values.empty() ? number_text(high ? p.high : p.low) : high ? p.values.back() : p.values.front());
  return values;
}

/// Trial of the listed values of the parameters in one scenario.
class ValueTrial {
 public:
  ValueTrial(const Plan& plan, std::size_t scenario) : plan_(plan), scenario_(scenario) {}

  /// Reason why no run can have this value; nothing if some run can.
  std::optional<Problem> refused(std::size_t parameter, std::size_t value) {
    const Parameter& p = parameters()[parameter];
    why_.reset();
    if (p.sets.empty() && runs({p.key + "=" + p.values[value]})) return {};
    for (const bool high : {false, true}) {
      if (some_combination_runs(parameter, value, high)) return {};
    }
    return why_;
  }

 private:
  [[nodiscard]] const std::vector<Parameter>& parameters() const { return plan_.study().parameters; }

  bool runs(const std::vector<std::string>& sets) {
    try {
      (void)plan_.with(sets, scenario_);
      return true;
    } catch (const InputError& error) {
      const Problem& found = error.problems().front();
      if (!why_ || (!why_->unknown_key.empty() && found.unknown_key.empty())) why_ = found;
      return false;
    }
  }

  bool some_combination_runs(std::size_t parameter, std::size_t value, bool high) {
    std::vector<std::string> values = corner(plan_.study(), high);
    values[parameter] = parameters()[parameter].values[value];
    std::vector<std::size_t> others;
    std::size_t combinations = 1;
    for (std::size_t k = 0; k < parameters().size(); ++k) {
      if (k == parameter || parameters()[k].values.empty()) continue;
      others.push_back(k);
      constexpr std::size_t kMost = 1000;
      combinations *= parameters()[k].values.size();
      if (combinations > kMost) return true;
    }
    for (std::size_t c = 0; c < combinations; ++c) {
      std::size_t rest = c;
      for (const std::size_t k : others) {
        values[k] = parameters()[k].values[rest % parameters()[k].values.size()];
        rest /= parameters()[k].values.size();
      }
      if (runs(plan_.sets(values, scenario_ * plan_.points().replicates()))) return true;
    }
    return false;
  }

  const Plan& plan_;
  std::size_t scenario_;
  std::optional<Problem> why_;  ///< the first problem other than an unknown key, or else the first one
};

void check_corner(const Plan& plan, std::size_t scenario, Problems& problems) {
  const std::uint64_t first_run = scenario * plan.points().replicates();
  const std::uint64_t last_run =
      plan.points().runs() - 1 - (plan.scenarios().size() - 1 - scenario) * plan.points().replicates();
  std::optional<InputError> first;
  for (const bool last : {false, true}) {
    try {
      (void)plan.with(is_search(plan.study().method) ? plan.sets(corner(plan.study(), last), first_run)
                                                     : plan.sets(last ? last_run : first_run),
                      scenario);
      return;
    } catch (const InputError& error) {
      if (!first) first = error;
    }
  }
  add_as_written(*first, plan.study(), problems);
}

Problems wrong_corners(const Plan& plan) {
  Problems problems;
  std::vector<Problems> refused(plan.scenarios().size());
  for (std::size_t s = 0; s < refused.size(); ++s) check_corner(plan, s, refused[s]);
  add_of_each(plan.scenarios(), refused, problems);
  return problems;
}

Problems wrong_values(const Plan& plan) {
  Problems problems;
  const std::vector<Parameter>& parameters = plan.study().parameters;
  std::vector<Problems> refused(plan.scenarios().size());
  for (std::size_t s = 0; s < refused.size(); ++s) {
    ValueTrial trial(plan, s);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      for (std::size_t v = 0; v < parameters[k].values.size(); ++v) {
        const std::optional<Problem> why = trial.refused(k, v);
        if (why && why->unknown_key.empty()) {  // check_corner() reports unknown keys at their places
          const std::vector<SourceLocation>& places = parameters[k].value_places;
          refused[s].add(v < places.size() ? places[v] : parameters[k].place, why->text);
        }
      }
    }
  }
  add_of_each(plan.scenarios(), refused, problems);
  return problems;
}

}  // namespace

void Plan::check_settings(Problems& problems) const {
  Problems found = wrong_values(*this);
  if (found.empty()) found = wrong_corners(*this);
  const std::vector<Problem> before = problems.list();
  for (const Problem& one : found.list()) {
    const auto same = [&](const Problem& other) { return to_string(other.place) == to_string(one.place); };
    if (std::ranges::none_of(before, same)) problems.add(one.place, one.text).notes = one.notes;
  }
}

std::vector<Problem> refused_ends(const Plan& plan) {
  std::vector<Problem> notes;
  for (const Parameter& p : plan.study().parameters) {
    if (!p.values.empty() || !p.sets.empty()) continue;
    for (const bool high : {false, true}) {
      const std::string value = number_text(high ? p.high : p.low);
      for (std::size_t s = 0; s < plan.scenarios().size(); ++s) {
        try {
          (void)plan.with({p.key + "=" + value}, s);
        } catch (const InputError& error) {
          const std::string in = plan.scenarios()[s].name.empty() ? "" : " in scenario " + plan.scenarios()[s].name;
          notes.push_back({p.place, fmt::format("{} is refused{} at its {} of {}, with the other keys as in the file: {}",
                                                p.key, in, high ? "high" : "low", value, error.problems().front().text)});
        }
      }
    }
  }
  return notes;
}

std::vector<Problem> short_runs(const Plan& plan) {
  std::vector<Problem> notes;
  for (const Parameter& p : plan.study().parameters) {
    if (!p.sets.empty() || p.words || !p.key.starts_with("cpg.") || p.key.find("frequency") == std::string::npos) continue;
    double least = p.low;  // Hz
    for (const std::string& value : p.values)
      least = &value == &p.values.front() ? number_of(value) : std::min(least, number_of(value));
    double shortest = plan.longest();
    for (const StudyScenario& one : plan.scenarios()) shortest = std::min(shortest, one.nominal.duration);
    constexpr double kRounding = 1 - 1e-9;
    if (!(least > 0) || shortest * least >= kPeriodsNeeded * kRounding) continue;
    notes.push_back(
        {p.place, fmt::format("a gait of {} Hz has {:.2g} periods in {} s; without a limit cycle a verdict needs {:g}: "
                              "take duration={:.4g}, or `low: {:.3g}`",
                              number_text(least), shortest * least, number_text(shortest), kPeriodsNeeded,
                              kPeriodsNeeded / least, kPeriodsNeeded / shortest)});
  }
  return notes;
}

}  // namespace gaitlab::studies
