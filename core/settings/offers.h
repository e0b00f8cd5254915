// Limit of the search for known names that messages offer instead of unknown names.
#pragma once
#include <cstddef>

namespace gaitlab {

/// Number of problems after which the search stops, because a message prints no further problems (core/errors.cpp).
inline constexpr std::size_t kMostOffers = 200;

}  // namespace gaitlab
