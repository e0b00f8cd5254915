// Changes of a recorded walk by the tests of checks.
#pragma once
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "report/analysis/fall.h"
#include "report/analysis/motion.h"
#include "report/analysis/summary.h"
#include "tests/report/verdict/verdict_case.h"

namespace gaitlab::test {

inline constexpr std::size_t kChanged = 5;  // number of the joint whose values are changed
inline constexpr std::size_t kEarly = 1;    // number of a row before the judged window

/// Sets the cell of joint kChanged in a row of ticks; row 0 means the last row.
inline Change tick(TickColumn column, double value, std::size_t row = 0) {
  return [=](Case& made) { made.tick(row == 0 ? made.last_tick() : row, kChanged, column) = value; };
}

/// Sets a column of ticks that contains a sum. The sum grows by `rate` per second between times `from` and `to`, and is
/// constant at other times.
inline void grow(Case& made, TickColumn column, double rate, double from, double to) {
  for (std::size_t k = 0; k <= made.last_tick(); ++k)
    made.tick(k, kChanged, column) = rate * std::max(0.0, std::min(made.time(k), to) - from);
}

inline double window_start(const Case& made) { return made.time(summarise(made.scenario, made.record, 0).judged.first_row); }

/// Sets a sum that grows at a constant rate in the whole run. `early_rate` limits the growth to the time before the window.
inline Change rate(TickColumn column, double value) {
  return [=](Case& made) { grow(made, column, value, 0, 1e9); };
}
inline Change early_rate(TickColumn column, double value) {
  return [=](Case& made) { grow(made, column, value, 0, window_start(made)); };
}

inline Change joint(double JointStatistics::*member, double value) {
  return [=](Case& made) { made.record.joints[kChanged].*member = value; };
}

inline Change load(const std::string& column, double value, std::size_t row = 0) {
  return [=](Case& made) { made.load(column, row == 0 ? made.record.loads.rows() - 1 : row) = value; };
}

/// Sets a path of 0.1 m of the feet, of which they slide `share`. With `early`, they slide only before the judged window.
inline Change slides(double share, bool early = false) {
  return [=](Case& made) {
    const std::size_t last = made.record.loads.rows() - 1;
    for (std::size_t row = 0; row <= last; ++row) {
      made.load("path", row) = row == last ? 0.1 : 0;
      made.load("slip", row) = row == last || (early && row > 0) ? 0.1 * share : 0;
    }
  };
}

/// Lets the feet creep along x by `share` of the travel. With `early`, they creep only before the judged window.
inline Change creeps(double share, bool early = false) {
  return [=](Case& made) {
    const Motion m = motion(made.record);
    const std::size_t from = summarise(made.scenario, made.record, 0).judged.first_row;
    const std::size_t last = made.record.loads.rows() - 1;
    for (std::size_t row = 0; row <= last; ++row) {
      const bool crept = row == last || (early && row > 0);
      made.load("creep.x", row) = crept ? share * std::hypot(m.x[last] - m.x[from], m.y[last] - m.y[from]) : 0;
      made.load("creep.y", row) = 0;
    }
  };
}

/// Takes the motor of joint kChanged away, and holds the joint beyond its stop, rad.
inline Change rests_on_stop(double beyond) {
  return [=](Case& made) {
    const auto robot = std::make_shared<Robot>(*made.scenario.robot);
    robot->joints[kChanged].passive.emplace();
    made.scenario.robot = robot;
    made.record.joints[kChanged].range_worst = beyond;
  };
}

/// Lowers the centre of mass in row kEarly to `share` of the standing height.
inline Change sinks(double share) {
  return [=](Case& made) {
    made.pose("base.z", kEarly) += share * standing_height(made.scenario) - heights(made.scenario, made.record)[kEarly];
  };
}

/// Tilts the base in row kEarly by `angle`, rad.
inline Change tilts(double angle) {
  return [=](Case& made) {
    const auto at = [&](const char* column) -> double& { return made.pose(std::string("base.q") + column, kEarly); };
    const Quat now = Quat(Eigen::AngleAxisd(angle, Vec3::UnitX())) *
                     Quat(made.pose("base.qw", 0), made.pose("base.qx", 0), made.pose("base.qy", 0), made.pose("base.qz", 0));
    at("w") = now.w(), at("x") = now.x(), at("y") = now.y(), at("z") = now.z();
  };
}

/// Diagonal of the bounding box of the robot, m.
inline double extent_of_gait() {
  return changed("progress", [](Case& made) { made.scenario.limits.progress = 1; }).limit;
}

/// Moves the centre of mass along x by `extents` diagonals per period of the window. With `early`, it stops at the start of the
/// window.
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

/// Sets the estimated torque error of joint kChanged, as a share of its largest torque.
inline Change off(double share) {
  return [=](Case& made) {
    made.record.tally.estimated = true;
    made.record.tally.torque_peak.assign(made.record.joints.size(), 1.0);
    made.record.tally.torque_error.assign(made.record.joints.size(), 0.0);
    made.record.tally.torque_error[kChanged] = share;
  };
}

inline Change with_overlaps(const std::function<void(Overlaps&)>& change) {
  return [=](Case& made) { made.also = [=](Summary&, Overlaps& there) { change(there); }; };
}

}  // namespace gaitlab::test
