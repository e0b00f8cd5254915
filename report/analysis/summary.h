// The figures of a run, as numbers.
#pragma once
#include <string>
#include <vector>

#include "core/recording/judged.h"
#include "core/scenario/scenario.h"
#include "core/simulation/simulation.h"
#include "report/analysis/posture.h"

namespace gaitlab::report {

/// Definitions of every figure: docs/conventions.md. SI.
struct Summary {
  double wall_time = 0;  ///< s; the only figure that two equal runs do not share
  std::string build;
  Outcome outcome;
  double simulated = 0;                             ///< s, less than the duration where the run stopped early
  double displacement_x = 0, displacement_y = 0;    ///< of the centre of mass, m
  double distance = 0, speed = 0, path_length = 0;  ///< m, m/s, m
  double heading_change = 0;                        ///< rad, of the base's x axis about world z
  double cost_electrical = 0, cost_mechanical = 0;  ///< J / (N m); 0 where the robot has not moved or weighs nothing
  MotionCycle limit_cycle;
  double set_point_period = 0;                    ///< s, gait_period.h; 0: the set points do not repeat
  double stability_max = 0, stability_share = 0;  ///< h lambda; share of control ticks above 1
  std::string stability_source;
  Judged judged;
  Posture posture;  ///< over the judged window
  /// The joint to look at first; 0 where there is none.
  [[nodiscard]] std::size_t most_loaded() const { return judged.order.empty() ? 0 : judged.order.front(); }
};

/// Of a recording of which little is known yet: time, ways and speeds alone.
Summary travelled(const Recording& record);

/// Throws PluginError.
Summary summarise(const Scenario& scenario, const Recording& record, double wall_time);

}  // namespace gaitlab::report
