// The states of a robot in a recording, row by row.
#pragma once
#include <array>
#include <vector>

#include "core/recording/recording.h"

namespace gaitlab::report {

/// Recording::state of many rows: the columns are looked up once. The recording outlives it.
class States {
 public:
  /// has_states(robot) holds.
  States(const Recording& recording, const Robot& robot);
  /// The angles and the pose of the robot at a row. Its speeds are 0.
  [[nodiscard]] RobotState operator()(std::size_t row) const;

 private:
  std::array<Series, 7> base_;  ///< x y z qw qx qy qz
  std::vector<Series> angles_;
};

}  // namespace gaitlab::report
