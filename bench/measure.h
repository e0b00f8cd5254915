// What a contender costs, how far its torques are from those of finer steps, and whether it walks as another does.
#pragma once
#include <string>
#include <vector>

#include "core/simulation/simulation.h"

namespace gaitlab::versus {

/// Torques of the motors, rows every trace period.
struct Torques {
  std::vector<double> time;    ///< s, a row
  std::vector<double> values;  ///< N m, row * joints + joint
  [[nodiscard]] std::size_t joints() const { return time.empty() ? 0 : values.size() / time.size(); }
};

/// Over the rows from `from` on: RMS over the rows of the difference, over the joint's largest torque in `reference`.
struct TorqueError {
  double worst = 0, median = 0;  ///< over the joints; upper median
  std::size_t joint = 0;         ///< the worst one
};
/// Both have the same rows and joints, at least one of each behind `from`. A joint that is never driven there counts as 0.
TorqueError torque_error(const Torques& torques, const Torques& reference, double from);

/// How far the robot went and what the ground carried. Two engines that differ here do not simulate the same walk, and no error
/// of a torque shows it: a robot that falls converges, too.
struct Course {
  double travel = 0;  ///< m, from the first row to the last, horizontal, of the centre of mass
  double force = 0;   ///< N, mean over the rows: normal forces of all contact elements; of a walk on a plane the robot's weight
};
/// Over the rows from `from` on; zeros without such a row.
Course course(const Recording& record, double from);
/// In which figure `seen` is more than kApart from bullet's, as a sentence; empty: in none. Travel that differs by less than 1
/// mm passes, so that robots that stay can be compared.
std::string strays(const Course& seen, const Course& bullet);
inline constexpr double kApart = 0.1;

/// One run of loop, control and trace, the making of it left out; repeated until `least` seconds have passed.
struct Timing {
  double wall = 0, cpu = 0;  ///< s a run; cpu: of this process
};
struct Measured {
  Timing timing;
  Torques torques;  ///< of lane 0
  Course course;    ///< of lane 0, rows of the second half
};
/// Throws what Simulation throws.
Measured measure(const std::vector<Scenario>& lanes, double least);

double median(std::vector<double> values);  ///< 0 of none

}  // namespace gaitlab::versus
