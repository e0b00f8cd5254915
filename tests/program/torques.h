// Difference between the torques of two runs.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/recording/recording.h"

namespace gaitlab::test {

/// RMS of the torque difference from time `from` (s) on, divided by the joint's largest torque in `truth`; value of the worst
/// joint.
inline double torques_off(const Recording& measured, const Recording& truth, double from = 0) {
  const Series time = truth.series("t");
  double worst = 0;
  for (std::size_t j = 0; j < truth.joints.size(); ++j) {
    const Series one = measured.joint(j, "torque");
    const Series other = truth.joint(j, "torque");
    double square = 0;
    double peak = 0;
    double rows = 0;
    for (std::size_t row = 0; row < other.size(); ++row) {
      if (time[row] < from) continue;
      square += std::pow(one[row] - other[row], 2);
      peak = std::max(peak, std::abs(other[row]));
      ++rows;
    }
    worst = std::max(worst, std::sqrt(square / rows) / peak);
  }
  return worst;
}

}  // namespace gaitlab::test
