#include "app/study/study_sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/study/quantity_text.h"
#include "core/files/atomic_file.h"
#include "core/recording/csv.h"
#include "core/settings/wording.h"
#include "report/figures/study/bar_figure.h"

namespace gaitlab::app {

namespace {

using studies::IndexEstimate;
using studies::Sensitivity;

/// Indices of the parameters in order of influence, the largest first. Parameters with equal or unknown influence stay in the
/// order of the study.
std::vector<std::size_t> by_weight(const Sensitivity& s) {
  std::vector<std::size_t> order(s.parameters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto weight = [&](std::size_t k) {
    const double value = s.measures.front().of[k].value;
    return std::isfinite(value) ? value : -1.0;
  };
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return weight(a) > weight(b); });
  return order;
}

bool of_trajectories(const Sensitivity& s) { return s.measures.front().name == "mu_star"; }

/// True if the shares of a parameter are impossible, which is due to the sampling: exact shares are 0 <= first <= total <= 1. A
/// hundredth of the variance is not visible in the bars.
bool too_few_samples(const Sensitivity& s, std::size_t parameter) {
  constexpr double kHidden = 0.01;
  if (of_trajectories(s)) return false;
  const double total = s.measures[0].of[parameter].value;
  const double first = s.measures[1].of[parameter].value;
  return first < -kHidden || first > total + kHidden || total > 1 + kHidden;
}

/// Text on the number of samples that were used, for example `12 of 20 trajectories; the others contain 8 points without a
/// value`.
std::string basis(const Sensitivity& s) {
  std::string text = fmt::format("{} of {} {}", s.used, s.blocks, of_trajectories(s) ? "trajectories" : "samples");
  if (s.unusable > 0) text += fmt::format("; the others contain {} without a value", counted(s.unusable, "point"));
  if (s.not_kept > 0) {
    text +=
        fmt::format("; {} not kept, which does not exclude {}", counted(s.not_kept, "point"), s.not_kept == 1 ? "it" : "them");
  }
  return text;
}

std::string number_cell(double value) { return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-"; }

std::string band_cell(const IndexEstimate& e) {
  return std::isfinite(e.low) ? fmt::format("{:.3g} to {:.3g}", e.low, e.high) : "-";
}

std::string table_of(const Sensitivity& s) {
  std::vector<std::vector<std::string>> rows{{"parameter"}};
  for (const studies::Measure95& measure : s.measures) {
    rows[0].push_back(measure.name);
    rows[0].emplace_back("95 %");
  }
  for (const std::size_t k : by_weight(s)) {
    auto& row = rows.emplace_back(std::vector<std::string>{clipped(s.parameters[k])});
    for (const studies::Measure95& measure : s.measures) {
      row.push_back(number_cell(measure.of[k].value));
      row.push_back(band_cell(measure.of[k]));
    }
  }
  return aligned(rows, 2);
}

std::string csv_of(const std::vector<Sensitivity>& all) {
  std::string text = "output,parameter,measure,value,low,high\n";
  const auto cell = [](double value) { return std::isfinite(value) ? number_text(value) : ""; };
  for (const Sensitivity& s : all) {
    for (std::size_t k = 0; k < s.parameters.size(); ++k) {
      for (const studies::Measure95& measure : s.measures) {
        const IndexEstimate& e = measure.of[k];
        text += csv_quoted(s.output) + "," + csv_quoted(s.parameters[k]) + "," + measure.name + "," + cell(e.value) + "," +
                cell(e.low) + "," + cell(e.high) + "\n";
      }
    }
  }
  return text;
}

report::BarFigure figure_of_bars(const Sensitivity& s, const std::string& study, const std::string& note) {
  report::BarFigure figure;
  const std::string unit = s.unit.empty() ? "" : clipped(s.unit) + " ";
  figure.title = study + ": influence on " + clipped(s.output);
  figure.note = basis(s) + "; " + note;
  figure.axis = of_trajectories(s) ? "change (" + unit + "per range of the parameter)" : "share of the variance";
  figure.kinds = of_trajectories(s) ? std::vector<std::string>{"mean magnitude, mu*", "mean, mu", "deviation, sigma"}
                                    : std::vector<std::string>{"total, with interactions", "first order, without interactions"};
  for (const std::size_t k : by_weight(s)) {
    report::BarRow row{clipped(s.parameters[k]), {}, too_few_samples(s, k) ? "too few samples" : ""};
    for (const studies::Measure95& measure : s.measures)
      row.bars.push_back({measure.of[k].value, measure.of[k].low, measure.of[k].high});
    figure.rows.push_back(std::move(row));
  }
  return figure;
}

}  // namespace

std::string sensitivity_text(studies::Journal& journal, const studies::Results& results) {
  std::string text;
  for (const Sensitivity& s : studies::sensitivities(journal, results)) {
    const std::string unit =
        of_trajectories(s) && !s.unit.empty() ? ", " + clipped(s.unit) + " per range of the parameter" : "";
    text += fmt::format("influence on {}{}: {}\n{}", clipped(s.output), unit, basis(s), table_of(s));
    std::string few;
    for (const std::size_t k : by_weight(s)) {
      if (too_few_samples(s, k)) few += (few.empty() ? "" : ", ") + clipped(s.parameters[k]);
    }
    if (!few.empty()) text += "too few samples, the shares are impossible: " + few + "\n";
  }
  return text;
}

std::vector<std::string> write_sensitivity(studies::Journal& journal, const studies::Results& results, const std::string& note,
                                           const std::filesystem::path& folder) {
  const std::vector<Sensitivity> all = studies::sensitivities(journal, results);
  if (all.empty()) return {};
  std::vector<std::string> files{"sensitivity.csv"};
  write_file(folder / files[0], csv_of(all));
  for (const Sensitivity& s : all) {
    files.push_back("sensitivity-" + file_name(s.output) + ".svg");
    write_file(folder / files.back(), report::bar_svg(figure_of_bars(s, clipped(journal.head().name), note)));
  }
  return files;
}

}  // namespace gaitlab::app
