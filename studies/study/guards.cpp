#include "studies/study/guards.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab::studies {

namespace {

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
  } else {
    guard.asks = margin != nullptr ? Guard::Asks::margin : Guard::Asks::limit;
    guard.number = read.value;
    study.guards.push_back(std::move(guard));
  }
}

}  // namespace

void read_guards(const Node& node, Study& study, Problems& problems) {
  if (node.kind == Node::Kind::scalar && (node.text == "verdict" || node.text == "none")) {
    study.guarded = node.text != "none";
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
  for (const Guard& given : study.guards) {
    const auto check = std::ranges::find(checks, given.check, &CheckOffer::id);
    if (check == checks.end()) {
      problems.add(given.place, "unknown check " + in_quotes(given.check) + offer(given.check, known, "checks"));
    } else if (given.asks == Guard::Asks::limit && !check->limited) {
      problems.add(given.place, fmt::format("{} has no limit that a number could replace; expected {{margin: NUMBER}}, true or "
                                            "false",
                                            given.check));
    }
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

bool Guards::made_up_for(std::span<const double> quantities, Word verdict) const {
  const auto fails = [&](const MarginGuard& guard) { return guard.broken(quantities) > 0; };
  const auto fails_of_verdict = [&](const MarginGuard& guard) { return guard.of_verdict && fails(guard); };
  return verdict == Word::infeasible && std::ranges::any_of(replaced_, fails) && std::ranges::none_of(all_, fails_of_verdict);
}

double Guards::violation(std::span<const double> quantities, Word verdict, bool reserve) const {
  double sum = 0;
  for (const MarginGuard& guard : all_) {
    if (!guard.of_verdict || verdict != Word::feasible) sum += limited_violation(guard.broken(quantities, reserve));
  }
  const bool kept = !verdict_ || verdict == Word::feasible || made_up_for(quantities, verdict);
  return sum == 0 && !kept ? limited_violation(1) : sum;
}

std::vector<std::string> Guards::broken(std::span<const double> quantities, Word verdict, const std::string& why,
                                        bool reserve) const {
  std::vector<std::string> texts;
  if (verdict_ && verdict != Word::feasible && !made_up_for(quantities, verdict))
    texts.push_back(name_of(verdict) + (why.empty() ? std::string() : ": " + why));
  for (const MarginGuard& guard : all_) {
    if (!reserve && guard.least > 0 && verdict_ && verdict != Word::feasible) continue;  // the verdict states the same
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
