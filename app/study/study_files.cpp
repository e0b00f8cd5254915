// Files beside the journal of a study: its table and its figures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "app/app.h"
#include "app/study/quantity_text.h"
#include "app/study/study_sensitivity.h"
#include "app/study/study_text.h"
#include "core/recording/csv.h"
#include "core/scenario/manual.h"
#include "core/settings/wording.h"
#include "report/figures/study/box_figure.h"
#include "report/figures/study/many_figure.h"
#include "report/figures/study/study_figure.h"
#include "studies/search/world_trials.h"
#include "studies/study/number.h"
#include "studies/study/scenarios.h"

namespace gaitlab::app {

namespace {

using studies::Journal;
using studies::JournalHead;
using studies::JournalParameter;
using studies::Results;

/// Indices of the parameters that the study chooses, not of those that are drawn at random.
std::vector<std::size_t> chosen_parameters(const JournalHead& head) {
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < head.parameters.size(); ++k) {
    if (!head.parameters[k].drawn) chosen.push_back(k);
  }
  return chosen;
}

/// True if a line or a map can show all parameters, because they are one or two numbers.
bool is_map(const JournalHead& head, const std::vector<std::size_t>& parameters) {
  const auto word = [&](std::size_t k) { return head.parameters[k].words; };
  return parameters.size() <= 2 && std::ranges::none_of(parameters, word);
}

report::PointState state_of(const studies::PointResult& point) {
  if (point.failed > 0) return report::PointState::failed;
  if (point.kept()) return report::PointState::kept;
  return point.infeasible_runs > 0 ? report::PointState::infeasible : report::PointState::broken;
}

/// Index of the best kept point, among the verified points if there are any. The number of points if there is none.
std::size_t best_of(Journal& journal, const Results& results) {
  const std::vector<studies::Verification> tried = journal.verifications();
  const std::vector<std::uint64_t> stood = studies::verified(tried);
  for (const std::size_t k : studies::ranked(results.points, journal.head().objectives.front().maximize)) {
    if (!results.points[k].kept()) break;
    if (tried.empty() || std::ranges::find(stood, results.points[k].first_run) != stood.end()) return k;
  }
  return results.points.size();
}

/// True if the text contains the name of a quantity, and not only as a part of a longer name.
bool contains_word(const std::string& text, const std::string& name) {
  const auto of_name = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !of_name(text[at - 1])) && (end == text.size() || !of_name(text[end]))) return true;
  }
  return false;
}

/// Units of all parameters, from the scenario of the study. Empty for parameters of plugin libraries.
std::vector<std::string> units_of(const JournalHead& head) {
  const std::vector<studies::ScenarioText> several = studies::scenario_texts(head.scenario);
  Problems problems;
  const std::optional<Node> scenario =
      parse_yaml(several.empty() ? head.scenario : several.front().text, "scenario.resolved.yaml", problems);
  const Catalog catalog = standard_catalog();
  std::vector<std::string> units;
  for (const JournalParameter& p : head.parameters)
    units.push_back(p.words || !scenario ? "" : unit_of_key(catalog, *scenario, p.key));
  return units;
}

/// Values of all runs, in the order of the runs. A word is represented by its index.
struct Values {
  std::vector<std::uint64_t> run;
  std::vector<std::vector<double>> parameters, figures;
};

Values values_of(Journal& journal, const std::vector<std::size_t>& parameters, const std::vector<std::size_t>& figures) {
  std::vector<std::string> columns{"run"};
  for (const std::size_t k : parameters) columns.push_back(journal.columns().parameters[k]);
  for (const std::size_t k : figures) columns.push_back(journal.columns().quantities[k]);
  Values values;
  journal.each_row(columns, [&](const std::vector<std::string>& row) {
    const auto number = [&](std::size_t at) { return row[at].empty() ? std::nan("") : studies::number_of(row[at]); };
    values.run.push_back(studies::run_number_of(row[0]));
    auto& p = values.parameters.emplace_back();
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const JournalParameter& of = journal.head().parameters[parameters[k]];
      const auto word = static_cast<double>(std::ranges::find(of.values, row[1 + k]) - of.values.begin());
      p.push_back(of.words ? word : number(1 + k));
    }
    auto& f = values.figures.emplace_back();
    for (std::size_t k = 0; k < figures.size(); ++k) f.push_back(number(1 + parameters.size() + k));
  });
  return values;
}

/// Sets `point` to least, mean and largest of a quantity over the replicates in which it is known.
void gather(report::StudyPoint& point, const Values& values, std::size_t first, std::size_t count, std::size_t figure) {
  std::vector<double> known;
  for (std::size_t r = first; r < first + count; ++r) {
    if (std::isfinite(values.figures[r][figure])) known.push_back(values.figures[r][figure]);
  }
  point.value = point.low = point.high = std::nan("");
  if (known.empty()) return;
  point.low = std::ranges::min(known);
  point.high = std::ranges::max(known);
  point.value =
      known.size() == 1 ? known[0] : std::accumulate(known.begin(), known.end(), 0.0) / static_cast<double>(known.size());
}

/// Index of the first row of each point. Fewer if the journal has grown since the results were read.
std::vector<std::size_t> rows_of(const Results& results, const Values& values) {
  std::vector<std::size_t> rows;
  std::size_t row = 0;
  for (const studies::PointResult& result : results.points) {
    while (row < values.run.size() && values.run[row] < result.first_run) ++row;
    if (row + result.runs > values.run.size()) break;
    rows.push_back(row);
  }
  return rows;
}

report::StudyPoint point_of(const studies::PointResult& result, const Values& values, std::size_t row, std::size_t figure) {
  report::StudyPoint point;
  gather(point, values, row, static_cast<std::size_t>(result.runs), figure);
  point.state = state_of(result);
  return point;
}

/// Values of a study, and the common texts of its figures.
struct Drawn {
  const JournalHead& head;
  const Results& results;
  const Values& values;
  const std::vector<std::size_t>& parameters;
  std::vector<std::string> units;  ///< units of all parameters of the study
  std::vector<std::size_t> rows;
  std::string note;
  std::size_t best_point;  ///< index of the best point; the number of points if there is none

  [[nodiscard]] std::string title(const studies::Quantity& name) const {
    return clipped(head.name) + ": " + clipped(name.name);
  }
  /// Axis of a parameter of the study.
  [[nodiscard]] report::StudyAxis axis(std::size_t parameter) const {
    const JournalParameter& p = head.parameters[parameter];
    return {clipped(p.key), units[parameter], p.log};
  }
  /// True if the first objective, which decides the best point, contains the quantity.
  [[nodiscard]] bool is_objective(const studies::Quantity& name) const {
    return contains_word(head.objectives.front().expression, name.name);
  }
  [[nodiscard]] std::size_t best() const { return std::min(best_point, rows.size()); }
};

report::StudyFigure map_of(const Drawn& drawn, std::size_t number, const studies::Quantity& name) {
  report::StudyFigure figure;
  figure.title = drawn.title(name);
  figure.note = drawn.note;
  figure.x = drawn.axis(drawn.parameters[0]);
  figure.map = drawn.parameters.size() == 2;
  if (figure.map) figure.y = drawn.axis(drawn.parameters[1]);
  figure.value = {clipped(name.name), clipped(name.unit)};
  figure.grid = drawn.head.method == name_of(studies::Method::grid);
  for (std::size_t k = 0; k < drawn.rows.size(); ++k) {
    report::StudyPoint point = point_of(drawn.results.points[k], drawn.values, drawn.rows[k], number);
    point.x = drawn.values.parameters[drawn.rows[k]][0];
    if (figure.map) point.y = drawn.values.parameters[drawn.rows[k]][1];
    figure.points.push_back(point);
  }
  figure.best = drawn.best();
  figure.objective = drawn.is_objective(name);
  return figure;
}

report::ManyFigure many_of(const Drawn& drawn, std::size_t number, const studies::Quantity& name) {
  report::ManyFigure figure;
  figure.title = drawn.title(name);
  figure.note = drawn.note;
  for (const std::size_t k : drawn.parameters) {
    const JournalParameter& p = drawn.head.parameters[k];
    std::vector<std::string> words;
    for (const std::string& word : p.values) words.push_back(clipped(word));
    figure.axes.push_back({drawn.axis(k), p.words ? words : std::vector<std::string>()});
  }
  figure.value = {clipped(name.name), clipped(name.unit)};
  for (std::size_t k = 0; k < drawn.rows.size(); ++k) {
    const report::StudyPoint point = point_of(drawn.results.points[k], drawn.values, drawn.rows[k], number);
    figure.points.push_back({drawn.values.parameters[drawn.rows[k]], point.value, point.state});
  }
  figure.best = drawn.best();
  figure.objective = drawn.is_objective(name);
  return figure;
}

/// Writes replicates.svg and replicates.csv, which show the replicates of the best points side by side.
void write_replicates(const Drawn& drawn, const studies::Quantity& name, const std::filesystem::path& folder) {
  constexpr std::size_t kShown = 6;
  std::vector<std::size_t> order = studies::ranked(drawn.results.points, drawn.head.objectives.front().maximize);
  std::erase_if(order, [&](std::size_t k) { return k >= drawn.rows.size(); });
  order.resize(std::min(order.size(), kShown));
  report::BoxFigure figure;
  const std::vector<std::string>& scenarios = drawn.head.scenarios;
  const std::uint64_t each = drawn.head.replicates / std::max<std::size_t>(1, scenarios.size());  // replicates in each scenario
  figure.title = drawn.title(name) + (scenarios.empty() ? " of the replicates" : " in the scenarios");
  figure.note = drawn.note;
  figure.axis = report::StudyAxis{clipped(name.name), clipped(name.unit)}.title();
  figure.below = "first run of the point, the best at the left";
  std::string csv =
      std::string("point,") + (scenarios.empty() ? "" : "scenario,") + "replicate," + csv_quoted(name.name) + ",kept\n";
  for (const std::size_t k : order) {
    const studies::PointResult& point = drawn.results.points[k];
    report::BoxGroup group{fmt::format("run {}", point.first_run), {}, point.kept()};
    for (std::size_t r = 0; r < point.runs; ++r) {
      const double value = drawn.values.figures[drawn.rows[k] + r].front();
      group.values.push_back(value);
      const std::string scenario = scenarios.empty() ? "" : csv_quoted(scenarios[r / each]) + ",";
      csv += fmt::format("{},{}{},{},{}\n", point.first_run, scenario, scenarios.empty() ? r : r % each,
                         std::isfinite(value) ? number_text(value) : "", point.kept() ? 1 : 0);
    }
    figure.groups.push_back(std::move(group));
  }
  write_file(folder / "replicates.svg", report::box_svg(figure));
  write_file(folder / "replicates.csv", csv);
}

/// Writes the figures of a quantity: a map, or parallel axes and scatter plots. Returns their names.
std::vector<std::string> write_figures(const Drawn& drawn, std::size_t k, const studies::Quantity& quantity, bool map,
                                       const std::filesystem::path& folder) {
  const std::string name = file_name(drawn.head.shown[k]);
  const auto write = [&](const std::string& file, const std::string& text) { write_file(folder / file, text); };
  if (map) {
    const report::StudyFigure drawing = map_of(drawn, k, quantity);
    write(name + ".svg", report::study_svg(drawing));
    write(name + ".csv", report::study_csv(drawing));
    return {name + ".svg"};
  }
  const report::ManyFigure drawing = many_of(drawn, k, quantity);
  write(name + ".svg", report::parallel_svg(drawing));
  write(name + "-scatter.svg", report::scatter_svg(drawing));
  write(name + ".csv", report::many_csv(drawing));
  return {name + ".svg", name + "-scatter.svg"};
}

}  // namespace

std::string study_note(const JournalHead& head, std::uint64_t runs) {
  return fmt::format("{} runs; {}; gaitlab {}", runs,
                     head.guarded ? "guards: verdict" : "without guards: results may exploit the simulation",
                     one_line(head.build));
}

std::vector<std::string> write_study_files(Journal& journal, const Results& results, const std::filesystem::path& folder) {
  std::vector<std::string> files{"table.csv"};
  write_table(journal, folder / "table.csv");
  std::ranges::copy(write_search_files(journal, results, folder), std::back_inserter(files));
  const JournalHead& head = journal.head();
  if (results.points.empty()) return files;
  const std::vector<std::size_t> parameters = chosen_parameters(head);
  std::vector<std::size_t> figures;
  for (const std::string& name : head.shown) {
    figures.push_back(
        static_cast<std::size_t>(std::ranges::find(head.quantities, name, &studies::Quantity::name) - head.quantities.begin()));
  }
  const Values values = values_of(journal, parameters, figures);
  const Drawn drawn{head,
                    results,
                    values,
                    parameters,
                    units_of(head),
                    rows_of(results, values),
                    study_note(head, results.runs),
                    best_of(journal, results)};
  const bool map = is_map(head, parameters);
  for (std::size_t k = 0; k < figures.size() && !parameters.empty(); ++k) {
    std::ranges::move(write_figures(drawn, k, head.quantities[figures[k]], map, folder), std::back_inserter(files));
  }
  if (head.replicates > 1 && !figures.empty()) {
    write_replicates(drawn, head.quantities[figures.front()], folder);
    files.emplace_back("replicates.svg");
  }
  for (std::string& file : write_sensitivity(journal, results, drawn.note, folder)) files.push_back(std::move(file));
  return files;
}

}  // namespace gaitlab::app
