#include "report/analysis/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/scenario/change_section.h"
#include "report/analysis/states.h"

namespace gaitlab::report {

namespace {

constexpr double kOnGrid = 1e-6;  // share of the spacing; times are whole steps, except for rounding

Series of_joint(const Recording& r, std::size_t joint, const char* quantity) {
  return r.pose(fmt::format("joint.{}.{}", joint, quantity));
}

/// Number of evenly spaced rows, and their spacing.
struct Grid {
  std::size_t rows = 0;
  double spacing = 0;  ///< s
};

/// Evenly spaced rows of the motion. The last row is left out if the run ends between two of them.
Grid grid(const Scenario& scenario, const Recording& r) {
  const Series t = r.pose("t");
  if (t.size() < 2) return {};
  // Rows are at every control tick or, for short control periods and long runs, at every nth tick.
  const double ticks = std::max(1.0, std::round(t[1] / scenario.control_period));
  Grid made{0, ticks * scenario.control_period};
  const auto on_grid = [&](std::size_t k) {
    return std::abs(t[k] - static_cast<double>(k) * made.spacing) <= kOnGrid * made.spacing;
  };
  while (made.rows < t.size() && on_grid(made.rows)) ++made.rows;
  return made;
}

/// Cycle in the rows at or after the time `since`, s.
MotionCycle cycle(const Grid& grid, const std::vector<Series>& columns, double since) {
  const auto first = since > 0 ? static_cast<std::size_t>(std::ceil(since / grid.spacing - kOnGrid)) : 0;
  std::vector<double> all;
  all.reserve(grid.rows * columns.size());
  for (std::size_t k = first; k < grid.rows; ++k) {
    for (const Series& column : columns) all.push_back(column[k]);
  }
  MotionCycle found = find_limit_cycle(all, columns.size(), grid.spacing);
  if (found.found && first > 0) found.from += static_cast<double>(first) * grid.spacing;
  return found;
}

}  // namespace

Motion motion(const Recording& r) {
  const auto of = [&](const char* column) { return r.pose(column); };
  return {of("t"), of("com.x"), of("com.y"), of("com.z"), of("base.qw"), of("base.qx"), of("base.qy"), of("base.qz")};
}

double heading_change(const Motion& m, std::size_t from, std::size_t to) {
  const auto turn = [&](std::size_t k) { return Quat(m.qw[k], m.qx[k], m.qy[k], m.qz[k]); };
  double sum = 0;
  for (std::size_t k = from + 1; k <= to; ++k) {
    const Quat between = turn(k) * turn(k - 1).conjugate();
    sum += std::remainder(2 * math::atan2(between.z(), between.w()), 2 * std::numbers::pi);
  }
  return sum;
}

Series ground_load(const Scenario& scenario, const Recording& r) {
  const bool borne = scenario.base == Base::floating && !contact_elements(*scenario.robot, scenario.contact.on).empty();
  return borne ? r.pose("load") : Series();
}

std::vector<Series> set_points(const Scenario& scenario, const Recording& r) {
  std::vector<Series> found;
  for (std::size_t j = 0; j < scenario.robot->joints.size() && scenario.actuator.entry != nullptr; ++j) {
    if (!scenario.robot->joints[j].driven()) continue;
    if (const Series one = of_joint(r, j, "setpoint"); !one.empty()) found.push_back(one);
  }
  return found;
}

MotionCycle limit_cycle(const Scenario& scenario, const Recording& r) {
  std::vector<Series> columns;
  for (std::size_t j = 0; j < scenario.robot->joints.size(); ++j) {
    if (const Series angle = of_joint(r, j, "angle"); !angle.empty()) columns.push_back(angle);
  }
  for (const Series& one : set_points(scenario, r)) columns.push_back(one);
  return columns.empty() ? MotionCycle() : cycle(grid(scenario, r), columns, last_change(scenario, r.simulated));
}

MotionCycle set_point_cycle(const Scenario& scenario, const Recording& r) {
  const std::vector<Series> columns = set_points(scenario, r);
  return columns.empty() ? MotionCycle() : cycle(grid(scenario, r), columns, last_change(scenario, r.simulated));
}

}  // namespace gaitlab::report
