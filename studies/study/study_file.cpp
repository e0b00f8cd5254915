#include "studies/study/study_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "core/files/atomic_file.h"
#include "core/files/file_kind.h"
#include "core/settings/explainer.h"
#include "core/settings/file_of_name.h"
#include "core/settings/reader.h"
#include "core/settings/shipped_files.h"
#include "core/settings/text_file.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"
#include "studies/study/guards.h"
#include "studies/study/parameter_file.h"
#include "studies/study/population.h"
#include "studies/study/study_keys.h"

namespace gaitlab::studies {

namespace {

/// File of a scenario that a study names: a file relative to the study's folder, or a shipped scenario by its name.
std::string scenario_file(const Node& node, Study& study) {
  const std::string folder = std::filesystem::path(study.file).parent_path().string();
  const std::map<std::string, std::string> shipped = shipped_files("scenario");
  const auto known = shipped.find(node.text);
  FileOfName file{path_from(folder, node.text)};
  if (known != shipped.end()) file = file_of_name({file.path}, known->second).value_or(file);
  if (std::string hidden = note_of_hidden(node.text, file); !hidden.empty())
    study.notes.push_back({node.place, std::move(hidden)});
  return file.path;
}

/// Reads named scenarios, as in {flat: a.yaml, rubble: b.yaml}. Their paths are relative to the study's folder.
void read_named_scenarios(const Node& node, Study& study, Problems& problems) {
  constexpr std::size_t kMost = 1000;
  if (node.kind != Node::Kind::map || node.keys.empty() || node.keys.size() > kMost) {
    const std::string what = node.kind != Node::Kind::map ? found(node) : node.keys.empty() ? "empty" : "too long";
    problems.add(node.place, fmt::format("scenarios is {}; expected 1 to {} names with their files: {{flat: flat.yaml, rubble: "
                                         "rubble.yaml}}",
                                         what, kMost));
    return;
  }
  for (std::size_t k = 0; k < node.keys.size(); ++k) {
    const auto& [name, place] = node.keys[k];
    const Node& file = node.items[k];
    if (!is_name(name, "_.-"))
      problems.add(place, "scenario name " + in_quotes(name) + " is not allowed; expected letters, digits, `_`, `.` and `-`");
    if (file.kind != Node::Kind::scalar) {
      problems.add(file.place, "scenario " + clipped(name) + " is " + found(file) + "; expected the name of a file");
    } else {
      study.scenarios.push_back({name, scenario_file(file, study), file.place});
    }
  }
}

void read_objective(const Node& node, Objective& objective, Problems& problems) {
  const std::size_t before = problems.size();
  Reader reader(node, "objective", problems, nullptr);
  if (node.kind != Node::Kind::map) return;
  const Node* most = reader.take("maximize");
  const Node* least = reader.take("minimize");
  reader.finish();
  const Node* chosen = most != nullptr ? most : least;
  if (chosen == nullptr && problems.size() > before) return;  // the misspelt key has already been reported
  if (chosen == nullptr || (most != nullptr && least != nullptr)) {
    problems.add(node.place, "objective is not one expression; expected {maximize: speed} or {minimize: ...}");
  } else if (chosen->kind != Node::Kind::scalar) {
    problems.add(chosen->place, "objective is " + found(*chosen) + "; expected an expression");
  } else {
    objective = {{chosen->text, *chosen}, most != nullptr};
  }
}

/// Reads one objective, as in {maximize: speed}, or a list of up to three.
void read_objectives(const Node& node, std::vector<Objective>& objectives, Problems& problems) {
  if (node.kind != Node::Kind::list) return read_objective(node, objectives.front(), problems);
  if (node.items.empty() || node.items.size() > kMostObjectives)
    problems.add(node.place, fmt::format("objective is a list of {}; expected 1 to {}", node.items.size(), kMostObjectives));
  objectives.assign(std::clamp<std::size_t>(node.items.size(), 1, kMostObjectives), {});
  for (std::size_t k = 0; k < std::min(objectives.size(), node.items.size()); ++k)
    read_objective(node.items[k], objectives[k], problems);
}

void read_constraints(const Node& node, Study& study, Problems& problems) {
  if (node.kind != Node::Kind::list) problems.add(node.place, "constraints is " + found(node) + "; expected a list of texts");
  for (const Node& item : node.items) {
    if (node.kind != Node::Kind::list) return;
    if (item.kind != Node::Kind::scalar) {
      problems.add(item.place, "a constraint is " + found(item) + "; expected a text: torque.rms <= 0.6");
    } else {
      study.constraints.push_back({item.text, item});
    }
  }
}

/// Reads `none`, or a list of stop rules, each an expression or `hopeless`, optionally followed by ` after SECONDS`.
void read_stops(const Node& node, Study& study, Problems& problems) {
  if (node.kind == Node::Kind::scalar && node.text == "none") return;
  if (node.kind != Node::Kind::list) problems.add(node.place, "stop is " + found(node) + "; expected a list of texts, or none");
  for (const Node& item : node.items) {
    if (node.kind != Node::Kind::list) return;
    if (item.kind != Node::Kind::scalar) {
      problems.add(item.place, "a rule is " + found(item) + "; expected a text: saturated.voltage > 0.3 after 4");
      continue;
    }
    StopText stop{{item.text, item}};
    constexpr std::string_view kAfter = " after ";
    if (const std::size_t at = item.text.rfind(kAfter); at != std::string::npos) {
      const std::string seconds = item.text.substr(at + kAfter.size());
      const char* end = seconds.data() + seconds.size();
      const auto read = std::from_chars(seconds.data(), end, stop.after);
      if (read.ec != std::errc() || read.ptr != end || !(stop.after >= 0) || !std::isfinite(stop.after)) {
        problems.add(item.place,
                     "a rule ends with after " + in_quotes(seconds) + "; expected a number of seconds: fell after 2");
      }
      stop.when.text.resize(at);
    }
    study.stops.push_back(std::move(stop));
  }
}

Explainer study_keys() {
  Explainer explainer;
  Study study;
  std::string scenario;
  explainer.row("gaitlab_study", "", "1", "1", "Format version; this key marks a file as a study.");
  PlainKeys{study, scenario}.fields(explainer);
  explainer.row(
      "scenarios", "", "", "{NAME: FILE, ...}",
      "Several scenarios instead of `scenario`: every point runs in each of them, in separate rows; `combine` of `replicates` "
      "sets how their results are combined.");
  explainer.row("parameters", "", "required", "", "Keys of the scenario, as for --set, that change from point to point.");
  explainer.row("  KEY.low", "", "", "", "Least value, in the unit of the scenario's key.");
  explainer.row("  KEY.high", "", "", "above low", "Largest value.");
  explainer.row("  KEY.scale", "", "linear", "linear or log",
                "Spacing of the values: even (linear), or even in their logarithm (log).");
  explainer.row("  KEY.count", "", "", "2 to 1e9", "Number of values of a grid from low to high, both included.");
  explainer.row("  KEY.values", "", "", "", "List of numbers or words, instead of low and high.");
  explainer.row(
      "  KEY.sets", "", "none", "{KEY: EXPRESSION, ...}",
      "KEY is a parameter of the study, and these keys of the scenario are computed from it: legs: {low: 0, high: 1, sets: "
      "{cpg.offset: 0.3*legs - 0.1}}. Expressions can use all parameters that are numbers.");
  explainer.row("replicates", "", "none", "",
                "Runs of each point that differ in their seed and in the values that `vary` draws; the draws are the same for "
                "every point.");
  explainer.row("  count", "", "required", "1 to 1e6", "Runs of each point.");
  explainer.row("  vary.KEY", "", "", "normal: [MEAN, DEVIATION] (with low, high), uniform: [LOW, HIGH], values: [...]",
                "Distribution of the values of a scenario key; {times: LAW}: distribution of a factor on the point's value.");
  explainer.row("  combine", "", "worst", "mean, worst, median, quantile(Q) or share(Q)",
                "Combination of the replicates of a point, in all its scenarios, into one value.");
  explainer.row("objective", "", "{maximize: QUANTITY}", "{maximize: EXPRESSION} or {minimize: EXPRESSION}",
                "Order of the points; default: by the first of `quantities`. A list of two or three: the Pareto front, the "
                "points that no other point beats in all objectives.");
  explainer.row("constraints", "", "[]", "texts: `a <= b`, `a >= b` or `a == b`", "Conditions that a point must satisfy.");
  explainer.row("guards", "", "verdict", "verdict, none or {CHECK: LIMIT, CHECK: {margin: M}, CHECK: true or false}",
                "Checks of the verdict that a point must pass. verdict: the verdict must be `feasible`. A map changes this for "
                "single checks, by id: another limit, a least margin, true (required) or false (ignored).");
  explainer.row("stop", "", "[hopeless] in searches", "none or texts: `hopeless`, `EXPRESSION`, `EXPRESSION after SECONDS`",
                "Rules that end a run early, evaluated once every simulated second on quantities of the run so far: `fell`, or "
                "quantities of a joint. `hopeless`: a guard is lost beyond doubt. It is the default of `gaitlab optimize` "
                "and `evaluate` if every run of a point counts (`combine: worst` or `mean`).");
  explainer.row("start", "", "[]", "[{PARAMETER: VALUE, ...}, ...]",
                "Points that a search runs first, after the scenario's own values, which it always runs. A parameter "
                "that is left out has the scenario's value.");
  MethodKeys method{study};
  explainer.group("method", method, "Choice of the points.");
  BudgetKeys budget{study.runs};
  explainer.group("budget", budget, "Number of runs.");
  VerifyKeys verify{study.verify};
  explainer.group("verify", verify, "Verification of the best points by `gaitlab optimize`.");
  return explainer;
}

}  // namespace

bool is_study(const std::string& file) {
  Problems problems;
  const std::string text = read_file(file, kMostScenario);
  const std::optional<Node> root = parse_yaml(text, file, problems);
  // Invalid YAML is later reported by the reader of a study or scenario, as the text suggests.
  if (root && root->find("gaitlab_study") == nullptr && kind_of_text(text) == FileKind::study)
    throw InputError(root->place, "has parameters, but no gaitlab_study: 1, the key that marks a file as a study; add it");
  return root ? root->find("gaitlab_study") != nullptr : text.find("gaitlab_study:") != std::string::npos;
}

namespace {

void check_name(const Study& study, const Node& root, Problems& problems) {
  if (is_name(study.name, "_.-") && study.name[0] != '.') return;
  const Node* name = root.find("name");
  problems.add(name != nullptr ? name->place : root.place,
               "name " + in_quotes(study.name) +
                   " is not allowed; expected letters, digits, `_`, `.` and `-`, but no `.` at "
                   "the start");
}

/// Stores the places of keys for later messages.
void take_places(const Node& root, Study& study) {
  if (const Node* sets = root.find("set")) {
    for (const Node& set : sets->items) study.set_places.push_back(set.place);
  }
  if (const Node* quantities = root.find("quantities")) study.quantities_place = quantities->place;
  if (const Node* node = root.find("verify")) {
    const Node* engine = node->kind == Node::Kind::map ? node->find("engine") : nullptr;
    study.verify.place = engine != nullptr ? engine->place : node->place;
  }
}

/// Selects the method if the study names none, or if another program chooses the points.
void choose_method(Study& study, bool named, Purpose purpose) {
  const bool grid = std::ranges::all_of(study.parameters, &Parameter::in_grid);
  constexpr std::size_t kMostParameters = 10;
  constexpr std::uint64_t kMostPoints = 2000;
  const std::uint64_t points = static_cast<std::uint64_t>(study.runs) / study.runs_of_point();
  const bool few = dimensions(study) <= kMostParameters && points <= kMostPoints;
  const Method search = study.objectives.size() > 1 ? Method::nsga2 : few ? Method::scbo : Method::cma_gp;
  if (!named && !(grid && purpose == Purpose::sweep)) study.method = purpose == Purpose::optimize ? search : Method::random;
  if (study.asked) study.method = Method::random;  // no method is used
}

/// Replicates of a robust study: the nominal run, and the worlds of a dc_motor. The bound study counts the worlds that apply.
Replicates in_worlds() {
  constexpr std::int64_t kUsual = 17;
  constexpr double kShare = 0.75;  // share of runs that must break no limit, so that the lower quartile of margins is limited
  return {.count = kUsual, .vary = {}, .combine = Combine::robust, .quantile = kShare};
}

/// Reads the rules that stop runs. Without them, a hopeless run of a search ends early if it decides about its point alone.
void read_stops(Reader& reader, const Node& root, Purpose purpose, Study& study, Problems& problems) {
  if (const Node* node = reader.take("stop")) return read_stops(*node, study, problems);
  if (purpose == Purpose::sweep || !study.replicates.every_run_counts()) return;
  study.stops.push_back({{kHopeless, Node{Node::Kind::scalar, root.place, kHopeless}}, 0});
}

/// Reads `scenario` and `scenarios`.
void read_scenario_keys(Reader& reader, const Node& root, Study& study, Problems& problems) {
  const Node* one = root.find("scenario");
  if (one != nullptr && one->kind == Node::Kind::scalar && !one->text.empty()) {
    study.scenario = scenario_file(*one, study);
    study.scenario_place = one->place;
  }
  const Node* node = reader.take("scenarios");
  if (node == nullptr) return;
  read_named_scenarios(*node, study, problems);
  if (reader.has("scenario")) problems.add(node->place, "the study has `scenario` and `scenarios`; expected one of them");
}

/// Reads the replicates, which a robust study sets itself.
void read_worlds(Reader& reader, Study& study, Problems& problems) {
  if (const Node* node = reader.take("replicates")) {
    read_replicates(*node, study.replicates, problems);
    if (study.robust) {
      problems.add(
          node->place,
          "`robust: true` makes the worlds of a point its replicates, but `replicates` is also given; expected one of them");
    }
  }
  if (study.robust) study.replicates = in_worlds();
}

}  // namespace

Study read_study(const std::string& file, Purpose purpose) {
  Study study;
  study.asked = purpose == Purpose::evaluate;
  study.file = file;
  expect_kind(file, FileKind::study);
  const Node root = read_yaml(file);
  Problems problems;
  Reader reader(root, "the study", problems, nullptr);
  if (!reader.version("gaitlab_study")) problems.raise();
  std::string scenario;
  study.name = std::filesystem::path(file).stem().string();
  study.place = root.place;
  PlainKeys{study, scenario}.fields(reader);
  check_name(study, root, problems);
  take_places(root, study);
  read_scenario_keys(reader, root, study, problems);
  MethodKeys method{study};
  const Node* chosen = root.find("method");
  const bool named = chosen != nullptr && chosen->find("type") != nullptr;
  reader.group("method", method, "");
  BudgetKeys budget{study.runs};
  reader.group("budget", budget, "");
  VerifyKeys verify{study.verify};
  reader.group("verify", verify, "");
  if (const Node* node = reader.take("parameters")) read_parameters(*node, study, problems);
  read_worlds(reader, study, problems);
  if (const Node* node = reader.take("objective")) read_objectives(*node, study.objectives, problems);
  if (const Node* node = reader.take("constraints")) read_constraints(*node, study, problems);
  if (const Node* node = reader.take("guards")) read_guards(*node, study, problems);
  read_stops(reader, root, purpose, study, problems);
  if (const Node* node = reader.take("start")) read_starts(*node, study, problems);
  if (!reader.has("scenarios")) reader.require({"scenario"});
  reader.require({"parameters"});
  reader.finish();
  choose_method(study, named, purpose);
  if (problems.empty()) check_study(study, problems);
  problems.raise();
  return study;
}

std::string explain_study() {
  return wrapped(
             "A study runs the points of a scenario: `gaitlab sweep STUDY.yaml`; `gaitlab optimize STUDY.yaml` searches the "
             "best. Expressions name quantities as summary.json does, with dots; of a quantity per joint, torque.peak is the "
             "largest over the joints and torque.peak[m3/active] that of one joint. They take + - * / ^, "
             "comparisons, and, or, not, min, max, abs, sqrt, log, if and the other functions of CPG `equations`.") +
         "\n" + table(study_keys().rows());
}

std::string study_page() {
  return "# The file of a study\n\n"
         "<!-- Written by `tests/gates/reference.sh build/release --renew`; CI fails where it is stale. -->\n\n"
         "All keys of the file that `gaitlab sweep STUDY.yaml` and `gaitlab optimize STUDY.yaml` read, as `gaitlab explain "
         "study` prints them. Their use:\n"
         "[studies](../studies.md). Studies that come with the program: `scenarios/studies/`.\n\n" +
         markdown_table(study_keys().rows());
}

}  // namespace gaitlab::studies
