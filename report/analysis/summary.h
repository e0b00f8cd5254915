// Summary of a run, from which the summary numbers are computed.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/recording/judged.h"
#include "core/scenario/scenario.h"
#include "core/simulation/simulation.h"
#include "report/analysis/fall.h"
#include "report/analysis/gait.h"
#include "report/analysis/measured.h"
#include "report/analysis/posture.h"

namespace gaitlab::report {

/// Summary of a run in SI units. docs/numbers.md defines the numbers.
struct Summary {
  double wall_time = 0;  ///< s, real time of the run; the only number that differs between equal runs
  std::string build;
  Outcome outcome;
  double simulated = 0;                             ///< s, less than the duration if the run ended early
  double displacement_x = 0, displacement_y = 0;    ///< m, displacement of the centre of mass
  double distance = 0, speed = 0, path_length = 0;  ///< m, m/s, m
  double heading_change = 0;                        ///< rad, turn of the base's x axis about world z
  double cost_electrical = 0, cost_mechanical = 0;  ///< J / (N m); 0 if the robot has not moved or has no weight
  MotionCycle limit_cycle;
  Gait gait;                                      ///< period, start and growth of the set points
  double stability_max = 0, stability_share = 0;  ///< largest h lambda; share of control ticks with h lambda above 1
  std::string stability_source;
  Judged judged;
  Posture posture;                          ///< over the judged window
  std::optional<LogErrors> log;             ///< differences from the log of the real robot
  std::optional<std::optional<Fall>> fall;  ///< result of fall(); no value if it was not computed
  /// Index of the most loaded joint; 0 if no joint was judged.
  [[nodiscard]] std::size_t most_loaded() const { return judged.order.empty() ? 0 : judged.order.front(); }
};

/// Summary of an incomplete recording: only time, paths and speeds are filled in.
Summary travelled(const Recording& record);

/// Summary of a recording. Throws PluginError.
Summary summarise(const Scenario& scenario, const Recording& record, double wall_time);

}  // namespace gaitlab::report
