#include "studies/search/sensitivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "core/math/random.h"
#include "studies/plan/designs.h"
#include "studies/study/number.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kResamples = 500;
constexpr std::uint64_t kBootstrapDraw = 111;  // purpose number, the first word of each hash

using Blocks = std::vector<std::size_t>;  ///< numbers of blocks, possibly repeated

/// Numbers of the blocks in which every point has a value.
Blocks whole_blocks(std::span<const double> values, std::size_t size) {
  Blocks whole;
  for (std::size_t b = 0; (b + 1) * size <= values.size(); ++b) {
    const std::span<const double> block = values.subspan(b * size, size);
    if (std::ranges::all_of(block, [](double v) { return std::isfinite(v); })) whole.push_back(b);
  }
  return whole;
}

/// Function that estimates all measures from a resample. Its result has a number for each parameter of the first measure, then
/// for each parameter of the second, and so on.
using Estimator = std::function<std::vector<double>(const Blocks&)>;

void estimate(Sensitivity& found, const Blocks& used, const Estimator& estimator, std::size_t parameters) {
  const std::vector<double> best = estimator(used);
  std::vector<std::vector<double>> resampled(best.size());
  constexpr std::size_t kFewest = 2;
  for (std::uint64_t sample = 0; used.size() >= kFewest && sample < kResamples; ++sample) {
    Blocks drawn(used.size());
    for (std::size_t k = 0; k < drawn.size(); ++k) drawn[k] = used[math::hash64({kBootstrapDraw, sample, k}) % used.size()];
    const std::vector<double> one = estimator(drawn);
    for (std::size_t k = 0; k < one.size(); ++k) {
      if (std::isfinite(one[k])) resampled[k].push_back(one[k]);
    }
  }
  for (std::size_t m = 0; m < found.measures.size(); ++m) {
    for (std::size_t p = 0; p < parameters; ++p) {
      std::vector<double>& all = resampled[m * parameters + p];
      IndexEstimate one{best[m * parameters + p], kNone, kNone};
      if (!all.empty()) {
        std::ranges::sort(all);
        const auto at = [&](double share) {
          return all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))];
        };
        one.low = at(0.025);
        one.high = at(0.975);
      }
      found.measures[m].of.push_back(one);
    }
  }
  found.used = used.size();
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Elementary effects by trajectory and parameter.
std::vector<double> elementary_effects(std::uint64_t seed, std::size_t n, std::span<const double> values) {
  std::vector<double> effects(values.size() / (n + 1) * n, kNone);
  for (std::size_t t = 0; t < values.size() / (n + 1); ++t) {
    std::vector<double> before = morris_shares(seed, n, t * (n + 1));
    for (std::size_t s = 1; s <= n; ++s) {
      const std::size_t point = t * (n + 1) + s;
      const std::vector<double> now = morris_shares(seed, n, point);
      std::size_t moved = 0;
      while (now[moved] == before[moved]) ++moved;
      effects[t * n + moved] = (values[point] - values[point - 1]) / (now[moved] - before[moved]);
      before = now;
    }
  }
  return effects;
}

/// Measures mu*, mu and sigma of the drawn trajectories.
std::vector<double> morris_measures(const std::vector<double>& effects, std::size_t n, const Blocks& drawn) {
  std::vector<double> measures(3 * n, kNone);
  if (drawn.empty()) return measures;
  for (std::size_t p = 0; p < n; ++p) {
    std::vector<double> of;
    std::vector<double> magnitudes;
    for (const std::size_t t : drawn) {
      of.push_back(effects[t * n + p]);
      magnitudes.push_back(std::abs(of.back()));
    }
    const double mu = mean_of(of);
    measures[p] = mean_of(magnitudes);
    measures[n + p] = mu;
    if (of.size() < 2) continue;
    double squares = 0;
    for (const double one : of) squares += (one - mu) * (one - mu);
    measures[2 * n + p] = std::sqrt(squares / static_cast<double>(of.size() - 1));
  }
  return measures;
}

/// Total indices, then first-order indices, from the drawn rows.
std::vector<double> saltelli(std::span<const double> values, std::size_t n, const Blocks& drawn) {
  std::vector<double> measures(2 * n, kNone);
  if (drawn.size() < 2) return measures;
  const auto rows = static_cast<double>(drawn.size());
  double mean = 0;
  for (const std::size_t row : drawn) mean += (values[row * (n + 2)] + values[row * (n + 2) + 1]) / (2 * rows);
  double variance = 0;  // variance of A and B together
  for (const std::size_t row : drawn) {
    const double a = values[row * (n + 2)] - mean;
    const double b = values[row * (n + 2) + 1] - mean;
    variance += (a * a + b * b) / (2 * rows - 1);
  }
  // A variance below this share of the squared mean is only rounding error.
  constexpr double kRounding = 1e-24;
  if (!(variance > kRounding * mean * mean) || !(variance > 0)) return measures;
  for (std::size_t p = 0; p < n; ++p) {
    double total = 0;
    double first = 0;
    for (const std::size_t row : drawn) {
      const double a = values[row * (n + 2)];
      const double b = values[row * (n + 2) + 1];
      const double changed = values[row * (n + 2) + 2 + p] - a;
      total += changed * changed;
      first += (b - mean) * changed;  // the mean is subtracted, because it would add noise
    }
    measures[p] = total / (2 * rows) / variance;
    measures[n + p] = first / rows / variance;
  }
  return measures;
}

/// An output of the study, with its values by point number.
struct Output {
  std::string name, unit;
  std::vector<double> values;
};

/// Mean over the replicates of each point. NaN if the value is unknown for any replicate.
std::vector<double> means(Journal& journal, const std::string& column, std::size_t points) {
  const std::uint64_t replicates = journal.head().replicates;
  std::vector<double> sums(points, 0.0);
  std::vector<std::uint64_t> counts(points, 0);
  journal.each_row({"run", column}, [&](const std::vector<std::string>& row) {
    const auto point = run_number_of(row[0]) / replicates;
    if (point >= points) return;
    sums[point] += row[1].empty() ? kNone : number_of(row[1]);
    ++counts[point];
  });
  for (std::size_t k = 0; k < points; ++k)
    sums[k] = counts[k] == replicates ? sums[k] / static_cast<double>(replicates) : kNone;
  return sums;
}

}  // namespace

std::string method_of(const JournalHead& head) {
  constexpr std::string_view kKey = "\nmethod: ";
  const std::size_t at = head.definition.find(kKey);
  if (at == std::string::npos) return "";
  const std::size_t from = at + kKey.size();
  return head.definition.substr(from, head.definition.find('\n', from) - from);
}

bool of_sensitivity(const JournalHead& head) {
  const std::optional<Method> method = named<Method>(method_of(head));
  return method == Method::morris || method == Method::sobol_indices;
}

Sensitivity morris(std::uint64_t seed, std::size_t parameters, std::span<const double> values) {
  Sensitivity found;
  found.measures = {{"mu_star", {}}, {"mu", {}}, {"sigma", {}}};
  found.blocks = values.size() / (parameters + 1);
  const std::vector<double> effects = elementary_effects(seed, parameters, values);
  const Estimator estimator = [&](const Blocks& drawn) { return morris_measures(effects, parameters, drawn); };
  estimate(found, whole_blocks(values, parameters + 1), estimator, parameters);
  return found;
}

Sensitivity sobol_indices(std::size_t parameters, std::span<const double> values) {
  Sensitivity found;
  found.measures = {{"total", {}}, {"first", {}}};
  found.blocks = values.size() / (parameters + 2);
  const Estimator estimator = [&](const Blocks& drawn) { return saltelli(values, parameters, drawn); };
  estimate(found, whole_blocks(values, parameters + 2), estimator, parameters);
  return found;
}

std::vector<Sensitivity> sensitivities(Journal& journal, const Results& results) {
  const JournalHead& head = journal.head();
  const std::optional<Method> method = named<Method>(method_of(head));
  const bool of_morris = method == Method::morris;
  if (!of_morris && method != Method::sobol_indices) return {};
  std::vector<std::string> keys;
  for (const JournalParameter& p : head.parameters) {
    if (!p.drawn) keys.push_back(p.key);
  }
  constexpr std::uint64_t kMostPoints = 1U << 28U;  // this program never writes a journal with more points
  const std::uint64_t all = head.runs / head.replicates;
  if (keys.empty() || all > kMostPoints) return {};
  const auto points = static_cast<std::size_t>(all);
  std::vector<Output> outputs;
  std::uint64_t not_kept = 0;
  for (const JournalObjective& objective : head.objectives)
    outputs.push_back({objective.expression, unit_of(head, objective.expression), std::vector<double>(points, kNone)});
  for (const PointResult& point : results.points) {
    const std::size_t number = point.first_run / head.replicates;
    if (point.failed > 0 || number >= points) continue;
    not_kept += point.kept() ? 0 : 1;
    for (std::size_t k = 0; k < head.objectives.size(); ++k) outputs[k].values[number] = point.score.objectives[k];
  }
  for (const std::string& name : head.shown) {
    if (std::ranges::find(outputs, name, &Output::name) != outputs.end()) continue;
    outputs.push_back({name, unit_of(head, name), means(journal, journal.column_of(name), points)});
  }
  std::vector<Sensitivity> found;
  for (const Output& output : outputs) {
    Sensitivity one = of_morris ? morris(static_cast<std::uint64_t>(head.seed), keys.size(), output.values)
                                : sobol_indices(keys.size(), output.values);
    one.output = output.name;
    one.unit = output.unit;
    one.parameters = keys;
    one.not_kept = not_kept;
    one.unusable =
        static_cast<std::uint64_t>(std::ranges::count_if(output.values, [](double value) { return !std::isfinite(value); }));
    found.push_back(std::move(one));
  }
  return found;
}

}  // namespace gaitlab::studies
