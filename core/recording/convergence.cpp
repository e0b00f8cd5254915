#include "core/recording/convergence.h"

#include <algorithm>
#include <cmath>

#include "core/math/functions.h"
#include "core/model/pattern.h"

namespace gaitlab {

namespace {

// Share of the scale below which a difference is a rounding error.
constexpr double kRounding = 1e-13;

// Least scale of a column, as a share of the largest value of all columns with the same unit.
constexpr double kTrifle = 1e-9;

double peak_of(const Trace& trace, std::size_t column) {
  double peak = 0;
  for (std::size_t k = 0; k < trace.rows(); ++k) peak = std::max(peak, std::abs(trace.at(k, column)));
  return peak;
}

double peak_of_unit(const Trace& trace, const std::string& unit) {
  double peak = 0;
  for (std::size_t c = 1; c < trace.columns.size(); ++c) {
    if (trace.columns[c].unit == unit) peak = std::max(peak, peak_of(trace, c));
  }
  return peak;
}

/// ConvergenceRow for `count` steps. distance(i, j) is |u(h_i) - u(h_j)| / scale.
template <class Distance>
ConvergenceRow row(const std::string& name, std::size_t count, Distance&& distance) {
  ConvergenceRow r{name};
  for (std::size_t i = 0; i + 1 < count; ++i) r.error.push_back(distance(i, count - 1));
  const double last = r.error.back();
  const double before = count > 2 ? distance(count - 3, count - 2) : 0;
  if (last > kRounding && before > kRounding) {
    const double order = math::log(before / last) / math::log(2);
    if (order >= 0.2 && order <= 8) r.order = order;
  }
  r.left = last / (math::pow(2, r.order.value_or(1)) - 1);
  return r;
}

}  // namespace

std::optional<double> ConvergenceRow::step_for(double wanted, double finest) const {
  if (!order || !(left > 0)) return std::nullopt;
  return finest * math::pow(wanted / left, 1 / *order);
}

ConvergenceRow convergence(const std::string& name, std::span<const std::vector<double>> values) {
  const std::vector<double>& finest = values.back();
  double square = 0;
  for (const double x : finest) square += x * x;
  const double scale = square > 0 ? std::sqrt(square) : 1;
  return row(name, values.size(), [&](std::size_t i, std::size_t j) {
    double sum = 0;
    for (std::size_t k = 0; k < finest.size(); ++k) sum += (values[i][k] - values[j][k]) * (values[i][k] - values[j][k]);
    return std::sqrt(sum) / scale;
  });
}

std::vector<ConvergenceRow> convergence(std::span<const Trace> traces, const std::vector<std::string>& patterns) {
  const Trace& finest = traces.back();
  std::vector<ConvergenceRow> rows;
  for (std::size_t c = 1; c < finest.columns.size(); ++c) {
    const std::string& name = finest.columns[c].name;
    if (!std::any_of(patterns.begin(), patterns.end(), [&](const std::string& p) { return glob(p, name); })) continue;
    const double peak = std::max(peak_of(finest, c), kTrifle * peak_of_unit(finest, finest.columns[c].unit));
    const double scale = (peak > 0 ? peak : 1) * std::sqrt(static_cast<double>(std::max<std::size_t>(1, finest.rows())));
    rows.push_back(row(name, traces.size(), [&](std::size_t i, std::size_t j) {
      double sum = 0;
      for (std::size_t k = 0; k < finest.rows(); ++k) {
        const double d = traces[i].at(k, c) - traces[j].at(k, c);
        sum += d * d;
      }
      return std::sqrt(sum) / scale;
    }));
  }
  return rows;
}

}  // namespace gaitlab
