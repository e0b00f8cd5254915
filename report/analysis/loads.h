// Loads of docks and feet at the rows of the trace, for curves and arrows.
#pragma once
#include "core/recording/recording.h"

namespace gaitlab::report {

/// Recording::loads at the times of the trace's rows, linear between two control ticks. NaN: `stability` while no foot bears a
/// load, at a tick or beside it. Without rows if the recording has no loads.
Trace loads_at_rows(const Recording& record);

}  // namespace gaitlab::report
