#include "report/verdict/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "core/robot_files/type_presets.h"
#include "core/settings/wording.h"
#include "report/analysis/plugin_names.h"
#include "report/verdict/checks/checked_run.h"
#include "report/verdict/draws.h"
#include "report/verdict/instability.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/rolled.h"
#include "report/verdict/spread.h"

namespace gaitlab::report {

namespace {

constexpr const char* kRowsAlone =
    "only the rows of the trace are left, which miss the peaks between them; gaitlab rerun evaluates every step";

/// Key that orders failing checks. Checks of the robot as a whole come first, because a fallen robot has no gait; then the
/// check with the least margin.
std::pair<bool, double> urgency(const Check& check) {
  return {check.group != CheckGroup::run, std::isnan(check.margin) ? -std::numeric_limits<double>::infinity() : check.margin};
}

/// The first check, in the order of urgency(), for which `counts` is true, or nullptr.
template <class Counts>
const Check* worst_of(const std::vector<Check>& checks, const Counts& counts) {
  const Check* found = nullptr;
  for (const Check& check : checks) {
    if (counts(check) && (found == nullptr || urgency(check) < urgency(*found))) found = &check;
  }
  return found;
}

bool fails(const Check& check) { return check.status == CheckStatus::fail; }
bool too_close(const Check& check) { return check.status == CheckStatus::too_close; }

/// Changes the status to `too close` if the motion is unpredictable and the check fails in some of the equally valid rollouts
/// but not in all, or cannot be judged in one (which diverged or fell).
void take_spread(const Trace& spread, Check& made) {
  const std::size_t column = spread.find(margin_column(made.id));
  const bool judged = made.status != CheckStatus::not_judged && made.can_fail;
  if (!judged || spread.rows() == 0 || column == spread.columns.size() || std::isnan(spread.at(0, column))) return;
  std::size_t without = 0;
  for (std::size_t row = 0; row < spread.rows(); ++row) without += std::isnan(spread.at(row, column)) ? 1 : 0;
  const std::optional<Between> margins = between(spread, margin_column(made.id));
  if (without == 0 && (!margins || !(margins->low < 0 && margins->high >= 0))) return;
  made.status = CheckStatus::too_close;
  made.text += fmt::format("; the motion is not predictable: in {} rollouts that differ by next to nothing, ", spread.rows());
  made.text += without > 0 ? fmt::format("this check cannot judge {} of them", without)
                           : fmt::format("the margin is {} to {}", texts::percent(margins->low), texts::percent(margins->high));
  made.remedy = "judge several runs with other seeds or starts";
}

/// Reason why the verdict is `not judged`, with or without failing checks; ReasonCode::none if there is none.
Reason not_judged(const CheckedRun& run, const std::vector<Check>& checks) {
  const Evidence& found = run.evidence;
  const Check* const failing = worst_of(checks, fails);
  if (const std::vector<const Lack*> lacks = found.lacks(); !lacks.empty()) {
    std::string text = lacks.front()->sentence();
    for (std::size_t k = 1; k < lacks.size(); ++k) text += "; and " + lacks[k]->sentence();
    if (failing == nullptr) return {ReasonCode::lacks, text};
    return {ReasonCode::lacks, text + "; so far: " + failing->sentence(), failing->id};
  }
  if (const Check* const close = worst_of(checks, too_close)) return {ReasonCode::too_close, close->text, close->id};
  const auto judged = [](const Check& c) { return c.status != CheckStatus::not_judged; };
  if (std::ranges::none_of(checks, [&](const Check& c) { return c.group == CheckGroup::motor && judged(c); })) {
    return run.driven() ? Reason{ReasonCode::no_limit, "no limit of the motors is known"}
                        : Reason{ReasonCode::not_driven, "nothing drives the joints"};
  }
  if (run.scenario.base != Base::floating || !run.scenario.ground.exists() || run.scenario.contact.model().keeps_bodies_apart)
    return {};
  for (const Check& check : checks) {
    if ((check.id == "fall" || check.id == "in_ground") && !judged(check))
      return {ReasonCode::open, check.id + " was not judged: " + check.text, check.id};
  }
  return {};
}

/// Sets Verdict::retry to the settings that supply all missing evidence, or decide the check that is too close.
void take_retry(const Evidence& evidence, Verdict& made) {
  const std::vector<const Lack*> lacks = evidence.lacks();
  if (std::ranges::any_of(lacks, [](const Lack* lack) { return lack->set.empty(); })) return;
  for (const Lack* const lack : lacks) made.retry.push_back(lack->set);
  const Check* const close = lacks.empty() ? worst_of(made.checks, too_close) : nullptr;
  if (close != nullptr && !close->retry.empty()) made.retry.push_back(close->retry);
  made.retry_is_finer = !made.retry.empty() && evidence.not_shown.empty() && evidence.not_borne.empty();
}

void decide(const CheckedRun& run, Verdict& made) {
  const Evidence& found = run.evidence;
  made.conditions = found.conditions;
  made.rests_on = found.rests_on + (made.conditions.empty() ? "" : "; " + made.conditions);
  const auto decides = [&](const Check& check) {
    return fails(check) && (found.not_shown.empty() || check.span == CheckSpan::whole_run) &&
           (found.not_trusted.empty() || (found.inexact && check.certain));
  };
  if (run.record.rows_alone()) {
    made.word = Word::not_judged;
    made.reason = {ReasonCode::rows_alone, kRowsAlone};
  } else if (made.checks.front().status == CheckStatus::fail) {
    made.word = Word::failed;
    made.decided_by = worst_of(made.checks, fails)->id;
  } else if (!found.not_possible.empty()) {
    made.word = Word::not_judged;
    made.reason = {ReasonCode::impossible, found.not_possible.sentence()};
  } else if (const Check* const deciding = worst_of(made.checks, decides); deciding != nullptr) {
    made.word = Word::infeasible;
    made.decided_by = deciding->id;
    if (found.inexact) {
      made.checks[static_cast<std::size_t>(deciding - made.checks.data())].text +=
          fmt::format("; this is certain, although torques are off by up to about {}",
                      texts::rough_percent(torque_error(run.record).share));
    }
  } else if (made.reason = not_judged(run, made.checks); made.reason.code != ReasonCode::none) {
    made.word = Word::not_judged;
    take_retry(found, made);
  } else {
    made.word = Word::feasible;
  }
}

}  // namespace

std::size_t Verdict::count(CheckStatus status) const {
  const auto counts = [&](const Check& check) { return check.concerns && check.status == status; };
  return static_cast<std::size_t>(std::ranges::count_if(checks, counts));
}

std::vector<const Check*> Verdict::failures() const {
  std::vector<const Check*> found;
  for (const Check& check : checks) {
    if (fails(check)) found.push_back(&check);
  }
  std::ranges::stable_sort(found, {}, [&](const Check* check) { return std::pair(check->id != decided_by, urgency(*check)); });
  return found;
}

const Check* Verdict::tightest() const {
  const Check* found = nullptr;
  for (const Check& check : checks) {
    if (!check.can_fail || std::isnan(check.margin) || (check.limit == 0 && check.status != CheckStatus::fail)) continue;
    if (found == nullptr || check.margin < found->margin) found = &check;
  }
  return found;
}

double Criterion::margin(double other_limit) const {
  const double room = least ? value - other_limit : other_limit - value;
  return other_limit == 0 ? room : room / std::abs(other_limit);
}

double Check::margin_of(double other) const {
  if (criteria.empty()) return std::isnan(margin) ? margin : Criterion{value, other, unit, least}.margin();
  double smallest = criteria.front().margin(other);
  for (std::size_t k = 1; k < criteria.size(); ++k) smallest = std::min(smallest, criteria[k].margin());
  return smallest;
}

std::string Check::sentence() const {
  constexpr double kInstant = 0.1;  // s
  const bool instant = part != Part::none && status != CheckStatus::pass && to - from < kInstant;
  return text + (instant ? fmt::format(", at {:.2f} s", from) : "") + (missing.empty() ? "" : "; missing: " + missing);
}

std::string Verdict::why() const {
  if (!unstable.empty()) return unstable;
  if (word == Word::not_judged) return reason.text;
  const auto decisive = std::ranges::find(checks, decided_by, &Check::id);
  if (decisive == checks.end()) return "";
  const bool by_friction = word == Word::infeasible && without_friction == Word::feasible;
  return decisive->sentence() + (by_friction ? ", with the friction chosen; feasible without" : "");
}

namespace {

/// `WHAT leaves out A, B, C and 2 more`; empty without names.
std::string left_out(const char* what, std::vector<std::string> names) {
  constexpr std::size_t kMost = 3;
  if (names.empty()) return "";
  const std::size_t more = names.size() > kMost ? names.size() - kMost : 0;
  names.resize(names.size() - more);
  return fmt::format("{} leaves out {}{}", what, fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

/// Sentence on parts that the checks of overlaps leave out, for the line `rests on`: `may_overlap leaves out m0/trunk and
/// m1/leg`, `shape: [] leaves out dog/hip`. Empty if there is nothing.
std::string left_out_sentence(const Scenario& scenario) {
  std::vector<std::string> pairs, bare;
  for (const ModuleType& type : scenario.robot->types) {
    for (const BodyPair& pair : type.may_overlap)
      pairs.push_back(fmt::format("{0}/{1} and {0}/{2}", type.name, pair.first, pair.second));
    for (const BodyType& body : type.bodies) {
      if (body.bare) bare.push_back(fmt::format("{}/{}", type.name, body.name));
    }
  }
  for (const BodyPair& pair : scenario.may_overlap) pairs.push_back(fmt::format("{} and {}", pair.first, pair.second));
  const std::string of_pairs = left_out("may_overlap", std::move(pairs));
  const std::string of_bare = left_out("shape: []", std::move(bare));
  return of_pairs + (of_pairs.empty() || of_bare.empty() ? "" : "; ") + of_bare;
}

/// Sentence on the sources of motors and docks, `motors: identified from 8 logs (held-out MAE 43.6 mrad)`. A run beyond the
/// logs is named.
std::string motor_figures(const CheckedRun& run, const Verdict& made, std::vector<std::string> motors,
                          const std::vector<std::string>& docks) {
  std::vector<std::string> identified;
  bool all = true;
  for (std::size_t j = 0; j < run.identifications.size(); ++j) {
    const Identification& one = run.identifications[j];
    if (!run.scenario.robot->joints[j].driven()) continue;
    all = all && one.any();
    if (std::string text = short_text(one); one.any() && std::ranges::count(identified, text) == 0)
      identified.push_back(std::move(text));
  }
  const auto check = std::ranges::find(made.checks, "identified", &Check::id);
  if (!identified.empty() && check->status == CheckStatus::warn) identified.back() += ", which this run exceeds";
  if (!motors.empty() && !identified.empty() && !all && std::ranges::none_of(motors, chosen)) {
    const TypePresets types(Kind::actuator, run.scenario.robot.get(), *run.scenario.module_documents);
    motors = types.sources(*run.scenario.actuator.entry, {}, true);
  }
  return figures_sentence(motors, docks, identified, all);
}

/// Changes `pass` to `not judged` in all checks, because checks pass by chance if the controller is unstable.
void leave_passes_out(Verdict& made) {
  for (Check& check : made.checks) {
    if (check.status != CheckStatus::pass) continue;
    check.status = CheckStatus::not_judged;
    check.margin = Check::kNone;
    check.text = "the controller is unstable";
  }
}

}  // namespace

Check judged_check(const CheckKind& kind, const CheckedRun& run) {
  Check check{.id = kind.id,
              .group = kind.group,
              .title = kind.title,
              .concerns = kind.concerns == nullptr || kind.concerns(run.scenario),
              .span = kind.span,
              .can_fail = kind.can_fail(),
              .least = kind.least,
              .unit = kind.unit,
              .definition = kind.definition,
              .place = run.scenario.nearest_place(kind.key)};
  if (run.record.rows_alone()) {
    check.text = kRowsAlone;
    return check;
  }
  kind.judge(run, check);
  take_spread(run.record.spread, check);
  if (check.criteria.empty()) check.margin = Criterion{check.value, check.limit, check.unit, check.least}.margin();
  if (check.status == CheckStatus::not_judged || check.id == "outcome" || (kind.can_fail() && !check.can_fail))
    check.margin = Check::kNone;
  check.text = without_folders(std::move(check.text), run.scenario);
  return check;
}

Verdict verdict(const Scenario& scenario, const Recording& record, const Summary& summary, const Overlaps& overlaps) {
  const CheckedRun run{scenario, record, summary, overlaps};
  Verdict made;
  std::vector<std::string> motors;  // sources of the values that checks use
  std::vector<std::string> docks;
  made.from = summary.judged.from;
  made.to = summary.judged.to;
  for (const CheckKind& kind : check_kinds()) {
    Check check = judged_check(kind, run);
    const bool judged = check.status != CheckStatus::not_judged;
    if (judged && check.group == CheckGroup::motor) motors = {run.motor_source};
    if (judged && check.id.starts_with("dock_")) docks.push_back(check.source);
    made.checks.push_back(std::move(check));
  }
  made.chosen_motors = std::ranges::any_of(motors, chosen);
  made.chosen_docks = std::ranges::any_of(docks, chosen);
  made.figures = motor_figures(run, made, motors, docks);
  // A stiffer ground leaves speeds as they are, but an impact bends docks by half as much again.
  if (!docks.empty() && scenario.ground.exists() && scenario.contact.model().penalty_settings)
    made.figures += fmt::format(", and at impacts contact.stiffness {}", number_text(scenario.contact.penalty.kn));
  if (const std::string left_out = left_out_sentence(scenario); !left_out.empty())
    made.figures += (made.figures.empty() ? "" : "; ") + left_out;
  for (const FaultSpan& fault : run.faults) {
    if (fault.from >= record.simulated) continue;
    const std::string until = std::isfinite(fault.to) ? fmt::format(" to {:.4g} s", fault.to) : "";
    const char* const by = fault.to > made.from ? "" : " by checks of the whole run";
    made.faults.push_back(fmt::format("{}: not judged{} ({} from t = {:.4g} s{})", run.joint(fault.joint), by,
                                      name_of(fault.kind), fault.from, until));
  }
  decide(run, made);
  if (made.word != Word::feasible) made.unstable = instability(scenario, record);
  if (!made.unstable.empty()) leave_passes_out(made);
  made.draws = draws_of(record, scenario);
  made.draws_text = draws_text(made.draws, scenario.drawn > 0 || scenario.tolerances.any());
  if (const std::vector<JudgedJoint>& whole = summary.judged.whole; Judged::limited(whole) > 0) {
    made.first_joint = run.joint(Judged::first(whole));
    made.first_time = whole[Judged::first(whole)].first_limit_time;
  }
  return made;
}

}  // namespace gaitlab::report
