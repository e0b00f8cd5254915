// The sizes of a search: its dimensions, its populations, and the least number of runs that these need.
#pragma once
#include <cstdint>

#include "studies/study/study.h"

namespace gaitlab::studies {

/// Number of combinations of the listed values of a study's parameters: each has a search.
std::size_t combinations(const Study& study);

/// Number of the parameters that a search varies between low and high.
std::size_t dimensions(const Study& study);

/// 4 + 3 ln n, rounded up to a multiple of 8, at least 16: fills the lanes of any machine.
std::size_t usual_population(std::size_t dimensions);

/// Number of points of a search's first generation.
std::size_t first_block(std::size_t population, std::size_t dimensions);

/// Least number of runs for a study with searches: the first generation of every search.
std::uint64_t least_runs(const Study& study);

}  // namespace gaitlab::studies
