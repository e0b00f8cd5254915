// The states of a robot in a recording, row by row.
#pragma once
#include <array>
#include <vector>

#include "core/recording/recording.h"

namespace gaitlab::report {

/// Recording::state of many rows: the columns are looked up once. The recording outlives it.
class States {
 public:
  /// At the rows of the trace; has_states(robot) holds.
  States(const Recording& recording, const Robot& robot);
  /// At control ticks, so that nothing depends on trace.period; of a folder of an older format, which does not have them, at
  /// the rows of the trace. Without rows: the folder does not have these either.
  static States at_ticks(const Recording& recording, const Robot& robot);

  [[nodiscard]] std::size_t size() const { return time_.size(); }
  [[nodiscard]] double time(std::size_t row) const { return time_[row]; }
  /// The angles and the pose of the robot at a row. Its speeds are 0.
  [[nodiscard]] RobotState operator()(std::size_t row) const;

 private:
  States() = default;
  Series time_;
  std::array<Series, 7> base_;  ///< x y z qw qx qy qz
  std::vector<Series> angles_ = {};
};

/// Whether States::at_ticks are at control ticks.
bool states_of_ticks(const Recording& recording);

}  // namespace gaitlab::report
