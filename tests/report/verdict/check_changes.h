// Changes that tests of checks make to a recorded walk.
#pragma once
#include <cmath>
#include <functional>
#include <string>

#include "report/analysis/fall.h"
#include "report/analysis/summary.h"
#include "tests/report/verdict/verdict_case.h"

namespace gaitlab::test {

inline constexpr std::size_t kJoint = 5;  // whose numbers are changed
inline constexpr std::size_t kEarly = 1;  // a row before the judged window

/// The cell of a column that holds largest magnitudes.
inline Change tick(TickColumn column, double value, std::size_t row = 0) {
  return [=](Case& made) { made.tick(row == 0 ? made.last_tick() : row, kJoint, column) = value; };
}

/// A column that holds a sum: it grows by `rate` in a second, from `from` to `to`, and not at all elsewhere.
inline void grow(Case& made, TickColumn column, double rate, double from, double to) {
  for (std::size_t k = 0; k <= made.last_tick(); ++k)
    made.tick(k, kJoint, column) = rate * std::max(0.0, std::min(made.time(k), to) - from);
}

inline double window_start(const Case& made) { return made.time(summarise(made.scenario, made.record, 0).judged.first_row); }

/// A sum that grows as fast in the whole run, or before the judged window alone.
inline Change rate(TickColumn column, double value) {
  return [=](Case& made) { grow(made, column, value, 0, 1e9); };
}
inline Change early_rate(TickColumn column, double value) {
  return [=](Case& made) { grow(made, column, value, 0, window_start(made)); };
}

inline Change joint(double JointStatistics::*member, double value) {
  return [=](Case& made) { made.record.joints[kJoint].*member = value; };
}

inline Change load(const std::string& column, double value, std::size_t row = 0) {
  return [=](Case& made) { made.load(column, row == 0 ? made.record.loads.rows() - 1 : row) = value; };
}

/// The feet slide this share of 0.1 m, or before the judged window.
inline Change slides(double share, bool early = false) {
  return [=](Case& made) {
    const std::size_t last = made.record.loads.rows() - 1;
    for (std::size_t row = 0; row <= last; ++row) {
      made.load("path", row) = row == last ? 0.1 : 0;
      made.load("slip", row) = row == last || (early && row > 0) ? 0.1 * share : 0;
    }
  };
}

/// The centre of mass comes to a share of its height at the start.
inline Change sinks(double share) {
  return [=](Case& made) {
    made.pose("base.z", kEarly) += share * standing_height(made.scenario) - heights(made.scenario, made.record)[kEarly];
  };
}

/// The base tilts.
inline Change tilts(double angle) {
  return [=](Case& made) {
    const auto at = [&](const char* column) -> double& { return made.pose(std::string("base.q") + column, kEarly); };
    const Quat now = Quat(Eigen::AngleAxisd(angle, Vec3::UnitX())) *
                     Quat(made.pose("base.qw", 0), made.pose("base.qx", 0), made.pose("base.qy", 0), made.pose("base.qz", 0));
    at("w") = now.w(), at("x") = now.x(), at("y") = now.y(), at("z") = now.z();
  };
}

/// m: diagonal of the box around the robot.
inline double extent_of_gait() {
  return changed("progress", [](Case& made) { made.scenario.limits.progress = 1; }).limit;
}

/// The centre of mass goes so many extents in each period of the window, or in all before it.
inline Change goes(double extents, bool early = false) {
  return [=](Case& made) {
    const Judged judged = summarise(made.scenario, made.record, 0).judged;
    std::size_t first = 0;
    while (made.pose("t", first) < judged.from) ++first;
    const double from = made.pose("t", first);
    const double speed = extents * extent_of_gait() * static_cast<double>(judged.periods) / (judged.to - from);
    made.scenario.limits.progress = 0.5;
    for (std::size_t row = 0; row < made.record.poses.rows(); ++row) {
      const double t = made.pose("t", row);
      made.pose("com.y", row) = 0;
      made.pose("com.x", row) = early ? speed * std::min(t, from) : speed * t;
    }
  };
}

/// The torque of a joint is off by this share of its peak.
inline Change off(double share) {
  return [=](Case& made) {
    made.record.tally.estimated = true;
    made.record.tally.torque_peak.assign(made.record.joints.size(), 1.0);
    made.record.tally.torque_error.assign(made.record.joints.size(), 0.0);
    made.record.tally.torque_error[kJoint] = share;
  };
}

inline Change with_overlaps(const std::function<void(Overlaps&)>& change) {
  return [=](Case& made) { made.also = [=](Summary&, Overlaps& there) { change(there); }; };
}

}  // namespace gaitlab::test
