#include "report/verdict/draws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "core/scenario/as_built.h"
#include "core/scenario/sections.h"
#include "core/scenario/sensor_section.h"
#include "report/analysis/collisions.h"
#include "report/verdict/number_texts.h"

namespace gaitlab::report {

namespace {

constexpr const char* kSeed = "seed";
constexpr const char* kWord = "verdict";

std::string fails_column(const std::string& check) { return "fails." + check; }
std::string part_column(const std::string& check) { return "part." + check; }

/// Names that Check::worst can have, by which a table of numbers refers to them.
std::vector<std::string> part_names(const Robot& robot) {
  std::vector<std::string> names = joint_names(robot);
  for (const Body& body : robot.bodies) names.push_back(body.name);
  std::ranges::move(module_names(robot), std::back_inserter(names));
  return names;
}

std::vector<Column> draw_columns() {
  std::vector<Column> columns{{kSeed, "", "seed of the draw"}, {kWord, "", "index of the verdict's word"}};
  std::ranges::move(rolled_columns(), std::back_inserter(columns));
  for (const CheckKind& kind : check_kinds()) {
    columns.push_back({fails_column(kind.id), "", "1 if the check fails"});
    columns.push_back({part_column(kind.id), "", "index of the part with the least margin"});
  }
  return columns;
}

/// Row of draw_columns().
std::vector<double> draw_row(const Scenario& scenario, const Rolled& run, const std::vector<std::string>& parts) {
  std::vector<double> row{static_cast<double>(scenario.seed), static_cast<double>(run.verdict.word)};
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

std::string spaced(std::string id) {
  std::ranges::replace(id, '_', ' ');
  return id;
}

}  // namespace

bool has_draws(const Scenario& scenario) { return scenario.tolerances.any() || !scenario.sensors.empty(); }

std::optional<Trace> draws(const Scenario& scenario, const Rolled& run, std::span<const Scenario> others,
                           const BatchSettings& settings, std::atomic<bool>& stop) {
  const std::vector<std::string> parts = part_names(*scenario.robot);
  // Each rollout is judged as it ends, so that few recordings exist at a time.
  std::vector<std::vector<double>> rows(1 + others.size());
  std::vector<std::vector<Problem>> refused(others.size());
  rows[0] = draw_row(scenario, run, parts);
  std::vector<Scenario> drawn(others.begin(), others.end());
  for (Scenario& one : drawn) {
    one.physics.estimate = Estimate::off;
    one.physics.estimated_by_others = true;
  }
  const auto judge = [&](std::size_t k, RolloutEnd&& end) {
    refused[k] = std::move(end.refused);
    if (!refused[k].empty()) return;
    const Summary summary = summarise(drawn[k], end.recording, 0);
    const Verdict judged = verdict(drawn[k], end.recording, summary, overlaps(drawn[k], end.recording));
    rows[k + 1] = draw_row(drawn[k], {end.recording, summary, judged}, parts);
  };
  if (!run_all(drawn, settings, kVerdictReads, stop, judge)) return {};
  for (std::vector<Problem>& problems : refused) {
    if (!problems.empty()) throw InputError(std::move(problems));
  }
  Trace made;
  made.columns = draw_columns();
  for (const std::vector<double>& row : rows) made.values.insert(made.values.end(), row.begin(), row.end());
  return made;
}

std::vector<Draw> draws_of(const Recording& record, const Robot& robot) {
  const Trace& table = record.draws;
  const std::vector<std::string> parts = part_names(robot);
  std::vector<Draw> all;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto value = [&](const std::string& column) {
      const std::size_t at = table.find(column);
      return at == table.columns.size() ? std::nan("") : table.at(row, at);
    };
    const auto word = entry(EnumNames<Word>::kTable, value(kWord));
    Draw one{value(kSeed),         word ? word->value : Word::not_judged,
             value("torque_peak"), value("torque_rms"),
             value("distance"),    value(kLeastMargin)};
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
    text += fmt::format("; {} fails in {}", spaced(check), failure.count);
    if (shown > 0) {
      text += fmt::format(" ({}{})",
                          fmt::join(failure.parts.begin(), failure.parts.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                          failure.parts.size() > shown ? " ..." : "");
    }
  }
  return text;
}

std::string draws_table(std::span<const Draw> draws) {
  std::string text = fmt::format("  {:>10}  {:<10}  {:>11}  {:>10}  {:>9}  {:>8}  fails\n", "seed", "verdict", "torque, N m",
                                 "RMS, N m", "travel, m", "margin");
  for (const Draw& draw : draws) {
    std::string failing;
    for (const FailedCheck& failed : draw.failing) {
      failing += (failing.empty() ? "" : ", ") + spaced(failed.check) + (failed.part.empty() ? "" : " of " + failed.part);
    }
    text += fmt::format("  {:>10.0f}  {:<10}  {:>11.3f}  {:>10.3f}  {:>9.4f}  {:>8}  {}\n", draw.seed, name_of(draw.word),
                        draw.torque_peak, draw.torque_rms, draw.distance, texts::percent(draw.margin), failing);
  }
  return text;
}

}  // namespace gaitlab::report
