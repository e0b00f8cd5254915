// Bound of the search for names that messages offer instead of unknown ones.
#pragma once
#include <cstddef>

namespace gaitlab {

/// Number of problems from which no name is searched any more, because a message prints no more problems (core/errors.cpp).
inline constexpr std::size_t kMostOffers = 200;

}  // namespace gaitlab
