// Axes of figures with many parameters.
#pragma once
#include "report/figures/study/many_figure.h"
#include "report/plot/ticks.h"

namespace gaitlab::report {

/// Coordinate of a value on the axis of a parameter: the value, its logarithm to base 10 on a logarithmic axis, or the index of
/// a word.
inline double place_on(const ManyAxis& axis, double value) { return axis.axis.log ? log10_of(value) : value; }

/// About `count` ticks over the range of a parameter in all points, widened by a share of the range. At most 12 words.
Ticks parameter_ticks(const ManyFigure& figure, std::size_t parameter, int count, double wider = 0);

/// Range of the values of the points that did not fail.
Bounds ended_range(const ManyFigure& figure);

/// Range of the axis of values: kept points decide it (shown_range).
Bounds value_range(const ManyFigure& figure);

/// Range of values for the colours: that of the kept points or, if these have only one value or none, that of all points with a
/// value.
Bounds colour_range(const ManyFigure& figure);

}  // namespace gaitlab::report
