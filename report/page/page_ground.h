// The ground as a page draws it.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Plane, boxes (with the number of the columns of those that move) and heights, thinned to at most 200 x 200 points.
nlohmann::ordered_json page_ground(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
