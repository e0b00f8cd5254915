#include "studies/study/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/model/pattern.h"
#include "core/settings/wording.h"

namespace gaitlab::studies {

namespace {

constexpr double kTrackingFails = 2;  // times limits.tracking_error, where the verdict says no

constexpr Guard kGuards[] = {
    {"judged.saturated.voltage", false, [](const Limits& l) { return l.saturated_share; }, "limits.saturated_share"},
    {"judged.saturated.current", false, [](const Limits& l) { return l.saturated_share; }, "limits.saturated_share"},
    {"range.share", false, [](const Limits& l) { return l.beyond_range_share; }, "limits.beyond_range_share"},
    {"range.setpoint_share", false, [](const Limits&) { return 0.0; }, ""},
    {"judged.tracking_error.peak", false, [](const Limits& l) { return kTrackingFails * l.tracking_error; },
     "twice limits.tracking_error"},
    {"limit_cycle.found", true, [](const Limits&) { return 1.0; }, ""},
    {"airborne_share", false, [](const Limits&) { return 0.0; }, ""},
    {"fell", false, [](const Limits&) { return 0.0; }, ""},
    {"energy.residual_share", false, [](const Limits& l) { return l.energy_residual; }, "limits.energy_residual"},
    {"verdict_excess", false, [](const Limits&) { return 0.0; }, ""},
    {"energy.created_share", false, [](const Limits& l) { return l.energy_created; },
     "limits.energy_created, where the objective names cost_of_transport.electrical"},
};

std::string full(const std::string& name, const std::string& joint) { return joint.empty() ? name : name + "[" + joint + "]"; }

std::size_t column_of(const std::vector<FigureName>& columns, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(columns, name, &FigureName::name) - columns.begin());
}

std::vector<std::string> names_of(const std::vector<FigureName>& figures) {
  std::vector<std::string> names;
  for (const FigureName& figure : figures) names.push_back(figure.name);
  return names;
}

}  // namespace

std::span<const Guard> guards() { return kGuards; }

double broken(double value, double limit, bool least) {
  if (std::isnan(value) || std::isnan(limit)) return 1;
  const double beyond = std::max(0.0, least ? limit - value : value - limit);
  return limit == 0 ? beyond : beyond / std::abs(limit);
}

double broken(const Formula& relation, std::span<const double> figures, bool guard) {
  const double a = relation.operand(0, figures);
  const double b = relation.operand(1, figures);
  if (guard && std::isnan(a)) return 0;
  const double above = relation.compares(">=") ? 0 : broken(a, b, false);
  const double below = relation.compares("<=") ? 0 : broken(a, b, true);
  return std::max(above, below);
}

std::vector<FigureName> columns_of(const Study& study, const FigureOffer& offer, const std::vector<std::string>& joints) {
  std::vector<FigureName> columns = offer.common;
  const auto add = [&](const FigureName& figure, const std::string& joint) {
    const std::string name = full(figure.name, joint);
    if (column_of(columns, name) == columns.size()) columns.push_back({name, figure.unit, "Of this joint: " + figure.meaning});
  };
  const auto add_named = [&](const Text& text) {
    for (const auto& [name, joint] : named_joints(text.text)) {
      const std::size_t at = column_of(offer.of_joints, name);
      if (at < offer.of_joints.size() && std::ranges::find(joints, joint) != joints.end()) add(offer.of_joints[at], joint);
    }
  };
  for (const Objective& objective : study.objectives) add_named(objective.expression);
  for (const Text& text : study.constraints) add_named(text);
  for (const std::string& pattern : study.figures) {
    if (pattern.find('[') == std::string::npos) continue;
    for (const FigureName& figure : offer.of_joints) {
      for (const std::string& joint : joints) {
        if (glob(pattern, full(figure.name, joint))) add(figure, joint);
      }
    }
  }
  return columns;
}

Judge::Judge(const Study& study, const std::vector<FigureName>& columns, const FigureOffer& offer, const Limits& limits,
             const std::vector<std::string>& joints, Problems& problems)
    : columns_(columns), offer_(offer), limits_(limits), joints_(joints) {
  const Names names = [this](const std::string& name, const std::string& joint) { return find(name, joint); };
  for (const Objective& objective : study.objectives) {
    objectives_.emplace_back(objective.expression, names, problems);
    objective_texts_.push_back(objective.expression.text);
  }
  for (const Text& text : study.constraints) {
    const std::size_t before = problems.size();
    Formula formula(text, names, problems);
    const bool relation = formula.compares("<=") || formula.compares(">=") || formula.compares("==");
    if (problems.size() == before && !relation)
      problems.add(text.node.place, in_quotes(text.text) + " is not a constraint; expected a <= b, a >= b or a == b");
    constraints_.push_back(std::move(formula));
    constraint_texts_.push_back(text.text);
  }
  read_guards(study, problems);
}

void Judge::read_guards(const Study& study, Problems& problems) {
  std::vector<std::string> known;
  for (const Guard& guard : kGuards) known.emplace_back(guard.figure);
  for (const GuardLimit& given : study.guards) {
    if (std::ranges::find(known, given.name) == known.end())
      problems.add(given.place, "unknown guard " + in_quotes(given.name) + offer(given.name, known, "guards"));
  }
  if (!study.guarded) return;
  for (const Guard& guard : kGuards) {
    const auto given = std::ranges::find(study.guards, guard.figure, &GuardLimit::name);
    const bool of_energy = &guard == &kGuards[std::size(kGuards) - 1];
    const auto of_cost = [](const Formula& f) { return f.names("cost_of_transport.electrical"); };
    if (of_energy && given == study.guards.end() && std::ranges::none_of(objectives_, of_cost)) continue;
    Kept kept{&guard, column_of(columns_, guard.figure), {}};
    if (given != study.guards.end()) kept.limit = given->limit;
    if (kept.column < columns_.size()) kept_.push_back(kept);
  }
}

Naming Judge::find(const std::string& name, const std::string& joint) const {
  const std::size_t column = column_of(columns_, full(name, joint));
  if (column < columns_.size()) return {column};
  const std::vector<std::string> of_joints = names_of(offer_.of_joints);
  if (!joint.empty() && std::ranges::find(of_joints, name) != of_joints.end())
    return {{}, "no joint is called " + in_quotes(joint) + offer(joint, joints_, "joints")};
  if (!joint.empty() && column_of(columns_, name) < columns_.size())
    return {{}, in_quotes(name) + " is of the whole robot; expected it without [" + clipped(joint) + "]"};
  return {{},
          "unknown figure " + in_quotes(name) + offer(name, joint.empty() ? names_of(offer_.common) : of_joints, "figures")};
}

std::vector<Limit> Judge::limits() const {
  std::vector<Limit> all;
  for (const std::string& text : constraint_texts_) all.push_back({text});
  for (const Kept& kept : kept_) {
    all.push_back({fmt::format("{} {} {}", kept.guard->figure,
                               kept.guard->least ? ">=" : "<=", number_text(kept.limit.value_or(kept.guard->limit(limits_)))),
                   true});
  }
  return all;
}

std::vector<std::string> Judge::broken(const Scenario& scenario, std::span<const double> figures) const {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < objectives_.size(); ++k) {
    if (!std::isfinite(objectives_[k].value(figures))) all.push_back(objective_texts_[k] + " is not known");
  }
  for (std::size_t k = 0; k < constraints_.size(); ++k) {
    if (studies::broken(constraints_[k], figures) > 0)
      all.push_back(fmt::format("{} ({:.4g})", constraint_texts_[k], constraints_[k].operand(0, figures)));
  }
  for (const Kept& kept : kept_) {
    const double value = figures[kept.column];
    const double limit = kept.limit.value_or(kept.guard->limit(scenario.limits));
    if (!std::isnan(value) && studies::broken(value, limit, kept.guard->least) > 0)
      all.push_back(
          fmt::format("{} {} {} ({:.4g})", kept.guard->figure, kept.guard->least ? ">=" : "<=", number_text(limit), value));
  }
  return all;
}

Score Judge::score(const Scenario& scenario, std::span<const double> figures) const {
  Score score;
  for (std::size_t k = 0; k < objectives_.size(); ++k) {
    score.objectives[k] = objectives_[k].value(figures);
    if (!std::isfinite(score.objectives[k])) score.violation += 1;
  }
  for (const Formula& constraint : constraints_) score.violation += studies::broken(constraint, figures);
  for (const Kept& kept : kept_) {
    // Not known is what the run does not have: motors, a ground, or a height to fall from.
    if (std::isnan(figures[kept.column])) continue;
    score.violation +=
        studies::broken(figures[kept.column], kept.limit.value_or(kept.guard->limit(scenario.limits)), kept.guard->least);
  }
  return score;
}

}  // namespace gaitlab::studies
