// The sheet of a run's figure: its size and title.
#pragma once
#include <string>

#include "report/plot/canvas.h"

namespace gaitlab::report {

inline constexpr double kWidth = 1000, kTitleHeight = 44;  ///< px

/// Draws the title in the middle of the sheet, in a smaller size if it is long.
void draw_run_title(Canvas& canvas, const std::string& title);

}  // namespace gaitlab::report
