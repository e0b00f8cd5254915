// What the rows of a trace tell of all steps, where a folder holds nothing else: a format before 2, or a CSV file alone.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Fills Recording::ticks from the rows, one of ticks for each, and marks them as such (Recording::ticks_of_rows). A peak
/// between two rows is not seen; integrals and shares are by trapezoids. At the start of each stretch between two rows that
/// holds one command stands what the actuator gives under that command, which a row itself does not hold: there torques are
/// largest. Not a number: a quantity whose columns the trace does not have of every joint with a motor; zeros: of a joint
/// without one. Does nothing where statistics of all steps are there, or no rows.
void fill_ticks_from_rows(const Scenario& scenario, Recording& record);

/// The first column of the trace that a column of such ticks needs and that is not there: `joint.3.speed`; empty: none lacks.
std::string lacking(const Recording& record, const Robot& robot, TickColumn column);

/// `judged from the trace's rows, one per 15 ms: a peak between two rows is not seen`; empty: of all steps.
std::string rows_sentence(const Recording& record);

/// How far a joint went beyond its range.
struct BeyondRange {
  double worst = 0, share = 0;  ///< rad; share of the time
};
/// Of every joint, over all steps, or where the recording does not know these over its rows; empty: nothing is known.
std::vector<BeyondRange> beyond_range(const Robot& robot, const Recording& record);

}  // namespace gaitlab::report
