// What docks and feet bore, at the rows of the trace: for curves and arrows beside those of the joints.
#pragma once
#include "core/recording/recording.h"

namespace gaitlab::report {

/// Recording::loads with a row for each of the trace's, t being theirs; between two control ticks linear. NaN: `stability`
/// while no foot bears anything, at a tick or beside it. Without rows where the recording has no loads.
Trace loads_at_rows(const Recording& record);

}  // namespace gaitlab::report
