// Convergence of results as the step is halved.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/recording/trace.h"

namespace gaitlab {

/// Convergence of one quantity u over steps h_0, h_0/2 ... h_n (the finest). All relative to the quantity's scale.
struct ConvergenceRow {
  std::string name;
  /// |u(h_i) - u(h_n)| for i < n.
  std::vector<double> error = {};
  /// p = log2(|u(h_{n-2}) - u(h_{n-1})| / |u(h_{n-1}) - u(h_n)|); none if nothing changes or n < 2.
  std::optional<double> order = {};
  /// Estimated error of the finest result by Richardson: |u(h_{n-1}) - u(h_n)| / (2^p - 1); p = 1 without an order.
  double left = 0;

  /// Step with the error `wanted`: h_n (wanted / left)^(1/p). None without an order.
  [[nodiscard]] std::optional<double> step_for(double wanted, double finest) const;
};

/// A row for every column that matches one of `patterns`: |.| is the RMS over the rows, its scale the column's largest
/// magnitude in the finest trace, at least 1e-9 of the largest of its unit there. The traces have the same columns and rows
/// (the same scenario at other steps), coarsest first, at least two. Orders below 0.2 or above 8 are discarded: they result
/// from switching contacts or rounding.
std::vector<ConvergenceRow> convergence(std::span<const Trace> traces, const std::vector<std::string>& patterns);

/// The same for a single quantity, |.| a distance in `values` (one vector per step), its scale the norm of the finest.
ConvergenceRow convergence(const std::string& name, std::span<const std::vector<double>> values);

}  // namespace gaitlab
