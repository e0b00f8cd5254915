// Error of the torques of a run relative to the torques of a more accurate run.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/recording/recording.h"

namespace gaitlab::test {

/// Peak of each joint: its largest torque from time `from` (s) on, but at least 2 % of the largest torque of all joints, N m.
inline std::vector<double> torque_peaks(const Recording& record, double from = 0) {
  std::vector<double> peaks(record.joints.size());
  for (std::size_t j = 0; j < peaks.size(); ++j) {
    const Series torque = record.joint(j, "torque");
    for (std::size_t row = 0; row < torque.size(); ++row) {
      if (record.series("t")[row] >= from - 1e-9) peaks[j] = std::max(peaks[j], std::abs(torque[row]));
    }
  }
  const double largest = *std::max_element(peaks.begin(), peaks.end());
  for (double& peak : peaks) peak = std::max(peak, 0.02 * largest);
  return peaks;
}

/// RMS of the torque difference over the rows from time `from` (s) on, divided by the joint's peak (torque_peaks); value of the
/// worst joint.
inline double torque_error(const Recording& measured, const Recording& truth, double from = 0) {
  EXPECT_EQ(measured.rows(), truth.rows());
  const std::vector<double> peaks = torque_peaks(truth, from);
  double worst = 0;
  for (std::size_t j = 0; j < peaks.size(); ++j) {
    const Series one = measured.joint(j, "torque");
    const Series other = truth.joint(j, "torque");
    double square = 0, rows = 0;
    for (std::size_t row = 0; row < other.size(); ++row) {
      if (truth.series("t")[row] < from - 1e-9) continue;
      square += std::pow(one[row] - other[row], 2);
      ++rows;
    }
    worst = std::max(worst, std::sqrt(square / rows) / peaks[j]);
  }
  return worst;
}

/// Time of the first row in which a torque differs by more than `share` of its joint's peak, s; -1 without such a row.
inline double first_error(const Recording& measured, const Recording& truth, double share) {
  const std::vector<double> peaks = torque_peaks(truth);
  for (std::size_t row = 0; row < truth.rows(); ++row) {
    for (std::size_t j = 0; j < peaks.size(); ++j) {
      if (std::abs(measured.joint(j, "torque")[row] - truth.joint(j, "torque")[row]) > share * peaks[j])
        return truth.series("t")[row];
    }
  }
  return -1;
}

}  // namespace gaitlab::test
