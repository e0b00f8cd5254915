// The ground in the data of a page.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Stride in x and y of the heights that are drawn, so that they are at most 200 x 200. 1 for a ground without heights.
std::size_t height_stride(const Ground& ground);
/// JSON of the ground: plane, boxes and heights. A box that moves has the index of its columns in the recording.
nlohmann::ordered_json page_ground(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
