// Figures of a search: its convergence and its Pareto front.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/study/study_text.h"
#include "core/files/atomic_file.h"
#include "core/settings/wording.h"
#include "report/figures/study/study_convergence.h"
#include "report/figures/study/study_front.h"
#include "studies/search/world_trials.h"

namespace gaitlab::app {

namespace {

using studies::Journal;
using studies::JournalHead;

report::StudyAxis objective_axis(const JournalHead& head, std::size_t number) {
  const std::string& expression = head.objectives[number].expression;
  return {clipped(expression), clipped(studies::unit_of(head, expression))};
}

/// Adds the incomplete last generation, whose runs follow those of the complete generations. Only for a single search, because
/// with several searches these runs cannot be assigned.
void add_cut(report::ConvergenceFigure& figure, const studies::Results& results, std::uint64_t whole) {
  if (figure.searches.size() != 1) return;
  std::vector<double> kept;
  double points = 0;
  for (const studies::PointResult& point : results.points) {
    if (point.first_run < whole) continue;
    ++points;
    if (point.kept()) kept.push_back(point.score.objective());
  }
  if (points == 0) return;
  report::ConvergencePoint cut = figure.searches.front().back();
  ++cut.generation;
  cut.points = points;
  cut.runs = figure.runs;
  cut.kept = static_cast<double>(kept.size()) / points;
  cut.best = cut.median = cut.spread = std::nan("");
  if (!kept.empty()) {
    cut.best = figure.maximize ? std::ranges::max(kept) : std::ranges::min(kept);
    cut.median = studies::combined(std::move(kept), "median", 0.5);
  }
  figure.searches.front().push_back(cut);
}

/// Improvements of the best kept point, in the order of the runs.
std::vector<report::Improvement> improvements_of(const JournalHead& head, const studies::Results& results) {
  std::vector<report::Improvement> best;
  for (const studies::PointResult& point : results.points) {
    const double value = point.score.objective();
    if (!point.kept() || !std::isfinite(value)) continue;
    const bool better =
        best.empty() || (head.objectives.front().maximize ? value > best.back().value : value < best.back().value);
    if (better) best.push_back({static_cast<double>(point.first_run + point.runs), value});
  }
  return best;
}

report::ConvergenceFigure convergence_of(const JournalHead& head, const studies::Results& results,
                                         const std::vector<studies::Generation>& generations) {
  report::ConvergenceFigure figure;
  figure.title = clipped(head.name) + ": the search";
  std::uint64_t runs = 0;  // runs of complete generations
  for (const studies::Generation& g : generations) runs += g.runs;
  figure.note = study_note(head, results.runs);
  figure.value = objective_axis(head, 0);
  figure.maximize = head.objectives.front().maximize;
  figure.best = improvements_of(head, results);
  figure.runs = static_cast<double>(results.points.empty() ? 0 : results.points.back().first_run + results.points.back().runs);
  std::uint64_t search = 0;
  for (const studies::Generation& g : generations) {
    if (figure.searches.empty() || g.search != search) figure.searches.emplace_back();
    search = g.search;
    const auto points = static_cast<double>(g.points);
    figure.searches.back().push_back({static_cast<double>(g.generation), static_cast<double>(g.restart), points, g.best,
                                      g.median, points > 0 ? static_cast<double>(g.kept) / points : 0, g.spread,
                                      static_cast<double>(g.first_run + g.runs)});
  }
  add_cut(figure, results, runs);
  return figure;
}

report::FrontFigure front_of(Journal& journal, const studies::Results& results) {
  const JournalHead& head = journal.head();
  report::FrontFigure figure;
  figure.title = clipped(head.name) + ": the front";
  figure.note = study_note(head, results.runs);
  for (std::size_t k = 0; k < head.objectives.size(); ++k) {
    figure.objectives.push_back(objective_axis(head, k));
    figure.maximize.push_back(head.objectives[k].maximize);
  }
  const std::vector<std::size_t> best = studies::front(results.points, head.objectives);
  const std::vector<std::uint64_t> stood = studies::verified(journal.verifications());
  const auto add = [&](const studies::PointResult& point, report::FrontState state) {
    report::FrontPoint& p = figure.points.emplace_back();
    p.run = static_cast<double>(point.first_run);
    for (std::size_t k = 0; k < head.objectives.size(); ++k) p.objectives.push_back(point.score.objectives[k]);
    p.state = state;
  };
  for (const std::size_t k : best) {
    const bool is_verified = std::ranges::find(stood, results.points[k].first_run) != stood.end();
    add(results.points[k], is_verified ? report::FrontState::verified : report::FrontState::front);
  }
  std::vector<bool> in_front(results.points.size());
  for (const std::size_t k : best) in_front[k] = true;
  for (std::size_t k = 0; k < results.points.size(); ++k) {
    if (results.points[k].kept() && !in_front[k]) add(results.points[k], report::FrontState::behind);
  }
  return figure;
}

}  // namespace

std::vector<std::string> write_search_files(Journal& journal, const studies::Results& results,
                                            const std::filesystem::path& folder) {
  std::vector<std::string> files;
  const auto write = [&](const std::string& name, const std::string& svg, const std::string& csv) {
    write_file(folder / (name + ".svg"), svg);
    write_file(folder / (name + ".csv"), csv);
    files.push_back(name + ".svg");
  };
  if (const std::vector<studies::Generation> generations = journal.generations(); !generations.empty()) {
    const report::ConvergenceFigure figure = convergence_of(journal.head(), results, generations);
    write("convergence", report::convergence_svg(figure), report::convergence_csv(figure));
    write_file(folder / "convergence-best.csv", report::improvements_csv(figure));
  }
  if (journal.head().objectives.size() > 1) {
    const report::FrontFigure figure = front_of(journal, results);
    write("front", report::front_svg(figure), report::front_csv(figure));
  }
  return files;
}

}  // namespace gaitlab::app
