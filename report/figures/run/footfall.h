// The footfall diagram: when each leg of a robot stands.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "report/plot/axes.h"

namespace gaitlab::report {

/// A stretch of time in which a leg carries load, s.
struct Stance {
  double from = 0, to = 0;
};

/// One row of the diagram.
struct Footfall {
  std::string name;             ///< of the leg, `m9 front left`
  std::vector<Stance> stances;  ///< rising, apart from one another
  double duty_factor = 0;       ///< printed at the right end of the row
};

/// Where `load` (N) exceeds `threshold` (N), sampled at `time` (s, rising, as long): a sample counts until the next one, the
/// last one for no time. Loads that are not finite are none.
std::vector<Stance> stances(std::span<const double> time, std::span<const double> load, double threshold);

/// Share of [from, to] (s, from < to) that the stances cover; 0 for an empty stretch.
double duty_factor(const std::vector<Stance>& stances, double from, double to);

/// Of a diagram with so many rows, px.
double footfall_height(std::size_t rows);
inline constexpr double kFootfallHead = 30, kFootfallFoot = 26;  ///< px of it, above and below the rows

struct FootfallDiagram {
  const std::vector<Footfall>& rows;
  std::string title = {}, note = {};  ///< above the rows, at the left and over the duty factors
  double name_size = 12;              ///< px
};

/// Draws one row per leg below `top` (px): its name, a bar for each stance within `time`, its duty factor. `x` maps s to px;
/// `time` has the lines of the panel above, whose axis serves both.
void draw_footfalls(Canvas& canvas, const FootfallDiagram& diagram, const Ticks& time, const Scale& x, double top);

}  // namespace gaitlab::report
