// Statistics estimated from the rows of a trace, for folders without statistics of all steps: older formats (below 2), or a CSV
// file alone.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Fills Recording::ticks from the rows of the trace and sets Recording::ticks_of_rows. A peak between two rows is missed;
/// integrals and shares are by the trapezoidal rule. Torques are largest just after a new command, an instant that is not in a
/// row: if one command covers the whole interval between two rows, the actuator is evaluated under it at the start of the
/// interval. A quantity is NaN if one of its columns is missing for a joint with a motor, and 0 for a joint without one. Does
/// nothing if statistics of all steps exist or the trace has no rows.
void fill_ticks_from_rows(const Scenario& scenario, Recording& record);

/// First column of the trace that is missing for computing a column of ticks, for example `joint.3.speed`. Empty if none is
/// missing.
std::string lacking(const Recording& record, const Robot& robot, TickColumn column);

/// Text `judged from the trace's rows, one per 15 ms: a peak between two rows is not seen`. Empty for statistics of all steps.
std::string rows_sentence(const Recording& record);

/// Excess of a joint's angle beyond its range.
struct BeyondRange {
  double worst = 0, share = 0;  ///< largest excess, rad; share of the time beyond the range
};
/// Excess of every joint over all steps or, if the recording lacks their statistics, over the rows of the trace. Empty if not
/// known.
std::vector<BeyondRange> beyond_range(const Robot& robot, const Recording& record);

}  // namespace gaitlab::report
