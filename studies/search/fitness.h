// What a search is told of a point: numbers that keep the order of points, and are never NaN.
#pragma once
#include <vector>

#include "studies/journal/results.h"

namespace gaitlab::studies {

/// By objective, less is better: of a kept point its objective (with the other sign where most is wanted), beyond +-1e5
/// pressed together below 9e5; of one that is not kept 1e6 + its violation, at most 1e5; of one that failed 2e6 + 1 - the share
/// of its duration (s) that it lived.
std::vector<double> fitness(const PointResult& point, const std::vector<JournalObjective>& objectives, double duration);

/// By how much a value is better than a former best, as a share of that; of a better kind (kept, not kept, failed): 1.
double fitness_gain(double former, double value);

}  // namespace gaitlab::studies
