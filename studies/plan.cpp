#include "studies/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/model/pattern.h"
#include "core/scenario/resolved.h"
#include "core/scenario/value.h"
#include "core/scenario/wording.h"
#include "studies/draws.h"
#include "studies/number.h"

namespace gaitlab::studies {

namespace {

std::vector<std::string> joints_of(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const auto& joint : scenario.robot->joints) names.push_back(joint.name);
  return names;
}

const Node* find_key(const Node& root, const std::string& key) {
  const Node* node = &root;
  for (std::size_t at = 0; node != nullptr && at <= key.size();) {
    const std::size_t end = std::min(key.find('.', at), key.size());
    node = node->kind == Node::Kind::map ? node->find(key.substr(at, end - at)) : nullptr;
    at = end + 1;
  }
  return node;
}

/// What is wrong with a setting is told of the parameter or variation that makes it, at its place in the study.
void add_as_written(const InputError& error, const Study& study, Problems& problems) {
  for (const Problem& problem : error.problems()) {
    SourceLocation place = problem.place;
    const auto makes = [&](const auto& one) { return place.file.starts_with("--set " + one.key + "="); };
    const auto parameter = std::ranges::find_if(study.parameters, makes);
    const auto variation = std::ranges::find_if(study.replicates.vary, makes);
    for (std::size_t k = 0; k < study.set_places.size(); ++k) {
      if (place.file == "--set " + clipped(study.sets[k])) place = study.set_places[k];
    }
    if (variation != study.replicates.vary.end()) place = variation->place;
    if (parameter != study.parameters.end()) place = parameter->place;
    const auto alike = [&](const Problem& p) { return p.text == problem.text && to_string(p.place) == to_string(place); };
    if (std::ranges::none_of(problems.list(), alike)) problems.add(place, problem.text).notes = problem.notes;
  }
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

/// All parameters at their low, or first, or at their high, or last.
std::vector<std::string> corner(const Study& study, bool high) {
  std::vector<std::string> values;
  for (const Parameter& p : study.parameters)
    values.push_back(p.values.empty() ? number_text(high ? p.high : p.low) : high ? p.values.back() : p.values.front());
  return values;
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

constexpr std::array kCombines{"mean", "worst", "median", "quantile"};

}  // namespace

Plan::Plan(Study study, const FigureOffer& offer, Catalog& catalog) : study_(std::move(study)), points_(study_) {
  Problems problems;
  try {
    template_ = std::make_unique<ScenarioTemplate>(study_.scenario, study_.sets, catalog);
  } catch (const InputError& error) {
    add_as_written(error, study_, problems);
    problems.raise();
  }
  nominal_scenario_ = template_->with({});
  scenario_text_ = resolved(nominal_scenario_);
  scenario_digest_ = digest(scenario_text_);
  find_nominal(problems);
  const std::vector<std::string> joints = joints_of(nominal_scenario_);
  columns_ = columns_of(study_, offer, joints);
  constexpr std::size_t kMostColumns = 400;
  if (columns_.size() > kMostColumns)
    problems.add(study_.figures_place,
                 fmt::format("the journal would have {} columns of figures; allowed are up to {}: name fewer joints",
                             columns_.size(), kMostColumns));
  choose_shown(problems);
  if (shown_.empty()) problems.raise();  // what orders the points is one of them
  if (Text& first = study_.objectives.front().expression; first.text.empty()) first.text = columns_[shown_.front()].name;
  judge_ = std::make_unique<Judge>(study_, columns_, offer, nominal_scenario_.limits, joints, problems);
  find_other_engine(catalog, problems);
  stops_ = std::make_unique<StopRules>(study_, offer, joints, problems);
  problems.raise();
  Study gait = study_;
  gait.guarded = true;
  gait.guards.clear();
  gait_judge_ = std::make_unique<Judge>(gait, columns_, offer, nominal_scenario_.limits, joints, problems);
  if (problems.empty()) check_corners(problems);
  problems.raise();
  note_refused_ends();
}

void Plan::find_other_engine(const Catalog& catalog, Problems& problems) {
  const std::string& name = study_.verify.engine;
  if (name == "none") return;
  if (name == nominal_scenario_.physics.engine->name) {
    problems.add(study_.verify.place,
                 fmt::format("verify.engine {} is the engine of the study itself; expected another, or none: known are {}",
                             name, fmt::join(catalog.engines(), ", ")));
    return;
  }
  const Engine* engine = catalog.engine(name);
  if (engine == nullptr) {
    problems.add(study_.verify.place,
                 "verify.engine " + in_quotes(name) + " is not known" + gaitlab::offer(name, catalog.engines(), "engines"));
    return;
  }
  const bool solver = nominal_scenario_.contact.solver();
  const double step = solver && engine->solver_step > 0 ? engine->solver_step : engine->step;
  other_engine_ = {"physics.engine=" + name};
  if (engine->adaptive() != nullptr) {
    other_engine_.push_back(fmt::format("physics.integrator={}", engine->integrators.front().name));
    other_engine_.emplace_back("physics.step=auto");
  } else {
    other_engine_.push_back(fmt::format("physics.integrator={}", engine->fixed().name));
    other_engine_.push_back("physics.step=" + number_text(step));
  }
}

void Plan::find_nominal(Problems& problems) {
  std::optional<Node> tree;
  for (const Variation& v : study_.replicates.vary) {
    const auto same = [&](const Parameter& p) { return p.key == v.key; };
    if (!v.times || std::ranges::any_of(study_.parameters, same)) continue;
    if (!tree) tree = parse_yaml(scenario_text_, study_.scenario);
    const Node* node = find_key(*tree, v.key);
    const Reading<double> value = node == nullptr ? Reading<double>{0, "is not a key of the scenario"} : read_number(*node, "");
    if (!value.ok()) problems.add(v.place, v.key + " " + value.wrong + ", which a factor needs");
    nominal_[v.key] = value.value;
  }
}

void Plan::choose_shown(Problems& problems) {
  const std::vector<std::string> patterns = study_.figures.empty() ? std::vector<std::string>{"speed"} : study_.figures;
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (!glob(pattern, columns_[k].name)) continue;
      any = true;
      if (std::ranges::find(shown_, k) == shown_.end()) shown_.push_back(k);
    }
    if (any) continue;
    std::vector<std::string> known;
    for (const FigureName& column : columns_) known.push_back(column.name);
    problems.add(study_.figures_place, "no figure is named " + in_quotes(pattern) + gaitlab::offer(pattern, known, "figures"));
  }
}

/// The first and the last run are tried: what both refuse no run can have, a misspelt key above all.
void Plan::check_corners(Problems& problems) const {
  std::optional<InputError> first;
  for (const bool last : {false, true}) {
    try {
      (void)with(is_search(study_.method) ? sets(corner(study_, last), 0) : sets(last ? points_.runs() - 1 : 0));
      return;
    } catch (const InputError& error) {
      if (!first) first = error;
    }
  }
  add_as_written(*first, study_, problems);
}

void Plan::note_refused_ends() {
  for (const Parameter& p : study_.parameters) {
    if (!p.values.empty()) continue;
    for (const bool high : {false, true}) {
      const std::string value = number_text(high ? p.high : p.low);
      try {
        (void)with({p.key + "=" + value});
      } catch (const InputError& error) {
        notes_.push_back({p.place, fmt::format("{} is refused at its {} of {}, so that points near it will fail: {}", p.key,
                                               high ? "high" : "low", value, error.problems().front().text)});
      }
    }
  }
}

std::map<std::string, double> Plan::nominal(const std::vector<std::string>& values) const {
  std::map<std::string, double> nominal = nominal_;
  for (std::size_t k = 0; k < study_.parameters.size(); ++k) nominal[study_.parameters[k].key] = number_of(values[k]);
  return nominal;
}

std::vector<std::string> Plan::sets(std::uint64_t run) const {
  return sets(points_.values(points_.point(run)), points_.replicate(run));
}

std::vector<std::string> Plan::sets(const std::vector<std::string>& values, std::uint64_t replicate) const {
  std::vector<std::string> sets;
  for (std::size_t k = 0; k < values.size(); ++k) sets.push_back(study_.parameters[k].key + "=" + values[k]);
  if (study_.replicates.count == 0) return sets;
  const std::vector<std::string> drawn = points_.drawn(replicate, nominal(values));
  for (std::size_t k = 0; k < drawn.size(); ++k) sets.push_back(study_.replicates.vary[k].key + "=" + drawn[k]);
  sets.push_back(fmt::format("seed={}", points_.seed(replicate)));
  return sets;
}

bool Plan::raise_budget(std::uint64_t runs) {
  if (study_.runs == 0) return false;
  const std::uint64_t each = points_.replicates();
  study_.runs = std::max(study_.runs, static_cast<std::int64_t>((runs + each - 1) / each * each));
  return true;
}

std::string Plan::point_name(const std::vector<std::string>& values) const {
  std::string name = scenario_digest_;
  for (std::size_t k = 0; k < values.size(); ++k) name += study_.parameters[k].key + "=" + values[k] + "\n";
  return digest(name);
}

Row Plan::row(std::uint64_t run) const {
  Row row;
  row.run = run;
  row.values = points_.values(points_.point(run));
  row.point = point_name(row.values);
  row.replicate = points_.replicate(run);
  if (study_.replicates.count > 0) {
    const std::vector<std::string> drawn = points_.drawn(row.replicate, nominal(row.values));
    row.values.insert(row.values.end(), drawn.begin(), drawn.end());
  }
  row.seed = study_.replicates.count == 0 ? nominal_scenario_.seed : points_.seed(row.replicate);
  return row;
}

void Plan::finish(Row& row, const Scenario& scenario, const Recording& recording, const Measure& measure) const {
  row.simulated = recording.simulated;
  if (recording.outcome != "done") {
    // As SimulationError says it: of numbers that were left, or of a plugin that threw; or by a rule of the study.
    row.outcome = recording.outcome.starts_with("diverged") ? "diverged"
                  : StopRules::ended(recording.outcome)     ? "stopped"
                                                            : "plugin";
    row.message = recording.outcome;
    row.verdict = "failed";
    return;
  }
  Judged judged = measure(scenario, recording);
  row.outcome = "done";
  row.figures = std::move(judged.figures);
  row.verdict = std::move(judged.verdict);
  row.score = judge_->score(scenario, row.figures);
}

std::string Plan::definition() const {
  std::string text = fmt::format("seed: {}\nmethod: {}\n", study_.seed,
                                 study_.asked ? "asked" : kMethods[static_cast<std::size_t>(study_.method)]);
  if (!study_.asked && is_search(study_.method)) text += search_text(study_);
  for (const Parameter& p : study_.parameters)
    text += fmt::format("parameter {}: {}\n", p.key,
                        p.values.empty() ? number_range(p) : fmt::format("{}", fmt::join(p.values, ", ")));
  if (study_.replicates.count > 0) {
    text += fmt::format("replicates: {}, {}", study_.replicates.count,
                        kCombines[static_cast<std::size_t>(study_.replicates.combine)]);
    if (study_.replicates.combine == Combine::quantile) text += " " + number_text(study_.replicates.quantile);
    text += "\n";
  }
  for (const Variation& v : study_.replicates.vary) text += fmt::format("vary {}: {}\n", v.key, law_text(v));
  for (std::size_t k = 0; k < study_.objectives.size(); ++k)
    text += fmt::format("{}: {}\n", study_.objectives[k].maximize ? "maximize" : "minimize", judge_->objectives()[k]);
  for (const Limit& limit : judge_->limits()) text += fmt::format("{}: {}\n", limit.guard ? "guard" : "constraint", limit.text);
  for (const std::string& stop : stops_->texts()) text += "stop: " + stop + "\n";
  std::string columns;
  for (const FigureName& column : columns_) columns += column.name + "\n";
  for (const FigureName& column : columns_) {
    if (column.name.ends_with("]")) text += "figure: " + column.name + "\n";
  }
  return text + "figures: " + digest(columns) + "\n";
}

JournalHead Plan::head() const {
  JournalHead head;
  head.name = study_.name;
  head.definition = definition();
  head.scenario = scenario_text_;
  for (std::size_t k = 0; k < study_.objectives.size(); ++k)
    head.objectives.push_back({judge_->objectives()[k], study_.objectives[k].maximize});
  head.combine = kCombines[static_cast<std::size_t>(study_.replicates.combine)];
  head.quantile = study_.replicates.quantile;
  head.runs = most_runs();
  head.replicates = points_.replicates();
  head.seed = study_.seed;
  for (const Parameter& p : study_.parameters)
    head.parameters.push_back({p.key, p.words, false, p.low, p.high, p.log, p.values});
  for (const Variation& v : study_.replicates.vary) head.parameters.push_back({v.key, v.words, true, 0, 0, false, v.values});
  head.figures = columns_;
  for (const std::size_t column : shown_) head.shown.push_back(columns_[column].name);
  head.limits = judge_->limits();
  head.guarded = study_.guarded;
  return head;
}

}  // namespace gaitlab::studies
