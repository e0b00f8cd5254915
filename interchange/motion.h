// How a robot and what it pushes move, frame by frame: what an animation needs.
#pragma once
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::interchange {

/// Poses of one thing, a frame each; one pose only: it stays there. Quaternions have length 1 and continuous signs.
struct Way {
  std::vector<Vec3> places;  ///< m, world
  std::vector<Quat> turns;   ///< its axes -> world
};

struct Motion {
  std::vector<float> times;                 ///< of the frames, s, each greater than the one before
  Way base;                                 ///< of the base frame
  std::vector<std::vector<double>> angles;  ///< by joint, rad, a frame each
  std::vector<Way> boxes;                   ///< of `ground.boxes`

  [[nodiscard]] std::size_t frames() const { return times.size(); }
  [[nodiscard]] RobotState state(std::size_t frame) const;  ///< speeds 0
};

/// The robot as the scenario starts it, in one frame.
Motion standing(const Scenario& scenario);

/// Trace rows that are at least 1/rate s apart, and the last one. Assumes recording.has_states(robot). InputError: a number
/// that is not finite.
Motion motion(const Scenario& scenario, const Recording& recording, double rate);

/// Whether the recording holds how box `number` of `ground.boxes` moves.
bool has_way(const Recording& recording, std::size_t number);

}  // namespace gaitlab::interchange
