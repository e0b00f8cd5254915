// Measurements of a contender: its cost, the error of its torques against finer steps, and its travel.
#pragma once
#include <string>
#include <vector>

#include "core/simulation/simulation.h"

namespace gaitlab::versus {

/// Motor torques of a run, in rows one trace period apart.
struct Torques {
  std::vector<double> time;    ///< s, time of each row
  std::vector<double> values;  ///< N m; the index is row * joints + joint
  [[nodiscard]] std::size_t joints() const { return time.empty() ? 0 : values.size() / time.size(); }
};

/// Torque error over the rows from a time on: RMS of the difference / largest torque of the joint in the reference.
struct RaceTorqueError {
  double worst = 0, median = 0;  ///< over the joints; upper median
  std::size_t joint = 0;         ///< index of the joint with the largest error
};
/// Torque error over the rows from `from` (s) on. Both arguments must have the same rows and joints, with at least one row in
/// that interval. The error of a joint whose reference torque is 0 throughout is 0.
RaceTorqueError torque_error(const Torques& torques, const Torques& reference, double from);

/// Travel of the robot and force on the ground. Two engines that differ in these do not simulate the same walk. Torque errors
/// do not reveal that, because the torques of a falling robot converge too.
struct Course {
  double travel = 0;  ///< m, horizontal distance of the centre of mass between the first and the last row
  double force = 0;   ///< N, sum of the normal forces of all contact elements, mean over the rows; in a walk on a plane it is
                      ///< the robot's weight
};
/// Course over the rows from `from` (s) on; zeros without such a row.
Course course(const Recording& record, double from);
/// Sentence on the travel or force in `seen` that differs by more than kApart from that in `bullet`. Empty if neither does. A
/// difference in travel below 1 mm is accepted, so that robots that do not travel can be compared.
std::string strays(const Course& seen, const Course& bullet);
inline constexpr double kApart = 0.1;

/// Mean duration of a run with control and trace, but without set-up.
struct Timing {
  double wall = 0, cpu = 0;  ///< s per run, of the clock and of this process
};
struct TimedRun {
  Timing timing;
  Torques torques;  ///< torques in lane 0
  Course course;    ///< course in lane 0, over the second half of the run
};
/// Simulates the lanes side by side, repeatedly until `least` seconds of real time have passed. Throws the exceptions of
/// Simulation.
TimedRun measure(const std::vector<Scenario>& lanes, double least);

double median(std::vector<double> values);  ///< upper median; 0 without values

}  // namespace gaitlab::versus
