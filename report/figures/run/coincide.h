// Which curves of a figure lie on each other.
#pragma once
#include <string>
#include <vector>

#include "report/figures/run/curves.h"

namespace gaitlab::report {

/// Two curves of a panel coincide where they differ by at most 0.5 % of their range in every row that the panel shows; their
/// range is from the smallest to the largest value of both there, and at least 1e-3 of the panel's unit.
/// Chosen: it is a pixel of a panel that the two fill.
inline constexpr double kCoincide = 5e-3;

/// Groups of two runs and more, of which any two coincide in all of these panels; in the order of the runs, each of which goes
/// into the first group that it fits. A run without values, with a value that is not finite, or with other times than another
/// coincides with none.
std::vector<std::vector<std::size_t>> coinciding(const std::vector<std::vector<double>>& time,
                                                 const std::vector<CurvesPanel>& panels);

/// `a, b, c`
std::string run_names(const std::vector<std::size_t>& group, const std::vector<std::string>& of_runs);

}  // namespace gaitlab::report
