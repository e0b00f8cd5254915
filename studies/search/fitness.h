// Fitness of a point: finite numbers that rank points in a search.
#pragma once
#include "studies/journal/results.h"
#include "studies/search/rating.h"

namespace gaitlab::studies {

/// Fitness by objective; smaller is better. A kept point has its objective, negated for maximisation; a magnitude above 1e5 is
/// compressed to below 9e5. A point that is not kept has 1e6 + its violation, at most 1e5. A failed point has 2e6 + 1 -
/// simulated time / duration, with both times in s.
std::vector<double> fitness(const PointResult& point, const std::vector<JournalObjective>& objectives, double duration);

/// Rating of a point, with the fitness above.
Rating rating(const PointResult& point, const std::vector<JournalObjective>& objectives, double duration);

/// Relative improvement of a value over a former best value. It is 1 if the point is of a better kind (from worst to best:
/// failed, not kept, kept).
double fitness_gain(double former, double value);

}  // namespace gaitlab::studies
