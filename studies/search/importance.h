// Estimates of the influence of each parameter from the points that a study happens to have, without further runs.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "studies/journal/results.h"

namespace gaitlab::studies {

enum class End { none, low, high };

/// Influence of a parameter of a study, and the part of its range with kept points. NaN if not known.
struct ParameterImportance {
  std::string key;
  double objective = 0;      ///< share of the variance in rank of the first objective, over the completed points
  double kept = 0;           ///< share of the variance of `kept` (1 or 0), over all points
  double low = 0, high = 0;  ///< 2nd and 98th percentile of the kept points, in the parameter's unit
  double width = 0;          ///< share of the range between these two (log: of the logarithm)
  std::uint64_t beyond = 0, kept_beyond = 0;  ///< points outside [low, high], and kept points among them
  End best = End::none;                       ///< end of the range within 2 % of which the best kept point lies
  double end = 0;                             ///< value of that end
  [[nodiscard]] bool narrow() const;          ///< true if hardly any point is kept outside a fifth of the range
};

struct Importance {
  std::uint64_t points = 0, kept = 0;
  bool even = true;  ///< false if a search or another program chose the points, which are then denser in some places
  double noise = 0;  ///< share that a parameter without influence exceeds in one of twenty studies
  std::vector<ParameterImportance> parameters;  ///< the most influential on the objective first
};

/// Share of the variance of `output` that a parameter alone explains, from n points: 1 - (1 - r) (n - 1) / (n - k), which
/// removes the contribution of chance (Kelley 1935). For r, the points are sorted by the parameter and divided into k classes
/// of equal size, with points of equal value in one class; r is the variance of the class means over the variance (first-order
/// index from given data: Plischke, Borgonovo, Smith 2013). At most 20 classes, of at least 20 points each. NaN for fewer than
/// 60 points, or if nothing varies.
double explained(std::span<const double> parameter, std::span<const double> output);

/// Importance of the parameters with a range or listed values. Sensitivity studies have better estimates (sensitivities()).
Importance importance(Journal& journal, const Results& results);

}  // namespace gaitlab::studies
