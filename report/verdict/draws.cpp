#include "report/verdict/draws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "core/scenario/as_built.h"
#include "core/scenario/sections.h"
#include "report/analysis/collisions.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

namespace {

constexpr const char* kAfter = "after";
constexpr const char* kWord = "verdict";
constexpr double kMostDraws = 1e6;  // a larger number is from a damaged file

std::string fails_column(const std::string& check) { return "fails." + check; }
std::string part_column(const std::string& check) { return "part." + check; }

/// Names that Check::worst can have. The table of draws refers to them by index.
std::vector<std::string> part_names(const Robot& robot) {
  std::vector<std::string> names = joint_names(robot);
  for (const Body& body : robot.bodies) names.push_back(body.name);
  std::ranges::move(module_names(robot), std::back_inserter(names));
  return names;
}

std::vector<Column> draw_columns() {
  std::vector<Column> columns{{kAfter, "", "seed of the draw, minus the seed of the run"},
                              {kWord, "", "index of the verdict's word"}};
  std::ranges::move(rolled_columns(), std::back_inserter(columns));
  for (const CheckKind& kind : check_kinds()) {
    columns.push_back({fails_column(kind.id), "", "1 if the check fails"});
    columns.push_back({part_column(kind.id), "", "index of the part with the least margin"});
  }
  return columns;
}

/// Row of draw_columns().
std::vector<double> draw_row(std::size_t after, const Rolled& run, const std::vector<std::string>& parts) {
  std::vector<double> row{static_cast<double>(after), static_cast<double>(run.verdict.word)};
  std::ranges::copy(rolled_row(run), std::back_inserter(row));
  for (const Check& check : run.verdict.checks) {
    const auto part = std::ranges::find(parts, check.worst);
    row.push_back(check.status == CheckStatus::fail ? 1 : 0);
    row.push_back(part == parts.end() ? std::nan("") : static_cast<double>(part - parts.begin()));
  }
  return row;
}

/// Entry of a list by an index from a file; nothing for an index that is not valid.
template <class List>
auto entry(const List& list, double index) -> std::optional<std::decay_t<decltype(list[0])>> {
  if (!(index >= 0 && index < static_cast<double>(std::size(list)))) return {};
  return list[static_cast<std::size_t>(index)];
}

/// True if the torque errors of this run, and of similar ones, hardly matter for the verdict.
bool accurate(const Scenario& scenario, const Recording& record) {
  constexpr double kSmall = 0.2;  // share of the limit
  const TorqueError error = torque_error(record);
  return error.estimated && error.share < kSmall * scenario.limits.most_torque_error() &&
         predictability(scenario, record) == Predictability::predictable;
}

}  // namespace

Drawn draws(const Scenario& scenario, const Rolled& run, std::span<const Scenario> others, const BatchSettings& settings,
            std::atomic<bool>& stop, const std::function<void()>& ended) {
  const std::vector<std::string> parts = part_names(*scenario.robot);
  std::vector<Scenario> drawn(others.begin(), others.end());
  const bool shared = accurate(scenario, run.record);
  for (Scenario& one : drawn) {
    if (!shared) continue;
    one.physics.estimate = Estimate::off;
    one.physics.estimated_by_others = true;
  }
  // Each rollout is judged as it ends, so that few recordings exist at a time.
  std::vector<std::vector<double>> rows(1 + others.size());
  std::vector<std::string> refused(others.size());
  rows[0] = draw_row(0, run, parts);
  const auto judge = [&](std::size_t k, RolloutEnd&& end) {
    if (!end.refused.empty()) {
      refused[k] = fmt::format("seed {}: {}", drawn[k].seed, end.refused.front().text);
      end.recording.outcome = {Ended::diverged, refused[k]};
    }
    const Summary summary = summarise(drawn[k], end.recording, 0);
    const Verdict judged = verdict(drawn[k], end.recording, summary, overlaps(drawn[k], end.recording));
    rows[k + 1] = draw_row(k + 1, {end.recording, summary, judged}, parts);
    if (ended) ended();
  };
  run_all(drawn, settings, kVerdictReads, stop, judge);
  Drawn made;
  made.table.columns = draw_columns();
  for (const std::vector<double>& row : rows) made.table.values.insert(made.table.values.end(), row.begin(), row.end());
  std::erase(refused, "");
  made.refused = std::move(refused);
  return made;
}

std::vector<Draw> draws_of(const Recording& record, const Scenario& scenario) {
  const Trace& table = record.draws;
  const std::vector<std::string> parts = part_names(*scenario.robot);
  std::vector<Draw> all;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto value = [&](const std::string& column) {
      const std::size_t at = table.find(column);
      return at == table.columns.size() ? std::nan("") : table.at(row, at);
    };
    const auto word = entry(EnumNames<Word>::kTable, value(kWord));
    const double after = value(kAfter);
    const std::int64_t seed = scenario.seed + (after >= 0 && after < kMostDraws ? static_cast<std::int64_t>(after) : 0);
    Draw one{seed,
             word ? word->value : Word::not_judged,
             value("torque_peak"),
             value("torque_rms"),
             value("distance"),
             value(kLeastMargin)};
    for (const CheckKind& kind : check_kinds()) {
      if (value(fails_column(kind.id)) != 1) continue;
      one.failing.push_back({kind.id, entry(parts, value(part_column(kind.id))).value_or("")});
    }
    all.push_back(std::move(one));
  }
  return all;
}

std::string draws_text(std::span<const Draw> draws, bool robots) {
  if (draws.empty()) return "";
  const auto of = [&](Word word) { return std::ranges::count(draws, word, &Draw::word); };
  std::string text = fmt::format("feasible in {} of {} {}", of(Word::feasible), draws.size(), robots ? "robots" : "draws");
  for (const Word word : {Word::not_judged, Word::failed}) {
    if (of(word) > 0) text += fmt::format("; {} in {}", name_of(word), of(word));
  }
  struct Failure {
    std::size_t count = 0;
    std::vector<std::string> parts = {};
  };
  std::map<std::string, Failure> failures;
  for (const Draw& draw : draws) {
    for (const FailedCheck& failed : draw.failing) {
      Failure& failure = failures[failed.check];
      ++failure.count;
      if (!failed.part.empty() && std::ranges::find(failure.parts, failed.part) == failure.parts.end())
        failure.parts.push_back(failed.part);
    }
  }
  std::vector<std::pair<std::string, Failure>> ordered(failures.begin(), failures.end());
  std::ranges::stable_sort(ordered, std::greater{}, [](const auto& one) { return one.second.count; });
  constexpr std::size_t kFew = 3;
  for (const auto& [check, failure] : ordered) {
    const std::size_t shown = std::min(failure.parts.size(), kFew);
    text += fmt::format("; {} fails in {}", texts::spaced(check), failure.count);
    if (shown > 0) {
      text += fmt::format(" ({}{})",
                          fmt::join(failure.parts.begin(), failure.parts.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                          failure.parts.size() > shown ? " ..." : "");
    }
  }
  return text;
}

std::string draws_table(std::span<const Draw> draws, std::size_t most) {
  std::string text = fmt::format("  {:>10}  {:<10}  {:>11}  {:>10}  {:>9}  {:>8}  fails\n", "seed", "verdict", "torque, N m",
                                 "RMS, N m", "travel, m", "margin");
  std::size_t shown = 0;
  for (const Draw& draw : draws) {
    if (draws.size() > most && (draw.word == Word::feasible || shown == most)) continue;
    ++shown;
    std::string failing;
    for (const FailedCheck& failed : draw.failing) {
      failing +=
          (failing.empty() ? "" : ", ") + texts::spaced(failed.check) + (failed.part.empty() ? "" : " of " + failed.part);
    }
    std::string row = fmt::format("  {:>10}  {:<10}  {:>11.3f}  {:>10.3f}  {:>9.4f}  {:>8}  {}", draw.seed, name_of(draw.word),
                                  draw.torque_peak, draw.torque_rms, draw.distance, texts::percent(draw.margin), failing);
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  if (shown < draws.size()) text += fmt::format("  and {} more (verdict.json)\n", draws.size() - shown);
  return text;
}

}  // namespace gaitlab::report
