// One panel of a figure: values over time in a frame.
#pragma once
#include <limits>
#include <span>

#include "report/axes.h"

namespace gaitlab::report {

/// The range of what is drawn; values that are not finite do not count.
struct Bounds {
  double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();
  void add(double value);
  void add(std::span<const double> values);
  [[nodiscard]] bool empty() const { return lo > hi; }
  /// About `count` ticks; of nothing, 0 to 1.
  [[nodiscard]] Ticks ticks(int count) const;
};

struct PlotArea {
  double left = 0, right = 0, top = 0, bottom = 0;  ///< px
};

/// Grid, tick labels at the left and frame are drawn when it is made; curves over them.
class Panel {
 public:
  Panel(Svg& svg, const PlotArea& area, const Ticks& time, const Ticks& values);
  /// `values` as long as `time`; not finite: a gap. What lies outside the time axis is left out.
  void curve(std::span<const double> time, std::span<const double> values, const Style& style);
  void level(double value, const Style& style);
  void moment(double time, const Style& style);
  /// Labels below, and "time (s)".
  void time_axis();

 private:
  Svg& svg_;
  PlotArea area_;
  Ticks time_;
  Scale x_, y_;
};

}  // namespace gaitlab::report
