#include "studies/study/guards.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab::studies {

namespace {

/// Old name of a guard, from versions in which guards were quantities instead of checks.
struct OldGuard {
  const char *name, *check;
  enum class Means { limit, at_most_a_flag, at_least_a_flag, nothing_new, other } means;
  const char* remedy = "";
};

constexpr std::array kOldGuards{
    OldGuard{"judged.saturated.voltage", "voltage", OldGuard::Means::limit},
    OldGuard{"judged.saturated.current", "current", OldGuard::Means::limit},
    OldGuard{"range.setpoint_share", "setpoints", OldGuard::Means::limit},
    OldGuard{"judged.tracking_error.peak", "tracking", OldGuard::Means::limit},
    OldGuard{"airborne_share", "airborne", OldGuard::Means::limit},
    OldGuard{"energy.residual_share", "ledger", OldGuard::Means::limit},
    OldGuard{"energy.created_share", "created", OldGuard::Means::limit},
    OldGuard{"fell", "fall", OldGuard::Means::at_most_a_flag},
    OldGuard{"limit_cycle.found", "periodic", OldGuard::Means::at_least_a_flag},
    OldGuard{"verdict_excess", "", OldGuard::Means::nothing_new, "guards: {{ID: {{margin: -0.1}}}} for a check that may fail"},
    OldGuard{"range.share", "stops", OldGuard::Means::other,
             "set: [limits.beyond_range_share={}], or guards: {{stops: ANGLE}} with an angle in rad"},
};

const OldGuard* old_guard(const std::string& name) {
  const auto found = std::ranges::find_if(kOldGuards, [&](const OldGuard& old) { return name == old.name; });
  return found == kOldGuards.end() ? nullptr : &*found;
}

/// Text of a guard, such as `stops: 0.1` or `stops: {margin: 0.1}`.
std::string guard_text(const Guard& guard) {
  switch (guard.asks) {
    case Guard::Asks::limit:
      return guard.check + ": " + number_text(guard.number);
    case Guard::Asks::margin:
      return guard.check + ": {margin: " + number_text(guard.number) + "}";
    case Guard::Asks::kept:
      return guard.check + ": true";
    case Guard::Asks::nothing:
      break;
  }
  return guard.check + ": false";
}

void add_old(const OldGuard& old, double number, const SourceLocation& place, Study& study, Problems& problems) {
  using Means = OldGuard::Means;
  if (old.means == Means::other || (old.means == Means::nothing_new && number != 0)) {
    problems.add(place, fmt::format("{}: {} is an old guard without a check of the same meaning; write {}", old.name,
                                    number_text(number), fmt::format(fmt::runtime(old.remedy), number_text(number))));
    return;
  }
  if (old.means == Means::nothing_new) {
    study.notes.push_back(
        {place, fmt::format("{} is the old name of the verdict, which is a guard by default; leave it out", old.name)});
    return;
  }
  Guard guard{old.check, Guard::Asks::limit, number, place};
  const bool dropped = old.means == Means::at_most_a_flag ? number >= 1 : number <= 0;
  if (old.means != Means::limit) guard.asks = dropped ? Guard::Asks::nothing : Guard::Asks::kept;
  study.notes.push_back({place, fmt::format("{} is an old name; write guards: {{{}}}", old.name, guard_text(guard))});
  study.guards.push_back(std::move(guard));
}

void read_guard(const std::string& name, const SourceLocation& place, const Node& node, Study& study, Problems& problems) {
  Guard guard{name, Guard::Asks::kept, 0, place};
  if (node.kind == Node::Kind::scalar && (node.text == "true" || node.text == "false")) {
    if (node.text == "false") guard.asks = Guard::Asks::nothing;
    study.guards.push_back(std::move(guard));
    return;
  }
  const bool map = node.kind == Node::Kind::map;
  const Node* margin = map && node.keys.size() == 1 ? node.find("margin") : nullptr;
  const Node& number = margin == nullptr ? node : *margin;
  const Reading<double> read = map && margin == nullptr ? Reading<double>{0, "is " + found(node)} : read_number(number, "");
  if (!read.ok()) {
    problems.add(number.place, fmt::format("guards.{} {}; expected a limit, {{margin: NUMBER}}, true or false", clipped(name),
                                           read.wrong.substr(0, read.wrong.find(';'))));
  } else if (const OldGuard* old = old_guard(name); old != nullptr && margin == nullptr) {
    add_old(*old, read.value, place, study, problems);
  } else {
    guard.asks = margin != nullptr ? Guard::Asks::margin : Guard::Asks::limit;
    guard.number = read.value;
    study.guards.push_back(std::move(guard));
  }
}

}  // namespace

void read_guards(const Node& node, Study& study, Problems& problems) {
  if (node.kind == Node::Kind::scalar && (node.text == "verdict" || node.text == "gait" || node.text == "none")) {
    study.guarded = node.text != "none";
    if (node.text == "gait") study.notes.push_back({node.place, "guards: gait is the old name of guards: verdict"});
    return;
  }
  if (node.kind != Node::Kind::map) {
    problems.add(node.place, "guards is " + found(node) +
                                 "; expected verdict, none, or checks of the verdict: {stops: 0.1, dock_bending: {margin: "
                                 "0.2}, periodic: true, slip: false}");
    return;
  }
  for (std::size_t i = 0; i < node.keys.size(); ++i)
    read_guard(node.keys[i].first, node.keys[i].second, node.items[i], study, problems);
}

std::vector<std::string> old_guards() {
  std::vector<std::string> names;
  for (const OldGuard& old : kOldGuards) {
    if (old.means != OldGuard::Means::other) names.emplace_back(old.name);
  }
  return names;
}

std::string margin_column(const Guard& guard) {
  return "margin." + guard.check + (guard.asks == Guard::Asks::limit ? "[" + number_text(guard.number) + "]" : "");
}

double MarginGuard::broken(std::span<const double> quantities, bool reserve) const {
  const double margin = quantities[column];
  return std::isnan(margin) ? 0 : std::max(0.0, (reserve ? least : std::min(0.0, least)) - margin);
}

Guards::Guards(const Study& study, const std::vector<std::string>& columns, std::span<const CheckOffer> checks, bool of_energy,
               Problems& problems)
    : verdict_(study.guarded) {
  std::vector<std::string> known;
  for (const CheckOffer& check : checks) known.push_back(check.id);
  for (std::size_t k = 0; k < study.guards.size(); ++k) {
    const Guard& given = study.guards[k];
    const auto check = std::ranges::find(checks, given.check, &CheckOffer::id);
    if (check == checks.end()) {
      problems.add(given.place, "unknown check " + in_quotes(given.check) + offer(given.check, known, "checks"));
    } else if (given.asks == Guard::Asks::limit && !check->limited) {
      problems.add(given.place, fmt::format("{} has no limit that a number could replace; expected {{margin: NUMBER}}, true or "
                                            "false",
                                            given.check));
    }
    const auto before = study.guards.begin() + static_cast<std::ptrdiff_t>(k);
    if (std::find_if(study.guards.begin(), before, [&](const Guard& one) { return one.check == given.check; }) != before)
      problems.add(given.place, "check " + in_quotes(given.check) + " is guarded twice, once by an old name");
  }
  if (!verdict_) return;
  const auto add = [&](const std::string& check, const std::string& column, double least, bool of_verdict,
                       std::vector<MarginGuard>& to) {
    const auto at = std::ranges::find(columns, column);
    if (at != columns.end()) to.push_back({check, column, static_cast<std::size_t>(at - columns.begin()), least, of_verdict});
  };
  for (const CheckOffer& check : checks) {
    const std::string own = "margin." + check.id;
    const auto given = std::ranges::find(study.guards, check.id, &Guard::check);
    if (given == study.guards.end()) {
      if (check.can_fail || (of_energy && check.id == "created")) add(check.id, own, 0, check.can_fail, all_);
      continue;
    }
    const bool other = given->asks != Guard::Asks::kept;
    if (check.can_fail && other) add(check.id, own, 0, true, replaced_);
    if (given->asks == Guard::Asks::nothing) continue;
    add(check.id, margin_column(*given), given->asks == Guard::Asks::margin ? given->number : 0, false, all_);
  }
}

bool Guards::made_up_for(std::span<const double> quantities, const std::string& verdict) const {
  const auto fails = [&](const MarginGuard& guard) { return guard.broken(quantities) > 0; };
  const auto fails_of_verdict = [&](const MarginGuard& guard) { return guard.of_verdict && fails(guard); };
  return verdict == "infeasible" && std::ranges::any_of(replaced_, fails) && std::ranges::none_of(all_, fails_of_verdict);
}

double Guards::violation(std::span<const double> quantities, const std::string& verdict, bool reserve) const {
  double sum = 0;
  for (const MarginGuard& guard : all_) {
    if (!guard.of_verdict || verdict != "feasible") sum += limited_violation(guard.broken(quantities, reserve));
  }
  const bool kept = !verdict_ || verdict == "feasible" || made_up_for(quantities, verdict);
  return sum == 0 && !kept ? limited_violation(1) : sum;
}

std::vector<std::string> Guards::broken(std::span<const double> quantities, const std::string& verdict, const std::string& why,
                                        bool reserve) const {
  std::vector<std::string> texts;
  if (verdict_ && verdict != "feasible" && !made_up_for(quantities, verdict))
    texts.push_back(verdict + (why.empty() ? "" : ": " + why));
  for (const MarginGuard& guard : all_) {
    if (!reserve && guard.least > 0 && verdict_ && verdict != "feasible") continue;  // the verdict states the same
    if (!guard.of_verdict && guard.broken(quantities, reserve) > 0) {
      texts.push_back(fmt::format("check {} has a margin of {:.4g}; the study requires {}", guard.check,
                                  quantities[guard.column], number_text(reserve ? guard.least : std::min(0.0, guard.least))));
    }
  }
  return texts;
}

std::vector<std::string> Guards::texts() const {
  std::vector<std::string> texts;
  std::vector<std::string> others;
  for (const MarginGuard& guard : replaced_) others.push_back(guard.check);
  if (verdict_) texts.push_back(others.empty() ? "feasible >= 1" : fmt::format("verdict but for {}", fmt::join(others, ", ")));
  for (const MarginGuard& guard : all_) texts.push_back(guard.name + " >= " + number_text(guard.least));
  return texts;
}

}  // namespace gaitlab::studies
