#include "studies/study/scorer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/model/pattern.h"
#include "core/settings/wording.h"

namespace gaitlab::studies {

std::string Cause::text() const {
  std::string words = check;
  std::ranges::replace(words, '_', ' ');
  return part.empty() ? words : words + " of " + part;
}

namespace {

std::string full(const std::string& name, const std::string& joint) { return joint.empty() ? name : name + "[" + joint + "]"; }

std::size_t column_of(const std::vector<Quantity>& columns, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(columns, name, &Quantity::name) - columns.begin());
}

std::vector<std::string> names_of(const std::vector<Quantity>& quantities) {
  std::vector<std::string> names;
  names.reserve(quantities.size());
  for (const Quantity& quantity : quantities) names.push_back(quantity.name);
  return names;
}

}  // namespace

double broken(double value, double limit, bool least) {
  if (std::isnan(value) || std::isnan(limit)) return 1;
  const double beyond = std::max(0.0, least ? limit - value : value - limit);
  return limit == 0 ? beyond : beyond / std::abs(limit);
}

double broken(const Formula& relation, std::span<const double> quantities, bool guard) {
  const double a = relation.operand(0, quantities);
  const double b = relation.operand(1, quantities);
  if (guard && std::isnan(a)) return 0;
  const double above = relation.compares(">=") ? 0 : broken(a, b, false);
  const double below = relation.compares("<=") ? 0 : broken(a, b, true);
  return std::max(above, below);
}

std::vector<Quantity> columns_of(const Study& study, const QuantityOffer& offer, const std::vector<std::string>& joints) {
  std::vector<Quantity> columns = offer.common;
  const auto add = [&](const Quantity& quantity, const std::string& joint) {
    const std::string name = full(quantity.name, joint);
    if (column_of(columns, name) == columns.size()) columns.push_back({name, quantity.unit, "This joint. " + quantity.meaning});
  };
  const auto add_named = [&](const FormulaText& text) {
    for (const auto& [name, joint] : named_joints(text.text)) {
      const std::size_t at = column_of(offer.of_joints, name);
      if (at < offer.of_joints.size() && std::ranges::find(joints, joint) != joints.end()) add(offer.of_joints[at], joint);
    }
  };
  for (const Objective& objective : study.objectives) add_named(objective.expression);
  for (const FormulaText& text : study.constraints) add_named(text);
  for (const Guard& guard : study.guards) {
    const auto check = std::ranges::find(offer.checks, guard.check, &CheckOffer::id);
    if (guard.asks == Guard::Asks::limit && check != offer.checks.end() && check->limited) {
      columns.push_back(
          {margin_column(guard), "",
           fmt::format("Margin of check {} against the limit {} of the study.", guard.check, number_text(guard.number))});
    }
  }
  for (const std::string& pattern : study.quantities) {
    if (pattern.find('[') == std::string::npos) continue;
    for (const Quantity& quantity : offer.of_joints) {
      for (const std::string& joint : joints) {
        if (glob(pattern, full(quantity.name, joint))) add(quantity, joint);
      }
    }
  }
  return columns;
}

Scorer::Scorer(const Study& study, const std::vector<Quantity>& columns, const QuantityOffer& offer,
               const std::vector<std::string>& joints, Problems& problems)
    : columns_(columns), offer_(offer), joints_(joints) {
  const Names names = [this](const std::string& name, const std::string& joint) { return find(name, joint); };
  for (const Objective& objective : study.objectives) {
    objectives_.emplace_back(objective.expression, names, problems);
    objective_texts_.push_back(objective.expression.text);
  }
  for (const FormulaText& text : study.constraints) {
    const std::size_t before = problems.size();
    Formula formula(text, names, problems);
    const bool relation = formula.compares("<=") || formula.compares(">=") || formula.compares("==");
    if (problems.size() == before && !relation)
      problems.add(text.node.place, in_quotes(text.text) + " is not a constraint; expected a <= b, a >= b or a == b");
    constraints_.push_back(std::move(formula));
    constraint_texts_.push_back(text.text);
  }
  const auto of_cost = [](const Formula& f) { return f.names("cost_of_transport.electrical"); };
  guards_ = Guards(study, names_of(columns_), offer.checks, std::ranges::any_of(objectives_, of_cost), problems);
}

Naming Scorer::find(const std::string& name, const std::string& joint) const {
  const std::size_t column = column_of(columns_, full(name, joint));
  if (column < columns_.size()) return {column};
  const std::vector<std::string> of_joints = names_of(offer_.of_joints);
  if (!joint.empty() && std::ranges::find(of_joints, name) != of_joints.end())
    return {{}, "no joint is called " + in_quotes(joint) + offer(joint, joints_, "joints")};
  if (!joint.empty() && column_of(columns_, name) < columns_.size())
    return {{}, in_quotes(name) + " applies to the whole robot; expected it without [" + clipped(joint) + "]"};
  return {
      {},
      "unknown quantity " + in_quotes(name) + offer(name, joint.empty() ? names_of(offer_.common) : of_joints, "quantities")};
}

std::vector<Limit> Scorer::limits() const {
  std::vector<Limit> all;
  for (const std::string& text : constraint_texts_) all.push_back({text});
  for (std::string& text : guards_.texts()) all.push_back({std::move(text), true});
  return all;
}

std::vector<std::string> Scorer::broken(std::span<const double> quantities, Word verdict, const std::string& why,
                                        bool reserve) const {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < objectives_.size(); ++k) {
    if (!std::isfinite(objectives_[k].value(quantities))) all.push_back(objective_texts_[k] + " is not known");
  }
  for (std::size_t k = 0; k < constraints_.size(); ++k) {
    if (studies::broken(constraints_[k], quantities) > 0)
      all.push_back(fmt::format("{} ({:.4g})", constraint_texts_[k], constraints_[k].operand(0, quantities)));
  }
  for (std::string& text : guards_.broken(quantities, verdict, why, reserve)) all.push_back(std::move(text));
  return all;
}

Score Scorer::score(std::span<const double> quantities, Word verdict, bool reserve) const {
  Score score;
  for (std::size_t k = 0; k < objectives_.size(); ++k) {
    score.objectives[k] = objectives_[k].value(quantities);
    if (!std::isfinite(score.objectives[k])) score.violation += 1;
  }
  for (const Formula& constraint : constraints_) score.violation += limited_violation(studies::broken(constraint, quantities));
  score.violation += guards_.violation(quantities, verdict, reserve);
  return score;
}

}  // namespace gaitlab::studies
