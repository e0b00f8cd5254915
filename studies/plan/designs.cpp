#include "studies/plan/designs.h"

#include <array>
#include <boost/random/sobol.hpp>
#include <numeric>
#include <utility>

#include "core/math/random.h"

namespace gaitlab::studies {

namespace {

enum class MorrisDraw : std::uint64_t { order = 101, level, direction };

}  // namespace

std::vector<double> sobol_point(std::size_t dimensions, std::uint64_t number) {
  boost::random::sobol sequence(dimensions);
  sequence.discard(number * dimensions);
  std::vector<double> shares(dimensions);
  for (double& share : shares) share = static_cast<double>(std::uint64_t{sequence()} >> 11U) * 0x1p-53;
  return shares;
}

std::vector<double> morris_shares(std::uint64_t seed, std::size_t parameters, std::uint64_t point) {
  const std::uint64_t trajectory = point / (parameters + 1);
  const std::uint64_t step = point % (parameters + 1);
  const auto draw = [&](MorrisDraw kind, std::size_t k) {
    return math::uniform({static_cast<std::uint64_t>(kind), seed, trajectory, k});
  };
  std::vector<std::size_t> order(parameters);  // shuffled by the Fisher-Yates method
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = parameters; k > 1; --k)
    std::swap(order[k - 1], order[static_cast<std::size_t>(draw(MorrisDraw::order, k) * static_cast<double>(k))]);
  std::vector<bool> moved(parameters);
  for (std::uint64_t s = 0; s < step; ++s) moved[order[s]] = true;
  constexpr std::array kLevels{0.0, 1.0 / 3, 2.0 / 3, 1.0};
  std::vector<double> shares(parameters);
  for (std::size_t k = 0; k < parameters; ++k) {
    const std::size_t low = draw(MorrisDraw::level, k) < 0.5 ? 0 : 1;
    const bool up = draw(MorrisDraw::direction, k) < 0.5;
    shares[k] = kLevels[low + (moved[k] == up ? 2 : 0)];
  }
  return shares;
}

std::vector<double> saltelli_shares(std::size_t parameters, std::uint64_t point) {
  const std::uint64_t row = point / (parameters + 2);
  const std::uint64_t block = point % (parameters + 2);
  const std::vector<double> both = sobol_point(2 * parameters, row + 1);
  std::vector<double> shares(parameters);
  for (std::size_t k = 0; k < parameters; ++k) shares[k] = both[block == 1 || block == k + 2 ? parameters + k : k];
  return shares;
}

}  // namespace gaitlab::studies
