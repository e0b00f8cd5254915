#include "app/study/study_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "app/study/importance_text.h"
#include "app/study/quantity_text.h"
#include "app/study/study_sensitivity.h"
#include "app/study/verification_text.h"
#include "core/recording/csv.h"
#include "core/settings/shell_word.h"
#include "core/settings/wording.h"
#include "studies/study/number.h"

namespace gaitlab::app {

namespace {

using studies::Journal;
using studies::JournalHead;

/// Number of the journal with four digits, for a table.
std::string short_number(const std::string& text) {
  if (text.empty()) return "-";
  double number = 0;
  const char* end = text.data() + text.size();
  return std::from_chars(text.data(), end, number).ptr == end ? fmt::format("{:.4g}", number) : clipped(text);
}

struct ColumnOfTable {
  std::string head, under;
  std::vector<std::string> cells;
};

std::string laid_out(const std::vector<ColumnOfTable>& columns) {
  std::string text;
  const std::size_t rows = columns.empty() ? 0 : columns.front().cells.size();
  for (std::size_t line = 0; line < rows + 2; ++line) {
    std::string row;
    for (const ColumnOfTable& column : columns) {
      std::size_t width = std::max(column.head.size(), column.under.size());
      for (const std::string& cell : column.cells) width = std::max(width, cell.size());
      row += fmt::format("  {:>{}}", line == 0 ? column.head : line == 1 ? column.under : column.cells[line - 2], width);
    }
    while (row.ends_with(' ')) row.pop_back();
    text += row + "\n";
  }
  return text;
}

/// First objective of a point in one scenario of the study, or the outcome of a failed run.
std::string in_one_scenario(Journal& journal, const studies::PointResult& point, std::size_t scenario) {
  const JournalHead& head = journal.head();
  const std::vector<std::string> names = journal.columns().all();
  const std::uint64_t runs = point.runs / head.scenarios.size();
  std::vector<double> bad;  // larger values are worse
  for (std::uint64_t r = 0; r < runs; ++r) {
    const std::vector<std::string> row = journal.row(point.first_run + scenario * runs + r);
    if (row.size() != names.size()) return "-";
    const std::string& outcome = row[studies::place_in(names, "outcome")];
    if (outcome != "done" && point.failed > 0) return clipped(outcome);
    if (outcome != "done") continue;  // tolerated by `combine: share(Q)`
    const std::string& value = row[studies::place_in(names, studies::objective_column(0))];
    if (value.empty()) return "-";
    bad.push_back((head.objectives.front().maximize ? -1 : 1) * studies::number_of(value));
  }
  if (bad.empty()) return "-";
  const double worse = studies::combined(bad, head.combine, head.quantile);
  return fmt::format("{:.4g}", head.objectives.front().maximize ? -worse : worse);
}

/// Word of the verdict on a point. It is that of the first run of the point or, with several scenarios, that of the first run
/// that is infeasible or failed.
std::string verdict_on(Journal& journal, const studies::PointResult& point, std::size_t place) {
  std::string first = journal.row(point.first_run)[place];
  for (std::uint64_t r = 0; !journal.head().scenarios.empty() && r < point.runs; ++r) {
    std::string word = journal.row(point.first_run + r)[place];
    if (word == "infeasible" || word == "failed") return word;
  }
  return first;
}

/// Text ` in rubble` with the name of the run's scenario, in a study with several scenarios.
std::string in_which_scenario(const JournalHead& head, std::uint64_t run) {
  if (head.scenarios.empty()) return "";
  const std::uint64_t runs = std::max<std::uint64_t>(1, head.replicates / head.scenarios.size());
  const std::size_t scenario = run % head.replicates / runs;
  return scenario < head.scenarios.size() ? " in " + clipped(head.scenarios[scenario]) : "";
}

/// Text for a condition: `check stops` for `margin.stops >= 0`, `the verdict` for `feasible >= 1`. Other conditions are not
/// changed.
std::string limit_text(const std::string& relation) {
  constexpr std::string_view kMargin = "margin.";
  constexpr std::string_view kKept = " >= 0";
  if (relation == "feasible >= 1") return "the verdict";
  if (!relation.starts_with(kMargin) || !relation.ends_with(kKept)) return clipped(relation);
  return "check " + clipped(relation.substr(kMargin.size(), relation.size() - kMargin.size() - kKept.size()));
}

/// Sentences on the best points that are not kept, with the reason.
std::string rejected_text(Journal& journal, const studies::Results& results) {
  constexpr std::size_t kMost = 3;
  const std::vector<std::size_t> order = studies::ranked(results.points, journal.head().objectives.front().maximize);
  const std::size_t message = studies::place_in(journal.columns().all(), "message");
  std::string text;
  for (std::size_t k = 0; k < std::min(kMost, order.size()); ++k) {
    const studies::PointResult& point = results.points[order[k]];
    if (point.kept() || point.failed > 0) continue;
    for (std::uint64_t run = point.first_run; run < point.first_run + point.runs; ++run) {
      const std::vector<std::string> row = journal.row(run);
      if (row.size() <= message || row[message].empty()) continue;
      text += fmt::format("run {} is not kept: {}\n", run, one_line(row[message]));
      break;
    }
  }
  return text;
}

/// Sentences on the torque errors of the runs with an estimate.
std::string estimated_text(Journal& journal, const studies::Results& results) {
  const studies::Estimated found = studies::estimated(journal);
  if (results.runs == 0) return "";
  if (found.runs == 0) return "torque error estimated in none of the runs: nothing shows how accurate `feasible` is\n";
  std::string text = fmt::format("torque error estimated in {}: {} beyond {:.3g} %, {} beyond {:.3g} %; at most {:.2g} %\n",
                                 counted(found.runs, "run"), found.beyond_small, 100 * studies::Estimated::kSmall,
                                 found.beyond_most, 100 * found.most, 100 * found.worst);
  if (found.trusted()) return text;
  if (found.too_few()) {
    return text + fmt::format("fewer than {} estimates: no evidence for the other {}; take a smaller estimate_every\n",
                              studies::Estimated::kFewest, counted(found.others, "run"));
  }
  text += fmt::format("more than one in ten errors is beyond {:.3g} %: ", 100 * found.most);
  if (found.others > 0) {
    text +=
        fmt::format("`feasible` is not reliable for the other {}; take estimate_every: 1, and ", counted(found.others, "run"));
  } else {
    text += "take ";
  }
  text += "physics.step: auto or a smaller accuracy\n";
  return text;
}

std::string share(std::uint64_t part, std::uint64_t of) {
  return of == 0 ? "" : fmt::format(" ({:.0f} %)", 100 * static_cast<double>(part) / static_cast<double>(of));
}

/// Columns of a table of points: the run, cells of the journal at `places`, then those of the objectives and the outcome.
struct PointColumns {
  std::vector<ColumnOfTable> columns;
  std::vector<std::size_t> places;
  std::size_t objective = 0;  ///< index of the first objective
};

PointColumns point_columns(Journal& journal, const std::vector<std::string>& names) {
  const JournalHead& head = journal.head();
  std::vector<ColumnOfTable> columns{{"run", "", {}}};
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < head.parameters.size(); ++k) {
    if (head.parameters[k].drawn) continue;
    columns.push_back({clipped(head.parameters[k].key), "", {}});
    places.push_back(studies::place_in(names, journal.columns().parameters[k]));
  }
  constexpr std::size_t kFigures = 5;
  for (std::size_t k = 0; k < head.quantities.size(); ++k) {
    const studies::Quantity& figure = head.quantities[k];
    const std::size_t rank = studies::place_in(head.shown, figure.name);
    const auto is_objective = [&](const studies::JournalObjective& o) { return o.expression == figure.name; };
    if (rank >= std::min(kFigures, head.shown.size()) || std::ranges::any_of(head.objectives, is_objective)) continue;
    columns.push_back({clipped(figure.name), clipped(figure.unit), {}});
    places.push_back(studies::place_in(names, journal.columns().quantities[k]));
  }
  const std::size_t objective = columns.size();
  const std::string together = head.replicates > 1 ? " (" + clipped(head.combine) + ")" : "";
  for (const studies::JournalObjective& o : head.objectives)
    columns.push_back({clipped(o.expression) + together, clipped(studies::unit_of(head, o.expression)), {}});
  for (const std::string& scenario : head.scenarios)
    columns.push_back({"in " + clipped(scenario), columns[objective].under, {}});
  if (head.replicates > 1) columns.push_back({"feasible", "runs", {}});
  columns.push_back({"violation", "", {}});
  columns.push_back({"verdict", "", {}});
  return {std::move(columns), std::move(places), objective};
}

}  // namespace

std::string points_table(Journal& journal, const studies::Results& results, const std::vector<std::size_t>& order,
                         std::size_t most) {
  const JournalHead& head = journal.head();
  const std::vector<std::string> names = journal.columns().all();
  auto [columns, places, objective] = point_columns(journal, names);
  const std::size_t verdict = studies::place_in(names, "verdict");
  const std::size_t outcome = studies::place_in(names, "outcome");
  for (std::size_t k = 0; k < std::min(most, order.size()); ++k) {
    const studies::PointResult& point = results.points[order[k]];
    const std::vector<std::string> row = journal.row(point.first_run);
    if (row.size() != names.size()) continue;
    columns[0].cells.push_back(std::to_string(point.first_run));
    for (std::size_t c = 0; c < places.size(); ++c) columns[c + 1].cells.push_back(short_number(row[places[c]]));
    const bool failed = point.failed > 0;
    for (std::size_t o = 0; o < head.objectives.size(); ++o)
      columns[objective + o].cells.push_back(failed ? clipped(row[outcome]) : fmt::format("{:.4g}", point.score.objectives[o]));
    std::size_t behind = objective + head.objectives.size();
    for (std::size_t s = 0; s < head.scenarios.size(); ++s)
      columns[behind++].cells.push_back(in_one_scenario(journal, point, s));
    if (head.replicates > 1) columns[behind++].cells.push_back(fmt::format("{} of {}", point.feasible_runs, point.runs));
    columns[behind].cells.push_back(failed ? "-" : fmt::format("{:.3g}", point.score.violation));
    columns[behind + 1].cells.push_back(clipped(verdict_on(journal, point, verdict)));
  }
  return laid_out(columns);
}

namespace {

/// Tables of the best and the worst points, or of the Pareto front.
std::string ranking_text(Journal& journal, const studies::Results& results, std::size_t most) {
  const JournalHead& head = journal.head();
  std::string text;
  if (head.objectives.size() > 1) {
    const std::vector<std::size_t> best = studies::front(results.points, head.objectives);
    text += fmt::format("Pareto front: {} that no other point beats in all objectives\n", counted(best.size(), "point"));
    if (!best.empty()) text += points_table(journal, results, best, 2 * most);
  } else if (!results.points.empty()) {
    const std::vector<std::size_t> order = studies::ranked(results.points, head.objectives.front().maximize);
    text += fmt::format("best by {} ({}), kept points first:\n{}", objective_text(head),
                        head.objectives.front().maximize ? "most" : "least", points_table(journal, results, order, most));
    if (order.size() > most) {
      std::vector<std::size_t> last(order.end() - static_cast<std::ptrdiff_t>(std::min(most, order.size() - most)),
                                    order.end());
      text += fmt::format("worst:\n{}", points_table(journal, results, last, most));
    }
  }
  return text;
}

/// The most frequent broken limits on one line.
std::string broken_text(Journal& journal) {
  constexpr std::size_t kLimits = 4;
  const std::vector<studies::BrokenLimit> limits = studies::broken_limits(journal);
  std::string text;
  for (std::size_t k = 0; k < std::min(kLimits, limits.size()); ++k) {
    text += fmt::format("{}{} ({})", k == 0 ? "broken limits, most frequent first: " : ", ", limit_text(limits[k].text),
                        counted(limits[k].runs, "run"));
  }
  return limits.empty() ? "" : text + "\n";
}

}  // namespace

std::string study_summary(Journal& journal, const studies::Results& results, const std::filesystem::path& folder,
                          std::size_t most) {
  const JournalHead& head = journal.head();
  std::uint64_t failed = 0, stopped = 0;
  for (const auto& [outcome, one] : results.failures.by_outcome)
    (outcome == name_of(Ended::stopped) ? stopped : failed) += one.count;
  std::string text = fmt::format("{}: {} of {} runs ended, {} kept{}, {} feasible, {}{} failed\n", clipped(head.name),
                                 results.runs, head.runs, results.kept_runs, share(results.kept_runs, results.runs),
                                 results.feasible_runs, stopped > 0 ? fmt::format("{} stopped, ", stopped) : "", failed);
  text += estimated_text(journal, results);
  if (head.told) text += "results of another program (--ask): nothing is verified\n";
  if (!head.guarded) text += "without guards: results may exploit the simulation\n";
  text += ranking_text(journal, results, most);
  text += rejected_text(journal, results);
  text += sensitivity_text(journal, results);
  text += importance_text(journal, results);
  text += broken_text(journal);
  for (const auto& [outcome, one] : results.failures.by_outcome) {
    text += fmt::format("{} {}, first: run {}{}: {}\n", one.count, clipped(outcome), one.first_run,
                        in_which_scenario(head, one.first_run), one_line(one.message));
  }
  text += verification_text(journal);
  if (results.runs > 0)
    text += fmt::format("to repeat a run with its trace: gaitlab study rerun {} RUN\n", shell_word(folder.string()));
  return text;
}

void write_table(Journal& journal, const std::filesystem::path& file, Existing existing) {
  AtomicFile out(file, existing);
  std::string text;
  const auto add = [&](const std::vector<std::string>& cells) {
    for (std::size_t k = 0; k < cells.size(); ++k) text += (k > 0 ? "," : "") + csv_quoted(cells[k]);
    text += '\n';
    constexpr std::size_t kPiece = 1 << 20;
    if (text.size() < kPiece) return;
    out.write(text);
    text.clear();
  };
  const std::vector<std::string> names = journal.columns().all();
  add(names);
  journal.each_row(names, add);
  out.write(text);
  out.commit();
}

}  // namespace gaitlab::app
