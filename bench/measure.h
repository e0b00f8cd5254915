// Measurements of a contender: its cost, the error of its torques against finer steps, and its travel compared with another's.
#pragma once
#include <string>
#include <vector>

#include "core/simulation/simulation.h"

namespace gaitlab::versus {

/// Torques of the motors, at rows every trace period.
struct Torques {
  std::vector<double> time;    ///< s, one per row
  std::vector<double> values;  ///< N m, row * joints + joint
  [[nodiscard]] std::size_t joints() const { return time.empty() ? 0 : values.size() / time.size(); }
};

/// Torque error over the rows from `from` on: RMS of the difference over the joint's largest torque in `reference`.
struct TorqueError {
  double worst = 0, median = 0;  ///< over the joints; upper median
  std::size_t joint = 0;         ///< the worst one
};
/// Both have the same rows and joints, at least one of each after `from`. A joint that is never driven there counts as 0.
TorqueError torque_error(const Torques& torques, const Torques& reference, double from);

/// Travel of the robot and force on the ground. Two engines that differ here do not simulate the same walk, which torque errors
/// do not show: a robot that falls converges also.
struct Course {
  double travel = 0;  ///< m, from the first row to the last, horizontal, of the centre of mass
  double force = 0;  ///< N, mean over the rows: normal forces of all contact elements; for a walk on a plane the robot's weight
};
/// Course over the rows from `from` on; zeros without such a row.
Course course(const Recording& record, double from);
/// Sentence on a number of `seen` that differs by more than kApart from bullet's; empty: none does. A difference in travel
/// below 1 mm is accepted, so that robots that do not travel can be compared.
std::string strays(const Course& seen, const Course& bullet);
inline constexpr double kApart = 0.1;

/// Duration of one run of loop, control and trace, without set-up; repeated until `least` seconds have passed.
struct Timing {
  double wall = 0, cpu = 0;  ///< s per run; cpu: of this process
};
struct Measured {
  Timing timing;
  Torques torques;  ///< of lane 0
  Course course;    ///< of lane 0, rows of the second half
};
/// Throws what Simulation throws.
Measured measure(const std::vector<Scenario>& lanes, double least);

double median(std::vector<double> values);  ///< 0 for none

}  // namespace gaitlab::versus
