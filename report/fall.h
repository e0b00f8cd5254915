// How low a robot came and how far it tilted.
#pragma once
#include <optional>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

struct Fall {
  double start = 0, lowest = 0;  ///< m, height of the centre of mass; lowest of all rows
  double lowest_time = 0;        ///< s
  double fallen_time = 0;        ///< s, of the first row below Limits::height; the end where there is none
  double tilt = 0;               ///< rad, largest turn of the base's upright away from the vertical
  double tilt_time = 0;          ///< s
  [[nodiscard]] double share() const { return start > 0 ? lowest / start : 1; }
};

/// Of a floating base on a plane, with or without boxes; none: of other runs a height says nothing.
std::optional<Fall> fall(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
