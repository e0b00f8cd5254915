// Fitness of a point for a search: finite numbers that keep the order of points.
#pragma once
#include <vector>

#include "studies/journal/results.h"

namespace gaitlab::studies {

/// Fitness by objective, smaller is better. A kept point: its objective (negated if it is maximised), compressed beyond +-1e5
/// to below 9e5. A point that is not kept: 1e6 + its violation, at most 1e5. A failed point: 2e6 + (1 - simulated time /
/// duration), both in s.
std::vector<double> fitness(const PointResult& point, const std::vector<JournalObjective>& objectives, double duration);

/// Improvement of a value over a former best, as a share of that; for a better kind (kept, not kept, failed): 1.
double fitness_gain(double former, double value);

}  // namespace gaitlab::studies
