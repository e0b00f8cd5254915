// Axes of figures with many parameters.
#pragma once
#include "report/figures/study/many_figure.h"
#include "report/plot/ticks.h"

namespace gaitlab::report {

/// Place of a value on the axis of a parameter: its logarithm, the index of a word, or the value.
inline double place_on(const ManyAxis& axis, double value) { return axis.axis.log ? log10_of(value) : value; }

/// About `count` ticks for a parameter over all points, widened by a share; at most 12 words.
Ticks parameter_ticks(const ManyFigure& figure, std::size_t parameter, int count, double wider = 0);

/// Range of the values of the points that ended.
Bounds ended_range(const ManyFigure& figure);

/// Range of the colours: of the kept points, or of all points with a value if these have one value or none.
Bounds colour_range(const ManyFigure& figure);

}  // namespace gaitlab::report
