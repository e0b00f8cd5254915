#include "studies/search/fitness.h"

#include <algorithm>
#include <cmath>

namespace gaitlab::studies {

namespace {

constexpr double kNotKept = 1e6, kFailed = 2e6;
constexpr double kMost = 1e5;  // largest magnitude of an objective that remains unchanged, and largest violation

double pressed(double value) {
  const double size = std::abs(value);
  return size <= kMost ? value : std::copysign(kMost * (9 - 8 * (kMost / size)), value);
}

double kind(double fitness) { return fitness >= kFailed ? kFailed : fitness >= kNotKept ? kNotKept : 0; }

}  // namespace

std::vector<double> fitness(const PointResult& point, const std::vector<JournalObjective>& objectives, double duration) {
  std::vector<double> values;
  for (std::size_t k = 0; k < objectives.size(); ++k) {
    const double value = point.score.objectives[k];
    if (point.failed > 0) {
      values.push_back(kFailed + 1 - std::clamp(point.lived / duration, 0.0, 1.0));
    } else if (!point.kept() || std::isnan(value)) {
      values.push_back(kNotKept + std::min(std::isnan(point.score.violation) ? kMost : point.score.violation, kMost));
    } else {
      values.push_back(pressed(objectives[k].maximize ? -value : value));
    }
  }
  return values;
}

Rating rating(const PointResult& point, const std::vector<JournalObjective>& objectives, double duration) {
  Rating rating{.fitness = fitness(point, objectives, duration)};
  if (point.failed > 0) return rating;
  rating.objective = objectives.front().maximize ? -point.score.objective() : point.score.objective();
  rating.violation = point.score.violation;
  return rating;
}

double fitness_gain(double former, double value) {
  if (!(value < former)) return 0;
  if (kind(former) != kind(value)) return 1;
  const double within = former - kind(former);
  return within == 0 ? 1 : (former - value) / std::abs(within);
}

}  // namespace gaitlab::studies
