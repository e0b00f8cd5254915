// The states of a robot in a recording, row by row.
#pragma once
#include <array>
#include <vector>

#include "core/recording/recording.h"

namespace gaitlab::report {

/// States at many rows, as by Recording::state, but the columns are searched only once. The recording must outlive this object.
class States {
 public:
  /// States at the rows of the trace; requires has_states(robot).
  States(const Recording& recording, const Robot& robot);
  /// States at control ticks, so that results do not depend on trace.period. Has no rows if the recording consists of trace
  /// rows only (Recording::rows_alone), because poses at ticks are then unknown.
  static States at_ticks(const Recording& recording, const Robot& robot);

  [[nodiscard]] std::size_t size() const { return time_.size(); }
  [[nodiscard]] double time(std::size_t row) const { return time_[row]; }
  /// Angles and pose of the robot at a row. The speeds are set to 0.
  [[nodiscard]] RobotState operator()(std::size_t row) const;

 private:
  States() = default;
  Series time_;
  std::array<Series, 7> base_;  ///< columns x, y, z, qw, qx, qy, qz
  std::vector<Series> angles_ = {};
};

}  // namespace gaitlab::report
