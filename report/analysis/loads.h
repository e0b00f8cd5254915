// Loads of docks and feet at the rows of the trace, for curves and arrows.
#pragma once
#include "core/recording/recording.h"

namespace gaitlab::report {

/// Recording::loads interpolated linearly from control ticks to the times of the trace's rows. `stability` is NaN if no foot
/// carries a load at one of the two ticks. The table has no rows if the recording does not have loads.
Trace loads_at_rows(const Recording& record);

}  // namespace gaitlab::report
