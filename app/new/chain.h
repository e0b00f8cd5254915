// A row of equal modules, docked end to end.
#pragma once
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::app {

/// Docks of a row of `count` modules, module k on module k - 1. The row uses the pair of faces whose normals at zero angles are
/// closest to opposite, so that it is straight. If several pairs are equally straight, the pair with the largest distance is
/// used, then the first in the list of faces. If the row is bent by more than 8 degrees at each module, it has only two
/// modules, because more could close into a ring. Empty if no two faces that can dock point away from each other. `one` is a
/// robot of one module.
std::vector<Dock> chain(const Scenario& one, int count);

}  // namespace gaitlab::app
