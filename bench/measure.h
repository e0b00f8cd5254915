// What a contender costs and how far its torques are from those of finer steps.
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

/// One run of loop, control and trace, the making of it left out; repeated until `least` seconds have passed.
struct Timing {
  double wall = 0, cpu = 0;  ///< s a run; cpu: of this process
};
struct Measured {
  Timing timing;
  Torques torques;  ///< of lane 0
};
/// Throws what Simulation throws.
Measured measure(const std::vector<Scenario>& lanes, double least);

double median(std::vector<double> values);  ///< 0 of none

}  // namespace gaitlab::versus
