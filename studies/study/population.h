// The sizes of a search: its dimensions, its population, and the least number of runs.
#pragma once
#include <cstdint>

#include "studies/study/study.h"

namespace gaitlab::studies {

/// Number of combinations of the listed parameter values of a study. Each combination has a separate search.
std::size_t combinations(const Study& study);

/// Number of parameters that a search varies between low and high.
std::size_t dimensions(const Study& study);

/// Default population, 4 + 3 ln n for n dimensions, rounded up to a multiple of 8 and at least 16. It fills the lanes of any
/// machine.
std::size_t usual_population(std::size_t dimensions);

/// Number of points of a search's first generation.
std::size_t first_block(std::size_t population, std::size_t dimensions);

/// Least number of runs of a study with searches: those of the first generation of every search.
std::uint64_t least_runs(const Study& study);

}  // namespace gaitlab::studies
