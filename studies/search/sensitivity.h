// Estimates of the influence of each parameter, from the points of a sensitivity study.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/journal/results.h"

namespace gaitlab::studies {

/// An estimate with the 95 % interval of resampled trajectories or rows (Efron's percentile bootstrap, 500 samples, drawn by
/// counters: the same every time). NaN: not known.
struct Estimate {
  double value, low, high;
};

/// A measure, by parameter.
struct Measure95 {
  std::string name;
  std::vector<Estimate> of;
};

struct Sensitivity {
  std::string output;                   ///< the quantity or expression
  std::string unit;                     ///< its unit
  std::vector<std::string> parameters;  ///< keys
  std::vector<Measure95> measures;      ///< the first one orders the parameters
  std::uint64_t blocks = 0, used = 0;   ///< trajectories or rows of the study; those with a value at all points
  std::uint64_t unusable = 0;           ///< points without a value: failed, or the quantity is not known
  std::uint64_t not_kept = 0;           ///< points that are not kept but count nevertheless
};

/// Elementary effects (Morris 1991) by point, in the output's unit per whole range of a parameter: `mu_star`, the mean of their
/// magnitudes (Campolongo, Cariboni, Saltelli 2007), `mu`, their mean, `sigma`, their deviation. A trajectory with a value that
/// is not finite is left out; sigma requires two.
Sensitivity morris(std::uint64_t seed, std::size_t parameters, std::span<const double> values);

/// Shares of the output's variance by Jansen's estimators (Jansen 1999; Saltelli et al. 2010, table 2): `total`, a parameter's
/// share including its interactions, `first`, its share alone. `values` by point of saltelli_shares. Rows with a value that is
/// not finite are left out; not known if less than two are left, or if nothing varies.
Sensitivity sobol_indices(std::size_t parameters, std::span<const double> values);

/// Sensitivities from a journal whose method is `morris` or `sobol_indices`: of its objectives (as its replicates are
/// combined), and of the other quantities shown (the mean over the replicates). Empty: another method.
std::vector<Sensitivity> sensitivities(Journal& journal, const Results& results);

}  // namespace gaitlab::studies
