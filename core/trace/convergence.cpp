#include "core/trace/convergence.h"

#include <algorithm>
#include <cmath>

namespace gaitlab {

namespace {

// Below this share of the scale a difference is rounding.
constexpr double kRounding = 1e-13;

/// Differences to the finest in `error`, and of each to the next in `next`, both relative.
ConvergenceRow row(const std::string& name, std::vector<double> error, std::span<const double> next) {
  ConvergenceRow r{name, std::move(error)};
  const double last = next.back();
  if (next.size() > 1 && last > kRounding && next[next.size() - 2] > kRounding) {
    const double order = std::log2(next[next.size() - 2] / last);
    if (order >= 0.2 && order <= 8) r.order = order;
  }
  r.left = last / (std::exp2(r.order.value_or(1)) - 1);
  return r;
}

}  // namespace

std::optional<double> ConvergenceRow::step_for(double wanted, double finest) const {
  if (!order || !(left > 0)) return std::nullopt;
  return finest * std::pow(wanted / left, 1 / *order);
}

ConvergenceRow convergence(const std::string& name, std::span<const std::vector<double>> values) {
  const std::vector<double>& finest = values.back();
  double square = 0;
  for (const double x : finest) square += x * x;
  const double scale = square > 0 ? std::sqrt(square) : 1;
  const auto distance = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(sum) / scale;
  };
  std::vector<double> error;
  std::vector<double> next;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    error.push_back(distance(values[i], finest));
    next.push_back(distance(values[i], values[i + 1]));
  }
  return row(name, std::move(error), next);
}

std::vector<ConvergenceRow> convergence(std::span<const Trace> traces, const std::vector<std::string>& patterns) {
  const Trace& finest = traces.back();
  std::vector<ConvergenceRow> rows;
  for (std::size_t c = 1; c < finest.columns.size(); ++c) {
    const std::string& name = finest.columns[c].name;
    if (!std::any_of(patterns.begin(), patterns.end(), [&](const std::string& p) { return glob(p, name); })) continue;
    double peak = 0;
    for (std::size_t k = 0; k < finest.rows(); ++k) peak = std::max(peak, std::abs(finest.at(k, c)));
    const double scale = (peak > 0 ? peak : 1) * std::sqrt(static_cast<double>(std::max<std::size_t>(1, finest.rows())));
    const auto rms = [&](const Trace& a, const Trace& b) {
      double sum = 0;
      for (std::size_t k = 0; k < finest.rows(); ++k) sum += (a.at(k, c) - b.at(k, c)) * (a.at(k, c) - b.at(k, c));
      return std::sqrt(sum) / scale;
    };
    std::vector<double> error;
    std::vector<double> next;
    for (std::size_t i = 0; i + 1 < traces.size(); ++i) {
      error.push_back(rms(traces[i], finest));
      next.push_back(rms(traces[i], traces[i + 1]));
    }
    rows.push_back(row(name, std::move(error), next));
  }
  return rows;
}

}  // namespace gaitlab
