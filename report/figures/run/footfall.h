// The footfall diagram: stance phases of each leg of a robot.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "report/plot/plot.h"

namespace gaitlab::report {

/// Time interval in which a leg carries load, s.
struct Stance {
  double from = 0, to = 0;
};

/// One row of the diagram.
struct Footfall {
  std::string name;             ///< of the leg, `m9 front left`
  std::vector<Stance> stances;  ///< in order, separated by gaps
  double duty_factor = 0;       ///< printed at the right end of the row
};

/// Intervals in which `load` (N) exceeds `threshold` (N), sampled at `time` (s, rising, of the same length): a sample counts
/// until the next one, the last one for no time. Loads that are not finite count as none.
std::vector<Stance> stances(std::span<const double> time, std::span<const double> load, double threshold);

/// Share of [from, to] (s, from < to) covered by the stances; 0 for an empty interval.
double duty_factor(const std::vector<Stance>& stances, double from, double to);

/// Height of a diagram with this number of rows, px.
double footfall_height(std::size_t rows);
inline constexpr double kFootfallHead = 30, kFootfallFoot = 26;  ///< px of it, above and below the rows

struct FootfallDiagram {
  const std::vector<Footfall>& rows;
  std::string title = {}, note = {};  ///< above the frame, at its left and over the duty factors
  PlotLook look = {.text = 12};
};

/// Draws one row per leg into a frame: its name, a bar for each stance within `time` (s), its duty factor.
void draw_footfalls(Canvas& canvas, const FootfallDiagram& diagram, const Axis& time, const PlotArea& area);

}  // namespace gaitlab::report
