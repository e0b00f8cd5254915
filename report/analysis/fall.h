// How low a robot came and how far it tilted.
#pragma once
#include <optional>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

struct Fall {
  double start = 0, lowest = 0;  ///< m, height of the centre of mass; lowest of all ticks
  double lowest_time = 0;        ///< s
  double fallen_time = 0;        ///< s, at the first tick below Limits::height; the end where there is none
  double tilt = 0;               ///< rad, largest turn of the base's upright away from the vertical
  double tilt_time = 0;          ///< s
  [[nodiscard]] double share() const { return start > 0 ? lowest / start : 1; }
};

/// m, of the centre of mass at control ticks (States::at_ticks); empty: the folder has no poses.
std::vector<double> heights(const Scenario& scenario, const Recording& record);

/// At control ticks (States::at_ticks). Of a floating base on a plane, with or without boxes; none: of other runs a height says
/// nothing.
std::optional<Fall> fall(const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
