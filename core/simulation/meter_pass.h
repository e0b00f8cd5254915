// Pass that adds one part of a step to the sums and peaks of Meter, on plain arrays, in code that is compiled per processor
// type.
#pragma once
#include <cstddef>

#include "core/recording/statistics.h"

namespace gaitlab {

/// Number of doubles in the widest registers. The length of all arrays is a multiple of this number, so that no pass has a
/// remainder.
inline constexpr std::size_t kMeterBlock = 8;

/// Arrays with `entries` elements, a multiple of kMeterBlock. Meter::add explains their meaning.
struct MeterPass {
  std::size_t entries = 0;
  double time = 0;  ///< start of the step, s
  bool instant = false, some = false;
  struct {
    const double *angle, *speed, *torque, *setpoint;
    const double *voltage, *current, *saturation, *power_in, *copper, *gear, *dry, *available;
  } in = {};
  const double *lo = nullptr, *hi = nullptr, *driven = nullptr;  ///< lo, hi: rad; driven: 1 for a joint with a motor, else 0
  const double *weight = nullptr, *share = nullptr, *seen = nullptr;  ///< weight, share: s; seen: 1 if peaks count, else 0
  double* sums[kJointStatistics.size()] = {};
  struct {
    double *peak, *error, *limit, *speed, *envelope, *voltage, *current;
  } recent = {};  ///< peaks since the last tick
};

void add_pass(const MeterPass& pass);
void add_pass_avx2(const MeterPass& pass);  ///< add_pass for a processor with AVX2, with the same bits

}  // namespace gaitlab
