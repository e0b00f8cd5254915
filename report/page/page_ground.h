// The ground in a page.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Stride of the heights that are drawn in x and in y, so that there are at most 200 x 200; 1 for other grounds.
std::size_t height_stride(const Ground& ground);
/// Plane, boxes (with the number of the columns of moving ones) and heights.
nlohmann::ordered_json page_ground(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
