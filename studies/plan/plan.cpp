#include "studies/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/model/pattern.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"
#include "studies/plan/draws.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

const Node* find_key(const Node& root, const std::string& key) {
  const Node* node = &root;
  for (std::size_t at = 0; node != nullptr && at <= key.size();) {
    const std::size_t end = std::min(key.find('.', at), key.size());
    node = node->kind == Node::Kind::map ? node->find(key.substr(at, end - at)) : nullptr;
    at = end + 1;
  }
  return node;
}

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

/// What a search is besides its method.
std::string search_text(const Study& study) {
  const SearchKeys& s = study.search;
  std::string text =
      fmt::format("search: population {}, instances {}, restarts {}",
                  s.population > 0 ? std::to_string(s.population) : "by the number of parameters", s.instances, s.restarts);
  if (study.method == Method::cma || study.method == Method::xnes) text += ", sigma " + number_text(s.sigma);
  return text + "\n";
}

/// Settings that take the engine of `verify` in place of a scenario's, with its own step; empty: it is that engine, or none.
std::vector<std::string> other_engine_of(const Verify& verify, const Scenario& scenario, const Catalog& catalog,
                                         Problems& problems) {
  const std::string& name = verify.engine;
  if (name == "none" || name == scenario.physics.engine->name) return {};
  const Engine* engine = catalog.engine(name);
  if (engine == nullptr) {
    problems.add(verify.place,
                 "verify.engine " + in_quotes(name) + " is not known" + gaitlab::offer(name, catalog.engines(), "engines"));
    return {};
  }
  const bool solver = scenario.contact.solver();
  const double step = solver && engine->solver_step > 0 ? engine->solver_step : engine->step;
  std::vector<std::string> sets{"physics.engine=" + name};
  if (engine->adaptive() != nullptr) {
    sets.push_back(fmt::format("physics.integrator={}", engine->integrators.front().name));
    sets.emplace_back("physics.step=auto");
  } else {
    sets.push_back(fmt::format("physics.integrator={}", engine->fixed().name));
    sets.push_back("physics.step=" + number_text(step));
  }
  return sets;
}

/// Quantities of joints that a pattern of the study names are the same in every scenario.
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

Plan::Plan(Study study, const QuantityOffer& offer, Catalog& catalog)
    : study_(std::move(study)), scenarios_(read_scenarios(study_, catalog)), points_(study_) {
  Problems problems;
  scenario_text_ = scenarios_text(scenarios_);
  scenario_digest_ = digest(scenario_text_);
  followers_ = std::make_unique<Followers>(study_.parameters, problems);
  problems.raise();
  std::vector<Problems> found(scenarios_.size());
  for (std::size_t s = 0; s < scenarios_.size(); ++s) {
    check_own_names(s, found[s]);
    find_nominal(scenarios_[s], found[s]);
  }
  add_of_each(scenarios_, found, problems);
  find_columns(offer, problems);
  choose_shown(problems);
  if (shown_.empty()) problems.raise();  // what orders the points is one of them
  if (Text& first = study_.objectives.front().expression; first.text.empty()) first.text = columns_[shown_.front()].name;
  make_judges(offer, catalog, problems);
  problems.raise();
  std::vector<Problems> refused(scenarios_.size());
  for (std::size_t s = 0; s < scenarios_.size(); ++s) check_corners(s, refused[s]);
  add_of_each(scenarios_, refused, problems);
  problems.raise();
}

/// Those of the first scenario, which the others must have.
void Plan::find_columns(const QuantityOffer& offer, Problems& problems) {
  columns_ = columns_of(study_, offer, scenarios_.front().joints);
  constexpr std::size_t kMostColumns = 400;
  if (columns_.size() > kMostColumns)
    problems.add(study_.quantities_place,
                 fmt::format("the journal would have {} columns of quantities; allowed are up to {}: name fewer joints",
                             columns_.size(), kMostColumns));
}

/// What the study's expressions name exists in every scenario. The judges that stay are those of the first, which comes last.
void Plan::make_judges(const QuantityOffer& offer, const Catalog& catalog, Problems& problems) {
  std::vector<Problems> found(scenarios_.size());
  std::vector<std::vector<Quantity>> columns(scenarios_.size());
  for (std::size_t s = scenarios_.size(); s-- > 0;) {
    StudyScenario& one = scenarios_[s];
    columns[s] = s == 0 ? columns_ : columns_of(study_, offer, one.joints);
    judge_ = std::make_unique<Judge>(study_, columns[s], offer, one.joints, found[s]);
    one.other_engine = other_engine_of(study_.verify, one.nominal, catalog, found[s]);
    stops_ = std::make_unique<StopRules>(study_, offer, one.joints, found[s]);
  }
  check_stops(problems);
  if (std::ranges::all_of(found, &Problems::empty)) {
    for (std::size_t s = 1; s < scenarios_.size(); ++s) check_same(columns_, columns[s], study_.quantities_place, found[s]);
  }
  const std::string& engine = study_.verify.engine;
  for (std::size_t s = 0; s < scenarios_.size(); ++s) {
    if (scenarios_[s].nominal.physics.engine->name == engine)
      found[s].add(study_.verify.place,
                   fmt::format("verify.engine {} is the engine of the study itself; expected another, or none: known are {}",
                               engine, fmt::join(catalog.engines(), ", ")));
  }
  add_of_each(scenarios_, found, problems);
}

double Plan::longest() const {
  double longest = 0;
  for (const StudyScenario& one : scenarios_) longest = std::max(longest, one.nominal.duration);
  return longest;
}

bool Plan::has_other_engine() const {
  return std::ranges::any_of(scenarios_, [](const StudyScenario& one) { return !one.other_engine.empty(); });
}

void Plan::find_nominal(StudyScenario& scenario, Problems& problems) const {
  std::optional<Node> tree;
  for (const Variation& v : study_.replicates.vary) {
    const auto same = [&](const Parameter& p) {
      return p.key == v.key || std::ranges::find(p.sets, v.key, &Follower::key) != p.sets.end();
    };
    if (!v.times || std::ranges::any_of(study_.parameters, same)) continue;
    if (!tree) tree = parse_yaml(scenario.resolved, scenario.nominal.file);
    const Node* node = find_key(*tree, v.key);
    const Reading<double> value = node == nullptr ? Reading<double>{0, "is not a key of the scenario"} : read_number(*node, "");
    if (!value.ok()) problems.add(v.place, v.key + " " + value.wrong + ", which a factor needs");
    scenario.nominal_values[v.key] = value.value;
  }
}

void Plan::choose_shown(Problems& problems) {
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
    problems.add(study_.quantities_place,
                 "no quantity is named " + in_quotes(pattern) + gaitlab::offer(pattern, known, "quantities"));
  }
}

std::map<std::string, double> Plan::nominal(const std::vector<std::string>& values, std::size_t scenario) const {
  std::map<std::string, double> nominal = scenarios_[scenario].nominal_values;
  for (const auto& [key, value] : followers_->settings(values)) nominal[key] = number_of(value);
  return nominal;
}

std::vector<std::string> Plan::sets(std::uint64_t run) const { return sets(points_.values(points_.point(run)), run); }

/// Of a run, were its point one with these values.
std::vector<std::string> Plan::sets(const std::vector<std::string>& values, std::uint64_t run) const {
  std::vector<std::string> sets;
  for (const auto& [key, value] : followers_->settings(values)) sets.push_back(key + "=" + value);
  if (study_.replicates.count == 0) return sets;
  const std::uint64_t replicate = points_.replicate(run);
  const std::vector<std::string> drawn = points_.drawn(replicate, nominal(values, points_.scenario(run)));
  for (std::size_t k = 0; k < drawn.size(); ++k) sets.push_back(study_.replicates.vary[k].key + "=" + drawn[k]);
  sets.push_back(fmt::format("seed={}", points_.seed(replicate)));
  return sets;
}

bool Plan::raise_budget(std::uint64_t runs) {
  if (study_.runs == 0) return false;
  const std::uint64_t each = points_.runs_of_point();
  study_.runs = std::max(study_.runs, static_cast<std::int64_t>((runs + each - 1) / each * each));
  return true;
}

std::string Plan::point_name(const std::vector<std::string>& values) const {
  std::string name = scenario_digest_;
  for (std::size_t k = 0; k < values.size(); ++k) name += study_.parameters[k].key + "=" + values[k] + "\n";
  const auto own = [](const Parameter& p) { return !p.sets.empty(); };
  if (std::ranges::any_of(study_.parameters, own)) {  // what follows it may be others in another study
    for (const auto& [key, value] : followers_->settings(values)) name += key + "=" + value + "\n";
  }
  return digest(name);
}

Row Plan::row(std::uint64_t run) const {
  Row row;
  row.run = run;
  row.values = points_.values(points_.point(run));
  row.point = point_name(row.values);
  const std::size_t scenario = points_.scenario(run);
  row.scenario = scenarios_[scenario].name;
  row.replicate = points_.replicate(run);
  if (study_.replicates.count > 0) {
    const std::vector<std::string> drawn = points_.drawn(row.replicate, nominal(row.values, scenario));
    row.values.insert(row.values.end(), drawn.begin(), drawn.end());
  }
  row.seed = study_.replicates.count == 0 ? scenarios_[scenario].nominal.seed : points_.seed(row.replicate);
  return row;
}

bool Plan::estimates(const std::string& point) const {
  const auto every = static_cast<std::uint64_t>(study_.estimate_every);
  if (every == 0) return false;
  std::uint64_t name = 0;  // the first 64 of 128 bit
  std::from_chars(point.data(), point.data() + std::min<std::size_t>(point.size(), 16), name, 16);
  return hash64({kEstimateDraw, static_cast<std::uint64_t>(study_.seed), name}) % every == 0;
}

void Plan::finish(Row& row, const Scenario& scenario, const Recording& recording, const Measure& measure) const {
  row.simulated = recording.simulated;
  row.outcome = name_of(recording.outcome.ended);
  if (!recording.outcome.done()) {
    row.message = recording.outcome.message;
    row.verdict = "failed";
    return;
  }
  Judged judged = measure(scenario, recording);
  row.quantities = std::move(judged.quantities);
  row.verdict = std::move(judged.verdict);
  row.message = std::move(judged.why);
  row.score = judge_->score(row.quantities, row.verdict);
}

std::string Plan::definition() const {
  std::string text = fmt::format("seed: {}\nmethod: {}\n", study_.seed, study_.asked ? "asked" : name_of(study_.method));
  if (!study_.asked && is_search(study_.method)) text += search_text(study_);
  for (const Parameter& p : study_.parameters) {
    text += fmt::format("parameter {}: {}\n", p.key,
                        p.values.empty() ? number_range(p) : fmt::format("{}", fmt::join(p.values, ", ")));
    text += followers_text(p);
  }
  if (study_.replicates.count > 0) {
    text += fmt::format("replicates: {}, {}", study_.replicates.count, name_of(study_.replicates.combine));
    if (study_.replicates.combine == Combine::quantile) text += " " + number_text(study_.replicates.quantile);
    text += "\n";
  }
  for (const Variation& v : study_.replicates.vary) text += fmt::format("vary {}: {}\n", v.key, law_text(v));
  for (std::size_t k = 0; k < study_.objectives.size(); ++k)
    text += fmt::format("{}: {}\n", study_.objectives[k].maximize ? "maximize" : "minimize", judge_->objectives()[k]);
  for (const Limit& limit : judge_->limits()) text += fmt::format("{}: {}\n", limit.guard ? "guard" : "constraint", limit.text);
  for (const std::string& stop : stops_->texts()) text += "stop: " + stop + "\n";
  text += fmt::format("estimate_every: {}\n", study_.estimate_every);
  std::string columns;
  for (const Quantity& column : columns_) columns += column.name + "\n";
  for (const Quantity& column : columns_) {
    if (column.name.ends_with("]")) text += "quantity: " + column.name + "\n";
  }
  return text + "quantities: " + digest(columns) + "\n";
}

JournalHead Plan::head() const {
  JournalHead head;
  head.name = study_.name;
  head.definition = definition();
  head.scenario = scenario_text_;
  for (const StudyScenario& one : scenarios_) {
    if (!one.name.empty()) head.scenarios.push_back(one.name);
  }
  for (std::size_t k = 0; k < study_.objectives.size(); ++k)
    head.objectives.push_back({judge_->objectives()[k], study_.objectives[k].maximize});
  head.combine = name_of(study_.replicates.combine);
  head.quantile = study_.replicates.quantile;
  head.runs = most_runs();
  head.replicates = points_.runs_of_point();
  head.seed = study_.seed;
  for (const Parameter& p : study_.parameters)
    head.parameters.push_back({p.key, p.words, false, p.low, p.high, p.log, p.values});
  for (const Variation& v : study_.replicates.vary) head.parameters.push_back({v.key, v.words, true, 0, 0, false, v.values});
  head.quantities = columns_;
  for (const std::size_t column : shown_) head.shown.push_back(columns_[column].name);
  head.limits = judge_->limits();
  head.guarded = study_.guarded;
  return head;
}

}  // namespace gaitlab::studies
