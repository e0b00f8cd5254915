// A run at a glance: joints over time, coloured by the share of what their motors have.
#pragma once
#include <string>

#include "core/recording/recording.h"

namespace gaitlab::report {

/// A PNG as a data: URL for a page, one px per joint (the first on top) and `columns` px over the whole run, each the largest
/// share of Recording::ticks in it: pale 0, dark red 1. "" where the run has no joints or its folder does not know the shares.
/// The same run, the same bytes.
std::string heat_image(const Recording& record, std::size_t columns);

}  // namespace gaitlab::report
