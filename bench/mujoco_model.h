// A model and its state in MuJoCo, and walks of exported robots there.
#pragma once
#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

struct MujocoDelete {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};
using MujocoModel = std::unique_ptr<mjModel, MujocoDelete>;
using MujocoData = std::unique_ptr<mjData, MujocoDelete>;

/// Compiles a model. Throws RunError with MuJoCo's message.
MujocoModel load_mjcf(const std::string& mjcf);

namespace versus {

/// Numbers of a walk from `from` to its end.
struct Walk {
  double travel = 0;         ///< horizontal distance of the centre of mass between the two times, m
  double torque = 0;         ///< RMS of the torque over all motors and trace rows, N m
  std::vector<double> rms;   ///< N m, RMS of each motor; the others are 0
  std::vector<double> peak;  ///< N m, largest |torque| of each motor
  double height = 0;         ///< height of the centre of mass at the end, m
};

/// Walk of a run with the columns joint.* and com.*.
Walk recorded_walk(const Recording& record, double from);

/// Controls between two ticks of the controller: held at the values of the last tick, or interpolated linearly to those of the
/// next.
enum class BetweenTicks { held, line };

/// Walk in MuJoCo of the exported robot, from keyframe `start`, with the set points of a run as controls. Throws RunError if
/// MuJoCo warns, for example about a diverged simulation.
Walk walk_in_mujoco(const std::string& mjcf, const Scenario& scenario, const Recording& record, double from,
                    BetweenTicks between);

}  // namespace versus
}  // namespace gaitlab
