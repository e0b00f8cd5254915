// Points of designs, whose coordinates are shares of parameter ranges: 0 is low, 1 is high.
#pragma once
#include <cstdint>
#include <vector>

namespace gaitlab::studies {

/// A point of a Sobol sequence in the unit cube.
std::vector<double> sobol_point(std::size_t dimensions, std::uint64_t number);

/// Point of a design by Morris (1991) on four levels. Each trajectory begins at a random point of {0, 1/3, 2/3, 1}^n and
/// changes one parameter after the other, in a random order, by 2/3 up or down. Point number k is step k mod (n + 1) of
/// trajectory k / (n + 1).
std::vector<double> morris_shares(std::uint64_t seed, std::size_t parameters, std::uint64_t point);

/// Point of a design by Saltelli et al. (2010). Rows A and B are the halves of one row of a Sobol sequence in 2n dimensions.
/// The middle of the box is left out, because A, B and all AB_k would be the same point there. AB_k is A with parameter k taken
/// from B. Point number k belongs to row k / (n + 2), in the order A, B, AB_1 ... AB_n.
std::vector<double> saltelli_shares(std::size_t parameters, std::uint64_t point);

}  // namespace gaitlab::studies
