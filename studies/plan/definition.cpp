#include "studies/plan/definition.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>

#include "core/files/hash.h"
#include "core/settings/wording.h"
#include "studies/plan/worlds.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

std::string number_range(const Parameter& p) {
  std::string text = fmt::format("{} to {}", number_text(p.low), number_text(p.high));
  if (p.log) text += ", log";
  if (p.count > 0) text += fmt::format(", {} values", p.count);
  return text;
}

std::string law_text(const Variation& v) {
  std::string text = v.times ? "times " : "";
  if (v.law == Variation::Law::values) return text + fmt::format("one of {}", fmt::join(v.values, ", "));
  text += fmt::format("{} {}, {}", v.law == Variation::Law::normal ? "normal" : "uniform", number_text(v.a), number_text(v.b));
  if (v.low) text += ", low " + number_text(*v.low);
  if (v.high) text += ", high " + number_text(*v.high);
  return text;
}

std::string method_name(const Study& study) { return study.asked ? "asked" : name_of(study.method); }

/// Names of the worlds of a robust study; empty for other studies.
std::vector<std::string> robust_names(const BoundStudy& bound) {
  std::vector<std::string> names;
  if (!bound.study().robust) return names;
  const std::vector<World> all = worlds(bound.scenarios().front().nominal);
  for (const std::size_t w : bound.robust_worlds()) names.push_back(all[w].name);
  return names;
}

/// Name of an objective whose values another program gives. These may differ from the values of the study's expression.
std::string told_objective(const Study& study, std::size_t number) {
  return study.objectives.size() == 1 ? "result" : fmt::format("result {}", number + 1);
}

/// Settings of a search, without its method.
std::string search_text(const Study& study) {
  const SearchKeys& s = study.search;
  std::string text =
      fmt::format("search: population {}, instances {}, restarts {}",
                  s.population > 0 ? std::to_string(s.population) : "by the number of parameters", s.instances, s.restarts);
  if (enum_row(study.method).sigma) text += ", sigma " + number_text(s.sigma);
  return text + "\n";
}

}  // namespace

std::string definition(const BoundStudy& bound) {
  const Study& study = bound.study();
  std::string text = fmt::format("seed: {}\nmethod: {}\n", study.seed, method_name(study));
  if (!study.asked && is_search(study.method)) text += search_text(study);
  if (study.told) text += "results: of another program\n";
  for (const std::vector<std::string>& start : bound.starts()) text += fmt::format("start: {}\n", fmt::join(start, ", "));
  for (const Parameter& p : study.parameters) {
    text += fmt::format("parameter {}: {}\n", p.key,
                        p.values.empty() ? number_range(p) : fmt::format("{}", fmt::join(p.values, ", ")));
    text += followers_text(p);
  }
  if (study.robust) text += fmt::format("robust: {}\n", fmt::join(robust_names(bound), ", "));
  if (study.replicates.count > 0) {
    text += fmt::format("replicates: {}, {}", study.replicates.count, name_of(study.replicates.combine));
    if (study.replicates.has_argument()) text += " " + number_text(study.replicates.quantile);
    text += "\n";
  }
  for (const Variation& v : study.replicates.vary) text += fmt::format("vary {}: {}\n", v.key, law_text(v));
  for (std::size_t k = 0; k < study.objectives.size(); ++k)
    text += fmt::format("{}: {}\n", study.objectives[k].maximize ? "maximize" : "minimize", bound.scorer().objectives()[k]);
  for (const Limit& limit : bound.scorer().limits())
    text += fmt::format("{}: {}\n", limit.guard ? "guard" : "constraint", limit.text);
  for (const std::string& stop : bound.stops().texts()) {
    if (!study.told) text += "stop: " + stop + "\n";
  }
  text += fmt::format("estimate_every: {}\n", study.estimate_every);
  std::string columns;
  for (const Quantity& column : bound.columns()) columns += column.name + "\n";
  for (const Quantity& column : bound.columns()) {
    if (column.name.ends_with("]")) text += "quantity: " + column.name + "\n";
  }
  return text + "quantities: " + hash128(columns) + "\n";
}

JournalHead journal_head(const Plan& plan) {
  const BoundStudy& bound = plan.bound();
  const Study& study = bound.study();
  JournalHead head;
  head.name = study.name;
  head.definition = definition(bound);
  head.scenario = bound.scenario_text();
  for (const StudyScenario& one : bound.scenarios()) {
    if (!one.name.empty()) head.scenarios.push_back(one.name);
  }
  for (std::size_t k = 0; k < study.objectives.size(); ++k) {
    head.objectives.push_back(
        {study.told ? told_objective(study, k) : plan.scorer().objectives()[k], study.objectives[k].maximize});
  }
  head.combine = name_of(study.replicates.combine);
  head.quantile = study.replicates.quantile;
  head.runs = plan.most_runs();
  head.replicates = plan.points().runs_of_point();
  head.seed = study.seed;
  for (const Parameter& p : study.parameters)
    head.parameters.push_back({p.key, p.words, false, p.low, p.high, p.log, p.values});
  for (const Variation& v : study.replicates.vary) head.parameters.push_back({v.key, v.words, true, 0, 0, false, v.values});
  head.quantities = bound.columns();
  for (const std::size_t column : bound.shown()) head.shown.push_back(bound.columns()[column].name);
  head.limits = plan.scorer().limits();
  head.guarded = study.guarded;
  head.method = method_name(study);
  head.told = study.told;
  head.torque_error = std::numeric_limits<double>::infinity();
  for (const StudyScenario& one : bound.scenarios())
    head.torque_error = std::min(head.torque_error, one.nominal.limits.most_torque_error());
  head.worlds = robust_names(bound);
  return head;
}

}  // namespace gaitlab::studies
