// Motion of a robot and of the boxes that it pushes, frame by frame, for animations.
#pragma once
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::interchange {

/// Poses of one object, one per frame; a single pose: it does not move. Quaternions have length 1 and continuous signs.
struct Way {
  std::vector<Vec3> places;  ///< m, world
  std::vector<Quat> turns;   ///< its axes -> world
};

struct Motion {
  std::vector<float> times;                 ///< of the frames, s, strictly rising
  Way base;                                 ///< of the base frame
  std::vector<std::vector<double>> angles;  ///< by joint, rad, one per frame
  std::vector<Way> boxes;                   ///< of `ground.boxes`

  [[nodiscard]] std::size_t frames() const { return times.size(); }
  [[nodiscard]] RobotState state(std::size_t frame) const;  ///< speeds 0
};

/// Motion of one frame: the robot's initial state.
Motion standing(const Scenario& scenario);

/// Motion at trace rows that are at least 1/rate s apart, and at the last one. Requires recording.has_states(robot). Throws
/// InputError for a number that is not finite.
Motion motion(const Scenario& scenario, const Recording& recording, double rate);

/// Whether the recording contains the motion of box `number` of `ground.boxes`.
bool has_way(const Recording& recording, std::size_t number);

}  // namespace gaitlab::interchange
