// Convergence of results as the step is halved.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/recording/trace.h"

namespace gaitlab {

/// Convergence of one quantity u over the steps h_0, h_0/2 ... h_n, of which h_n is the finest. All differences are relative to
/// the scale of the quantity.
struct ConvergenceRow {
  std::string name;
  /// |u(h_i) - u(h_n)| for i < n.
  std::vector<double> error = {};
  /// p = log2(|u(h_{n-2}) - u(h_{n-1})| / |u(h_{n-1}) - u(h_n)|). Nothing if a difference is only rounding or n < 2.
  std::optional<double> order = {};
  /// Error of the finest result, estimated by Richardson extrapolation: |u(h_{n-1}) - u(h_n)| / (2^p - 1), with p = 1 if there
  /// is no order.
  double left = 0;

  /// Step with the error `wanted`: h_n (wanted / left)^(1/p), where h_n is `finest`. Nothing without an order.
  [[nodiscard]] std::optional<double> step_for(double wanted, double finest) const;
};

/// Returns a row for every column that matches one of `patterns`. The norm |.| is the RMS over the rows. The scale is the
/// largest magnitude of the column in the finest trace, and at least 1e-9 of the largest magnitude of all columns with the same
/// unit. There must be at least two traces, from the coarsest step to the finest, with equal columns and rows (the same
/// scenario at other steps). Orders below 0.2 or above 8 are discarded, because they result from switching contacts or
/// rounding.
std::vector<ConvergenceRow> convergence(std::span<const Trace> traces, const std::vector<std::string>& patterns);

/// Returns the convergence of a single quantity with one vector of `values` per step. The norm |.| is the distance of two
/// vectors, and the scale is the norm of the finest vector.
ConvergenceRow convergence(const std::string& name, std::span<const std::vector<double>> values);

}  // namespace gaitlab
