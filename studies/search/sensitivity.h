// Estimates of the influence of each parameter, from the points of a sensitivity study.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/journal/results.h"

namespace gaitlab::studies {

/// An estimate with its 95 % interval, by Efron's percentile bootstrap over 500 resamples of trajectories or rows. The
/// resamples are the same for every call. NaN if not known.
struct IndexEstimate {
  double value, low, high;
};

/// A sensitivity measure with an estimate for each parameter.
struct Measure95 {
  std::string name;
  std::vector<IndexEstimate> of;
};

struct Sensitivity {
  std::string output;                   ///< name of the quantity, or text of the expression
  std::string unit;                     ///< unit of the output
  std::vector<std::string> parameters;  ///< keys of the parameters
  std::vector<Measure95> measures;      ///< the tables sort the parameters by the first measure
  std::uint64_t blocks = 0, used = 0;   ///< trajectories or rows of the study, and those of them with a value at every point
  std::uint64_t unusable = 0;           ///< number of points without a value, because they failed or the quantity is not known
  std::uint64_t not_kept = 0;           ///< number of used points that are not kept
};

/// Elementary effects (Morris 1991), in the output's unit per whole range of a parameter, from `values` by point. `mu_star` is
/// the mean of their magnitudes (Campolongo, Cariboni, Saltelli 2007), `mu` their mean, and `sigma` their standard deviation. A
/// trajectory with a value that is not finite is omitted. `sigma` requires two trajectories.
Sensitivity morris(std::uint64_t seed, std::size_t parameters, std::span<const double> values);

/// Shares of the output's variance V (Saltelli et al. 2010, table 2). `total` is a parameter's share including its
/// interactions, mean (f(A) - f(AB_i))^2 / 2V (Jansen 1999); `first` is its share alone, mean f(B) (f(AB_i) - f(A)) / V, with
/// the mean of f subtracted first. `values` are in the order of saltelli_shares. A row with a value that is not finite is
/// omitted. The shares are not known if fewer than two rows remain or if the output does not vary.
Sensitivity sobol_indices(std::size_t parameters, std::span<const double> values);

/// Method of a study, from its definition; `asked` if another program chose the points.
std::string method_of(const JournalHead& head);
/// True for the methods `morris` and `sobol_indices`.
bool of_sensitivity(const JournalHead& head);

/// Sensitivities from a journal with the method `morris` or `sobol_indices`. The outputs are the objectives, with replicates
/// combined as the study defines, and the other quantities shown, as means over the replicates. Empty for any other method.
std::vector<Sensitivity> sensitivities(Journal& journal, const Results& results);

}  // namespace gaitlab::studies
