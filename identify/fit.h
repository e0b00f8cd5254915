// Least-squares fits of keys to logs.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "identify/error_model.h"

namespace gaitlab::identify {

/// A fit: keys and logs to fit and the start, then the result.
struct Fit {
  Point at = {};                        ///< start, then the best point so far
  std::vector<std::size_t> logs = {};   ///< indices into the list of logs
  std::vector<ErrorModel> models = {};  ///< of these logs at `at`; empty if no run at the start was whole
  double cost = 0;                      ///< mean of ErrorModel::cost over these logs, infinite if a run is not whole
  int rounds = 0;
};

/// Minimises the cost of each fit by Levenberg and Marquardt's method within the ranges of the keys:
/// J. J. More, The Levenberg-Marquardt algorithm: implementation and theory, 1978, with a key that leaves its range held at its
/// bound. All fits take their steps together, so that their runs share lanes and threads; the result of a fit does not depend
/// on the others. A fit ends if two steps in a row gain less than 1e-3 of the cost, if no step of a hundredth of Newton's
/// length gains anything, or after 40 steps.
void solve(std::span<Fit> fits, ErrorModels& models);

/// True for a value at a bound of the key's range.
bool at_bound(const Key& key, double value);

/// The change of the keys that minimises the sum of the second-order models, in units of their scales; 0 for keys that are at a
/// bound of their range and would leave it. `damping` is Marquardt's.
Eigen::VectorXd model_step(const Fit& fit, std::span<const ErrorModel> models, const ErrorModels& of, double damping);

}  // namespace gaitlab::identify
