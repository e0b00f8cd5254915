// A robot that has not run, as a recording with one row.
#pragma once
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Recording of pose, angles and centre of mass at the start; outcome `not run`.
Recording start_row(const Scenario& scenario);

}  // namespace gaitlab::report
