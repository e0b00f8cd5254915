// Motion of a robot and of the boxes that it pushes, as frames of an animation.
#pragma once
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::interchange {

/// Poses of one object, one pose per frame, or a single pose if it does not move. Quaternions have unit length and continuous
/// signs.
struct Way {
  std::vector<Vec3> places;  ///< m, position in the world
  std::vector<Quat> turns;   ///< rotation from the object's axes to the world's axes
};

struct RobotMotion {
  std::vector<float> times;                 ///< s, times of the frames, strictly rising
  Way base;                                 ///< poses of the base frame
  std::vector<std::vector<double>> angles;  ///< rad; one list per joint with one angle per frame
  std::vector<Way> boxes;                   ///< poses of the boxes in `ground.boxes`

  [[nodiscard]] std::size_t frames() const { return times.size(); }
  [[nodiscard]] RobotState state(std::size_t frame) const;  ///< pose and angles; the speeds are 0
};

/// Motion with a single frame, the robot's initial state.
RobotMotion standing(const Scenario& scenario);

/// Motion at the last trace row and at trace rows that are at least 1/rate s apart. Requires recording.has_states(robot).
/// Throws InputError for a number that is not finite.
RobotMotion motion(const Scenario& scenario, const Recording& recording, double rate);

/// True if the recording contains the motion of box `number` in `ground.boxes`.
bool has_way(const Recording& recording, std::size_t number);

}  // namespace gaitlab::interchange
