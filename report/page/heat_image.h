// Overview picture of a run: the share of the available torque that each joint uses over time.
#pragma once
#include <string>

#include "core/recording/recording.h"

namespace gaitlab::report {

/// PNG as a data: URL for a page. Each joint is one row of pixels, the first joint at the top; `columns` pixels cover the whole
/// run. The colour is the largest share of the available torque (Recording::ticks) within the pixel's time, from pale (0) to
/// dark red (1). Returns "" if the run has no joints or the recording lacks the shares. The same run produces the same bytes.
std::string heat_image(const Recording& record, std::size_t columns);

}  // namespace gaitlab::report
