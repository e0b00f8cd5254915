#include "studies/search/importance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/math/functions.h"
#include "studies/search/sensitivity.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostClasses = 20, kPointsOfClass = 20, kFewestClasses = 3;

std::size_t classes(std::size_t points) { return std::min(kMostClasses, points / kPointsOfClass); }

std::vector<std::size_t> order_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return values[k]; });
  return order;
}

/// Calls `take` with each group of equal values, as positions [from, to) in `order`.
template <class Take>
void each_tie(std::span<const double> values, const std::vector<std::size_t>& order, const Take& take) {
  for (std::size_t from = 0; from < order.size();) {
    std::size_t to = from + 1;
    while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
    take(from, to);
    from = to;
  }
}

/// Ranks of the values; equal values have the mean of their ranks.
std::vector<double> ranks(std::span<const double> values) {
  std::vector<double> found(values.size());
  const std::vector<std::size_t> order = order_of(values);
  each_tie(values, order, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) found[order[k]] = static_cast<double>(from + to - 1) / 2;
  });
  return found;
}

/// The points of a study: columns of values by parameter, the first objective (NaN for a failed point), and `kept`.
struct Sample {
  std::vector<std::vector<double>> parameters;
  std::vector<double> objective, kept;
};

Sample sample_of(Journal& journal, const Results& results, const std::vector<std::size_t>& chosen) {
  const JournalHead& head = journal.head();
  Sample sample;
  sample.parameters.resize(chosen.size());
  std::vector<std::string> columns{"run"};
  for (const std::size_t k : chosen) columns.push_back(journal.columns().parameters[k]);
  auto point = results.points.begin();
  journal.each_row(columns, [&](const std::vector<std::string>& row) {
    if (point == results.points.end() || run_number_of(row[0]) != point->first_run) return;
    for (std::size_t c = 0; c < chosen.size(); ++c) {
      const JournalParameter& p = head.parameters[chosen[c]];
      const auto word = static_cast<double>(std::ranges::find(p.values, row[c + 1]) - p.values.begin());
      const double number = p.words ? word : number_of(row[c + 1]);
      sample.parameters[c].push_back(std::isfinite(number) ? number : 0);  // a forged journal can contain other texts
    }
    sample.objective.push_back(point->failed > 0 ? kUnknown : point->score.objective());
    sample.kept.push_back(point->kept() ? 1 : 0);
    ++point;
  });
  return sample;
}

/// Share explained of the objective's rank, over the points with an objective. Without ranks, one extreme value could decide.
double of_objective(const std::vector<double>& parameter, const std::vector<double>& objective) {
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t k = 0; k < objective.size(); ++k) {
    if (!std::isfinite(objective[k])) continue;
    x.push_back(parameter[k]);
    y.push_back(objective[k]);
  }
  return explained(x, ranks(y));
}

double share_of_range(const JournalParameter& p, double value) {
  if (!p.log) return (value - p.low) / (p.high - p.low);
  return (math::log(value) - math::log(p.low)) / (math::log(p.high) - math::log(p.low));
}

/// Finds the part of the range with kept points.
void find_kept_part(const JournalParameter& p, const std::vector<double>& values, const std::vector<double>& kept,
                    ParameterImportance& found) {
  std::vector<double> of_kept;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (kept[k] > 0) of_kept.push_back(values[k]);
  }
  if (of_kept.empty()) return;
  constexpr std::size_t kPercentile = 50;  // one in 50 at each end
  const std::size_t left_out = (of_kept.size() - 1) / kPercentile;
  std::ranges::sort(of_kept);
  found.low = of_kept[left_out];
  found.high = of_kept[of_kept.size() - 1 - left_out];
  found.width = share_of_range(p, found.high) - share_of_range(p, found.low);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k] >= found.low && values[k] <= found.high) continue;
    ++found.beyond;
    found.kept_beyond += kept[k] > 0 ? 1 : 0;
  }
}

void find_end(const JournalParameter& p, double best, ParameterImportance& found) {
  constexpr double kNear = 0.02;
  const double share = share_of_range(p, best);
  found.best = share <= kNear ? End::low : share >= 1 - kNear ? End::high : End::none;
  found.end = found.best == End::low ? p.low : p.high;
}

}  // namespace

bool ParameterImportance::narrow() const {
  constexpr double kNarrow = 0.2;
  constexpr std::uint64_t kFewest = 20;  // least number of points outside [low, high]
  constexpr std::uint64_t kOneIn = 20;   // at most one in this number of points outside is kept
  return width < kNarrow && beyond >= kFewest && kOneIn * kept_beyond <= beyond;
}

double explained(std::span<const double> parameter, std::span<const double> output) {
  const std::size_t n = output.size();
  const std::size_t most = classes(n);
  if (most < kFewestClasses) return kUnknown;
  const double mean = std::accumulate(output.begin(), output.end(), 0.0) / static_cast<double>(n);
  std::vector<double> sums(most, 0.0);
  std::vector<double> counts(most, 0.0);
  double all = 0;
  const std::vector<std::size_t> order = order_of(parameter);
  each_tie(parameter, order, [&](std::size_t from, std::size_t to) {
    const std::size_t of = from * most / n;
    for (std::size_t k = from; k < to; ++k) {
      const double off = output[order[k]] - mean;
      sums[of] += off;
      counts[of] += 1;
      all += off * off;
    }
  });
  double between = 0;
  double used = 0;
  for (std::size_t k = 0; k < most; ++k) {
    if (counts[k] == 0) continue;
    between += sums[k] * sums[k] / counts[k];
    used += 1;
  }
  if (!(all > 0) || used < 2) return kUnknown;
  const auto points = static_cast<double>(n);
  return 1 - (1 - between / all) * (points - 1) / (points - used);
}

Importance importance(Journal& journal, const Results& results) {
  const JournalHead& head = journal.head();
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < head.parameters.size(); ++k) {
    if (!head.parameters[k].drawn) chosen.push_back(k);
  }
  const Sample sample = sample_of(journal, results, chosen);
  const std::vector<std::size_t> order = ranked(results.points, head.objectives.front().maximize);
  const bool any = !order.empty() && results.points[order.front()].kept() && sample.kept.size() == results.points.size();
  const std::optional<Method> method = named<Method>(method_of(head));
  Importance found;
  found.points = sample.kept.size();
  found.kept = static_cast<std::uint64_t>(std::accumulate(sample.kept.begin(), sample.kept.end(), 0.0));
  found.even = method && !is_search(*method);
  const auto k = static_cast<double>(classes(found.points));
  // Normal approximation of the share without influence: variance 2 (k - 1) / (n - k)^2.
  found.noise = 1.645 * std::sqrt(2 * std::max(0.0, k - 1)) / std::max(1.0, static_cast<double>(found.points) - k);
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    const JournalParameter& p = head.parameters[chosen[c]];
    ParameterImportance& one = found.parameters.emplace_back();
    one.key = p.key;
    one.objective = of_objective(sample.parameters[c], sample.objective);
    one.kept = explained(sample.parameters[c], sample.kept);
    one.low = one.high = one.width = kUnknown;
    if (!p.values.empty()) continue;
    find_kept_part(p, sample.parameters[c], sample.kept, one);
    if (any && head.objectives.size() == 1) find_end(p, sample.parameters[c][order.front()], one);
  }
  std::ranges::stable_sort(found.parameters, [](const ParameterImportance& a, const ParameterImportance& b) {
    return (std::isfinite(a.objective) ? a.objective : -1) > (std::isfinite(b.objective) ? b.objective : -1);
  });
  return found;
}

}  // namespace gaitlab::studies
