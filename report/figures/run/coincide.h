// Groups of curves that coincide in a figure.
#pragma once
#include <string>
#include <vector>

namespace gaitlab::report {

/// Largest difference of two curves that coincide, as a share of their range. The range is from the least to the largest value
/// of both curves in the panel, and at least 1e-3 of the panel's unit. The condition must be satisfied in every row. 0.5 % is
/// chosen: about one pixel of a panel that the curves fill.
inline constexpr double kCoincide = 5e-3;

/// A quantity of several runs over the shown time.
struct RunCurves {
  double from = 0;                               ///< s, start of the shown time
  std::vector<std::vector<double>> values = {};  ///< one curve per run, as long as its time
};

/// Groups of two or more runs whose curves coincide pairwise in all panels, in the order of the runs. Each run is in the first
/// group to which it fits. A run without values, with a value that is not finite, or with different times coincides with none.
std::vector<std::vector<std::size_t>> coinciding(const std::vector<std::vector<double>>& time,
                                                 const std::vector<RunCurves>& panels);

/// Names of the runs of a group: `a, b, c`.
std::string run_names(const std::vector<std::size_t>& group, const std::vector<std::string>& of_runs);

}  // namespace gaitlab::report
