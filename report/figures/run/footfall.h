// The footfall diagram of a robot, with the stance phases of each leg.
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
  std::string name;             ///< name of the leg: `front left`
  std::vector<Stance> stances;  ///< in order of time, separated by gaps
  double duty_factor = 0;       ///< printed at the right end of the row
};

/// Intervals in which `load` (N) exceeds `threshold` (N). The samples at `time` (s, rising, of the same length) are constant up
/// to the next sample; the last sample has no duration. Loads that are not finite count as 0.
std::vector<Stance> stances(std::span<const double> time, std::span<const double> load, double threshold);

/// Share of the interval [from, to] (s) that the stances cover; 0 if it is empty.
double duty_factor(const std::vector<Stance>& stances, double from, double to);

/// Height of a diagram with `rows` rows, px.
double footfall_height(std::size_t rows);
inline constexpr double kFootfallHead = 30, kFootfallFoot = 26;  ///< px, parts of the height above and below the rows

/// Draws one row per leg into a frame: the name, a bar for each stance within the range of the axis `time` (s), and the duty
/// factor.
void draw_footfalls(Canvas& canvas, const std::vector<Footfall>& rows, const Axis& time, const PlotArea& area);

}  // namespace gaitlab::report
