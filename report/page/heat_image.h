// Overview picture of a run: joints over time, coloured by the used share of the available torque.
#pragma once
#include <string>

#include "core/recording/recording.h"

namespace gaitlab::report {

/// A PNG as a data: URL for a page, one px per joint (the first at the top) and `columns` px over the whole run, each the
/// largest share of Recording::ticks in it: pale 0, dark red 1. "" if the run has no joints or its folder lacks the shares. The
/// same run gives the same bytes.
std::string heat_image(const Recording& record, std::size_t columns);

}  // namespace gaitlab::report
