#include "studies/plan/bound_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/model/pattern.h"
#include "core/scenario/other_engine.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"
#include "studies/plan/own_values.h"
#include "studies/plan/worlds.h"
#include "studies/study/number.h"
#include "studies/study/study_file.h"

namespace gaitlab::studies {

namespace {

/// True if the engine has no other method for the scenario than its own: explicit integrators differ from adaptive ones.
bool is_own(const std::string& engine, const Scenario& scenario) {
  const Physics& physics = scenario.physics;
  return physics.engine->name == engine && !(physics.adaptive_step && physics.engine->choose_step != nullptr);
}

/// Settings that replace the engine of a scenario by that of `verify`, with its default step, or by the explicit
/// integrator of the same engine. Empty without such an engine or integrator.
std::vector<std::string> other_engine_of(const Verify& verify, const Scenario& scenario, const Catalog& catalog,
                                         Problems& problems) {
  const std::string& name = verify.engine;
  if (name == "none" || is_own(name, scenario)) return {};
  const Engine* engine = catalog.engine(name);
  if (engine == nullptr) {
    problems.add(verify.place,
                 "verify.engine " + in_quotes(name) + " is not known" + gaitlab::offer(name, catalog.engines(), "engines"));
    return {};
  }
  const bool own_step = scenario.contact.model().has_step_of_its_own;
  const bool chooses = engine->choose_step != nullptr && !own_step;  // a stable step, up to the longest of the engine
  const bool adapts = engine->adaptive() != nullptr && !own_step;
  // An explicit integrator shares nothing with the run, and is therefore the better check.
  const Integrator& integrator = adapts && !chooses ? engine->integrators.front() : engine->fixed();
  const std::string step = adapts || chooses ? "auto" : number_text(engine->given_step(own_step));
  return engine_settings(scenario, name, integrator, step);
}

/// Checks that the joint quantities that match the study's patterns are the same in every scenario.
void check_same(const std::vector<Quantity>& first, const std::vector<Quantity>& other, const SourceLocation& place,
                Problems& problems) {
  const auto check = [&](const std::vector<Quantity>& have, const std::vector<Quantity>& lack, const char* text) {
    for (const Quantity& quantity : have) {
      if (std::ranges::find(lack, quantity.name, &Quantity::name) != lack.end()) continue;
      problems.add(place, fmt::format(fmt::runtime(text), in_quotes(quantity.name)));
      return;
    }
  };
  check(first, other, "there is no quantity {}, which the first scenario has");
  if (problems.empty()) check(other, first, "there is a quantity {}, which the first scenario does not have");
}

}  // namespace

BoundStudy::BoundStudy(Study study, const QuantityOffer& offer, Catalog& catalog)
    : study_(with_budget(std::move(study))),
      scenarios_(read_scenarios(study_, problems_, catalog)),
      scenario_text_(scenarios_text(scenarios_)) {
  find_worlds();
  const std::size_t before = problems_.size();
  followers_ = std::make_unique<Followers>(study_.parameters, problems_);
  if (problems_.size() > before) problems_.raise();
  std::vector<Problems> found(scenarios_.size());
  for (std::size_t s = 0; s < scenarios_.size(); ++s) {
    check_own_names(s, found[s]);
    find_nominal(scenarios_[s], found[s]);
  }
  add_of_each(scenarios_, found, problems_);
  find_starts();
  find_columns(offer);
  choose_shown();
  if (shown_.empty()) problems_.raise();  // the default objective is the first shown quantity
  if (FormulaText& first = study_.objectives.front().expression; first.text.empty()) first.text = columns_[shown_.front()].name;
  make_scorers(offer, catalog);
}

/// The study. If its budget is impossible, it is replaced by a possible one. That of a robust study depends on its worlds.
Study BoundStudy::with_budget(Study study) {
  if (!study.robust) check_budget(study, problems_);
  return study;
}

void BoundStudy::find_worlds() {
  if (!study_.robust) return;
  std::vector<std::vector<World>> of_each;
  for (const StudyScenario& one : scenarios_) of_each.push_back(worlds(one.nominal));
  for (std::size_t w = 0; w < kWorlds; ++w) {
    if (std::ranges::any_of(of_each, [w](const std::vector<World>& of) { return of[w].applies; })) robust_worlds_.push_back(w);
  }
  study_.replicates.count = 1 + static_cast<std::int64_t>(robust_worlds_.size());
  check_budget(study_, problems_);
}

/// Refuses a free parameter with the name of a key of the scenario, because the two would be confused.
void BoundStudy::check_own_names(std::size_t scenario, Problems& problems) const {
  for (const Parameter& p : study_.parameters) {
    if (p.sets.empty()) continue;
    bool is_key = true;
    try {
      (void)with({p.key + "=0"}, scenario);
    } catch (const InputError& error) {
      is_key = std::ranges::none_of(error.problems(), [&](const Problem& one) { return one.unknown_key == p.key; });
    }
    if (is_key) {
      problems.add(p.place, fmt::format("{} is a key of the scenario; a parameter with `sets` needs another name", p.key));
    }
  }
}

void BoundStudy::find_nominal(StudyScenario& scenario, Problems& problems) const {
  std::optional<Node> tree;
  for (const Variation& v : study_.replicates.vary) {
    const auto same = [&](const Parameter& p) {
      return p.key == v.key || std::ranges::find(p.sets, v.key, &Follower::key) != p.sets.end();
    };
    if (!v.times || std::ranges::any_of(study_.parameters, same)) continue;
    if (!tree) tree = parse_yaml(scenario.resolved, scenario.nominal.file);
    const Node* node = find_key(*tree, v.key, scenario.joints);
    const Reading<double> value = node == nullptr ? Reading<double>{0, "is not a key of the scenario"} : read_number(*node, "");
    if (!value.ok()) problems.add(v.place, v.key + " " + value.wrong + "; `times` needs a number in the scenario");
    scenario.nominal_values[v.key] = value.value;
  }
}

/// First points of a search. If the scenario's value of a listed parameter is not listed, the scenario's own point has the
/// first listed value instead, because each listed value has a separate search.
void BoundStudy::find_starts() {
  if (!is_search(study_.method)) return;
  const std::vector<OwnValue> own = own_values(study_, scenarios_.front());
  std::vector<std::string> values;
  for (std::size_t k = 0; k < own.size(); ++k) {
    const Parameter& p = study_.parameters[k];
    values.push_back(own[k].text.empty() && !p.values.empty() ? p.values.front() : own[k].text);
    if (values.back().empty() && !not_own_) not_own_ = Problem{p.place, p.key + " " + own[k].missing};
  }
  if (!not_own_) starts_.push_back(values);
  for (const StartPoint& start : study_.starts) {
    std::vector<std::string> at = values;
    for (const auto& [key, value] : start.values) {
      const auto p = std::ranges::find(study_.parameters, key, &Parameter::key);
      at[static_cast<std::size_t>(p - study_.parameters.begin())] = value;
    }
    if (const auto unknown = std::ranges::find(at, ""); unknown != at.end()) {
      const std::string& key = study_.parameters[static_cast<std::size_t>(unknown - at.begin())].key;
      problems_.add(start.place, fmt::format("this point has no {}, which {}; expected {}: VALUE", key,
                                             own[static_cast<std::size_t>(unknown - at.begin())].missing, key));
    }
    starts_.push_back(std::move(at));
  }
}

/// Finds the columns of the first scenario; the other scenarios must have the same columns.
void BoundStudy::find_columns(const QuantityOffer& offer) {
  columns_ = columns_of(study_, offer, scenarios_.front().joints);
  constexpr std::size_t kMostColumns = 400;
  if (columns_.size() > kMostColumns) {
    problems_.add(study_.quantities_place,
                  fmt::format("the journal would have {} columns of quantities; expected at most {}: name fewer joints",
                              columns_.size(), kMostColumns));
  }
}

void BoundStudy::choose_shown() {
  const std::vector<std::string> patterns = study_.quantities.empty() ? std::vector<std::string>{"speed"} : study_.quantities;
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (!glob(pattern, columns_[k].name)) continue;
      any = true;
      if (std::ranges::find(shown_, k) == shown_.end()) shown_.push_back(k);
    }
    if (any) continue;
    std::vector<std::string> known;
    for (const Quantity& column : columns_) known.push_back(column.name);
    problems_.add(study_.quantities_place,
                  "no quantity is named " + in_quotes(pattern) + gaitlab::offer(pattern, known, "quantities"));
  }
}

/// Refuses names in the study's expressions that a scenario lacks. The loop ends with the first scenario, whose scorer and
/// rules remain.
void BoundStudy::make_scorers(const QuantityOffer& offer, const Catalog& catalog) {
  std::vector<Problems> found(scenarios_.size());
  std::vector<std::vector<Quantity>> columns(scenarios_.size());
  for (std::size_t s = scenarios_.size(); s-- > 0;) {
    StudyScenario& one = scenarios_[s];
    columns[s] = s == 0 ? columns_ : columns_of(study_, offer, one.joints);
    scorer_ = std::make_unique<Scorer>(study_, columns[s], offer, one.joints, found[s]);
    one.other_engine = other_engine_of(study_.verify, one.nominal, catalog, found[s]);
    stops_ = std::make_unique<StopRules>(study_, offer, one.joints, scorer_->margins(), found[s]);
  }
  check_stops();
  if (std::ranges::all_of(found, &Problems::empty)) {
    for (std::size_t s = 1; s < scenarios_.size(); ++s) check_same(columns_, columns[s], study_.quantities_place, found[s]);
  }
  check_engines(catalog, found);
  add_of_each(scenarios_, found, problems_);
}

/// Refuses a stop rule that begins after the end of every run, because the rule would stop none.
void BoundStudy::check_stops() {
  const auto is_duration = [](const std::string& key) { return key == "duration"; };
  for (const Parameter& p : study_.parameters) {
    if (is_duration(p.key) || std::ranges::any_of(p.sets, is_duration, &Follower::key)) return;
  }
  if (std::ranges::any_of(study_.replicates.vary, is_duration, &Variation::key)) return;
  for (const StopText& stop : study_.stops) {
    if (stop.after < longest()) continue;
    problems_.add(stop.when.node.place,
                  fmt::format("the rule begins at {} s, but the {} ends at {} s; expected a smaller number after `after`",
                              number_text(stop.after), scenarios_.size() > 1 ? "longest run" : "run", number_text(longest())));
  }
}

/// Refuses an engine of `verify` that the study already uses. Refuses faults of `verify` if there are several scenarios, or if
/// a scenario has a section `at`.
void BoundStudy::check_engines(const Catalog& catalog, std::vector<Problems>& found) const {
  const std::string& engine = study_.verify.engine;
  if (study_.verify.faults == VerifyFaults::each && scenarios_.size() > 1) {
    found[0].add(
        study_.verify.place,
        "`verify.faults: each` tests one scenario, but the study has several; expected one scenario, or `faults: none`");
  }
  for (std::size_t s = 0; s < scenarios_.size(); ++s) {
    if (study_.verify.faults == VerifyFaults::each && !scenarios_[s].nominal.changes.empty()) {
      found[s].add(study_.verify.place,
                   "`verify.faults: each` needs a scenario without a section `at`, but this one has one; expected another "
                   "scenario, or `faults: none`");
    }
    if (is_own(engine, scenarios_[s].nominal)) {
      found[s].add(study_.verify.place,
                   fmt::format("verify.engine is {}, the engine of the study itself; expected another, or `none`; engines: {}",
                               engine, fmt::join(catalog.engines(), ", ")));
    }
  }
}

double BoundStudy::longest() const {
  double longest = 0;
  for (const StudyScenario& one : scenarios_) longest = std::max(longest, one.nominal.duration);
  return longest;
}

bool BoundStudy::has_other_engine() const {
  return std::ranges::any_of(scenarios_, [](const StudyScenario& one) { return !one.other_engine.empty(); });
}

}  // namespace gaitlab::studies
