// How far the torques of one run are from another's.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/recording/recording.h"

namespace gaitlab::test {

/// RMS over the rows over the joint's peak, which counts as at least 2 % of the largest of all; of the worst joint.
inline double torque_error(const Recording& measured, const Recording& truth) {
  const std::size_t joints = truth.joints.size();
  EXPECT_EQ(measured.rows(), truth.rows());
  std::vector<double> peak(joints), square(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    const Series one = measured.joint(j, "torque");
    const Series other = truth.joint(j, "torque");
    for (std::size_t row = 0; row < other.size(); ++row) {
      peak[j] = std::max(peak[j], std::abs(other[row]));
      square[j] += std::pow(one[row] - other[row], 2) / static_cast<double>(truth.rows());
    }
  }
  const double largest = *std::max_element(peak.begin(), peak.end());
  double worst = 0;
  for (std::size_t j = 0; j < joints; ++j) worst = std::max(worst, std::sqrt(square[j]) / std::max(peak[j], 0.02 * largest));
  return worst;
}

}  // namespace gaitlab::test
