#include "studies/study/population.h"

#include <algorithm>
#include <cmath>

#include "core/math/functions.h"

namespace gaitlab::studies {

std::size_t combinations(const Study& study) {
  std::size_t count = 1;
  for (const Parameter& p : study.parameters) count *= std::max<std::size_t>(1, p.values.size());
  return count;
}

std::size_t dimensions(const Study& study) {
  return static_cast<std::size_t>(std::ranges::count_if(study.parameters, [](const Parameter& p) { return p.values.empty(); }));
}

std::size_t usual_population(std::size_t dimensions) {
  constexpr std::size_t kLanes = 8;
  constexpr std::size_t kLeast = 16;
  const double wanted = 4 + 3 * math::log(static_cast<double>(dimensions));
  return std::max(kLeast, (static_cast<std::size_t>(std::ceil(wanted)) + kLanes - 1) / kLanes * kLanes);
}

std::size_t first_block(std::size_t population, std::size_t dimensions) { return std::max(population, 5 * (dimensions + 1)); }

std::uint64_t least_runs(const Study& study) {
  const std::size_t n = dimensions(study);
  const auto given = static_cast<std::size_t>(study.search.population);
  const std::size_t block = std::max(first_block(given > 0 ? given : usual_population(n), n), 1 + study.starts.size());
  return static_cast<std::uint64_t>(study.search.instances) * combinations(study) * block * study.runs_of_point();
}

}  // namespace gaitlab::studies
