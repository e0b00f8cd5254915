// Trajectories with which a servo on a bench is recorded.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace gaitlab::identify {

struct TrajectorySettings {
  double amplitude = 1.57;  ///< A: largest goal, rad, below 180 degrees; from 0, the angle at which the arm hangs down
  double speed = 6;         ///< V: largest speed of a goal, rad/s
  double duration = 6;      ///< D, s
  int rate = 200;           ///< rows per second
};

/// A trajectory, one value per row.
struct Trajectory {
  const char *name, *about;
  std::vector<double> t, goal;  ///< s, rad
  std::vector<bool> on;         ///< false while the servo has no torque
};

/// The four trajectories, from t = 0 to D (kinds and proportions are those of the logs of Rhoban/bam, numbers chosen):
///
///     sweep   2/3 A sin(a t^2), a = 3/4 V / (A D): the speed rises to V
///     sines   A (0.62 sin(w t) + 0.38 sin(3.5 w t)), w = V / (3.9 A): speeds up to V / 2
///     drop    A (1 - cos(3 pi t / D)) / 2 to D / 3, then A; without torque from D / 2 on
///     slow    A (1 - cos(2 pi t / D)) / 2
///
/// A pendulum that is released at A, and an arm that overshoots 2/3 A by less than a half, stay within +-A. Throws InputError
/// if the sweep has fewer than two turns, or fewer than 20 rows in its fastest one.
std::vector<Trajectory> trajectories(const TrajectorySettings& settings);

/// CSV of a trajectory with the columns t, goal and on, for a recorder and for gait `table`.
std::string trajectory_text(const Trajectory& trajectory);

}  // namespace gaitlab::identify
