// Groups of curves that coincide in a figure.
#pragma once
#include <string>
#include <vector>

#include "report/figures/run/curves.h"

namespace gaitlab::report {

/// Two curves of a panel coincide if they differ by at most 0.5 % of their range in every row of the panel; their range is from
/// the smallest to the largest value of both there, and at least 1e-3 of the panel's unit. Chosen: a pixel of a panel that the
/// two fill.
inline constexpr double kCoincide = 5e-3;

/// Groups of two or more runs that pairwise coincide in all of these panels; in the order of the runs, each in the first group
/// that it fits. A run without values, with a value that is not finite, or with other times than another coincides with none.
std::vector<std::vector<std::size_t>> coinciding(const std::vector<std::vector<double>>& time,
                                                 const std::vector<CurvesPanel>& panels);

/// `a, b, c`
std::string run_names(const std::vector<std::size_t>& group, const std::vector<std::string>& of_runs);

}  // namespace gaitlab::report
