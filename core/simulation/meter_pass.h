// One part of a step into the sums and peaks of Meter: plain arrays, for code that is compiled once per processor type.
#pragma once
#include <cstddef>

#include "core/recording/statistics.h"

namespace gaitlab {

/// Number of entries that a pass takes at once: doubles in the widest registers, so that no pass has a remainder.
inline constexpr std::size_t kMeterBlock = 8;

/// Arrays of `entries` elements, a multiple of kMeterBlock; their meaning: Meter::add.
struct MeterPass {
  std::size_t entries = 0;
  double time = 0;  ///< start of the step, s
  bool instant = false, some = false;
  struct {
    const double *angle, *speed, *torque, *setpoint;
    const double *voltage, *current, *saturation, *power_in, *copper, *gear, *available;
  } in = {};
  const double *lo = nullptr, *hi = nullptr, *driven = nullptr;       ///< rad; 1: the joint has a motor, else 0
  const double *weight = nullptr, *share = nullptr, *seen = nullptr;  ///< s; s; 1 if the part is on the motion itself, else 0
  double* sums[kJointStatistics.size()] = {};
  struct {
    double *peak, *error, *limit, *speed, *envelope, *voltage, *current;
  } recent = {};  ///< since the last tick
};

void add_pass(const MeterPass& pass);
void add_pass_avx2(const MeterPass& pass);  ///< the same bits, for a processor with AVX2

}  // namespace gaitlab
