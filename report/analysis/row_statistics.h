// Statistics estimated from the rows of a trace, for folders without statistics of all steps: formats before 2, or a CSV file
// alone.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Fills Recording::ticks from the rows of the trace, one row each, and marks them (Recording::ticks_of_rows). A peak between
/// two rows is missed; integrals and shares are by trapezoids. The start of each interval that holds one command is evaluated
/// with the actuator under that command, which a row does not contain: there torques are largest. NaN: a quantity whose columns
/// are missing for a joint with a motor; 0 for a joint without one. Does nothing if there are statistics of all steps, or no
/// rows.
void fill_ticks_from_rows(const Scenario& scenario, Recording& record);

/// The first column of the trace that a column of such ticks requires and that is missing: `joint.3.speed`; empty: none.
std::string lacking(const Recording& record, const Robot& robot, TickColumn column);

/// `judged from the trace's rows, one per 15 ms: a peak between two rows is not seen`; empty: statistics of all steps.
std::string rows_sentence(const Recording& record);

/// Excess of a joint beyond its range.
struct BeyondRange {
  double worst = 0, share = 0;  ///< rad; share of the time
};
/// Excess of every joint, over all steps or, if the recording lacks their statistics, over its rows; empty: not known.
std::vector<BeyondRange> beyond_range(const Robot& robot, const Recording& record);

}  // namespace gaitlab::report
