// What a plan refuses, or remarks on, before its first run.
#include <fmt/format.h>

#include <algorithm>

#include "core/settings/wording.h"
#include "studies/plan/plan.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

/// All parameters at their low, or first, or at their high, or last.
std::vector<std::string> corner(const Study& study, bool high) {
  std::vector<std::string> values;
  for (const Parameter& p : study.parameters)
    values.push_back(p.values.empty() ? number_text(high ? p.high : p.low) : high ? p.values.back() : p.values.front());
  return values;
}

}  // namespace

/// A number of one's own that is called like a key of the scenario would be taken for it.
void Plan::check_own_names(std::size_t scenario, Problems& problems) const {
  for (const Parameter& p : study_.parameters) {
    if (p.sets.empty()) continue;
    const std::string unknown = "unknown key " + in_quotes(p.key);
    bool is_key = true;
    try {
      (void)with({p.key + "=0"}, scenario);
    } catch (const InputError& error) {
      is_key = std::ranges::none_of(error.problems(), [&](const Problem& one) { return one.text.starts_with(unknown); });
    }
    if (is_key)
      problems.add(
          p.place,
          fmt::format("{} is a key of the scenario, and has keys that follow it (sets); expected another name", p.key));
  }
}

/// A rule that begins when every run has ended stops none.
void Plan::check_stops(Problems& problems) const {
  const auto is_duration = [](const std::string& key) { return key == "duration"; };
  for (const Parameter& p : study_.parameters) {
    if (is_duration(p.key) || std::ranges::any_of(p.sets, is_duration, &Follower::key)) return;
  }
  if (std::ranges::any_of(study_.replicates.vary, is_duration, &Variation::key)) return;
  for (const StopText& stop : study_.stops) {
    if (stop.after < longest()) continue;
    problems.add(stop.when.node.place,
                 fmt::format("the rule begins at {} s, and the {} ends at {} s; expected an earlier time behind `after`",
                             number_text(stop.after), scenarios_.size() > 1 ? "longest run" : "run", number_text(longest())));
  }
}

/// The first and the last run are tried: what both refuse no run can have, a misspelt key above all.
void Plan::check_corners(std::size_t scenario, Problems& problems) const {
  const std::uint64_t first_run = scenario * points_.replicates();
  const std::uint64_t last_run = points_.runs() - 1 - (scenarios_.size() - 1 - scenario) * points_.replicates();
  std::optional<InputError> first;
  for (const bool last : {false, true}) {
    try {
      (void)with(is_search(study_.method) ? sets(corner(study_, last), first_run) : sets(last ? last_run : first_run),
                 scenario);
      return;
    } catch (const InputError& error) {
      if (!first) first = error;
    }
  }
  add_as_written(*first, study_, problems);
}

std::vector<Problem> Plan::refused_ends() const {
  std::vector<Problem> notes;
  for (const Parameter& p : study_.parameters) {
    if (!p.values.empty() || !p.sets.empty()) continue;
    for (const bool high : {false, true}) {
      const std::string value = number_text(high ? p.high : p.low);
      for (std::size_t s = 0; s < scenarios_.size(); ++s) {
        try {
          (void)with({p.key + "=" + value}, s);
        } catch (const InputError& error) {
          const std::string in = scenarios_[s].name.empty() ? "" : " in scenario " + scenarios_[s].name;
          notes.push_back({p.place, fmt::format("{} is refused{} at its {} of {}, with the other keys as in the file: {}",
                                                p.key, in, high ? "high" : "low", value, error.problems().front().text)});
        }
      }
    }
  }
  return notes;
}

std::vector<Problem> Plan::short_runs() const {
  constexpr double kPeriods = 3;  // as report/verdict/evidence.h
  std::vector<Problem> notes;
  for (const Parameter& p : study_.parameters) {
    if (!p.sets.empty() || p.words || !p.key.starts_with("cpg.") || p.key.find("frequency") == std::string::npos) continue;
    double least = p.low;  // Hz
    for (const std::string& value : p.values)
      least = &value == &p.values.front() ? number_of(value) : std::min(least, number_of(value));
    double shortest = longest();
    for (const StudyScenario& one : scenarios_) shortest = std::min(shortest, one.nominal.duration);
    constexpr double kRounding = 1 - 1e-9;
    if (!(least > 0) || shortest * least >= kPeriods * kRounding) continue;
    notes.push_back(
        {p.place, fmt::format("a gait of {} Hz has {:.2g} periods in {} s; without a limit cycle a verdict needs {:g}: "
                              "take duration={:.4g}, or a low of {:.3g}",
                              number_text(least), shortest * least, number_text(shortest), kPeriods, kPeriods / least,
                              kPeriods / shortest)});
  }
  return notes;
}

}  // namespace gaitlab::studies
