#include "report/analysis/states.h"

namespace gaitlab::report {

States::States(const Recording& recording, const Robot& robot)
    : time_(recording.series("t")), base_{recording.series("base.x"),  recording.series("base.y"),  recording.series("base.z"),
                                          recording.series("base.qw"), recording.series("base.qx"), recording.series("base.qy"),
                                          recording.series("base.qz")} {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) angles_.push_back(recording.joint(j, "angle"));
}

RobotState States::operator()(std::size_t row) const {
  RobotState s;
  s.position = Vec3(base_[0][row], base_[1][row], base_[2][row]);
  s.orientation = Quat(base_[3][row], base_[4][row], base_[5][row], base_[6][row]);
  for (const Series& angle : angles_) s.q.push_back(angle[row]);
  s.qd.assign(angles_.size(), 0.0);
  return s;
}

States States::at_ticks(const Recording& recording, const Robot& robot) {
  const Trace& poses = recording.poses;
  States made;
  if (poses.rows() == 0) return made;
  made.time_ = Series(poses, 0);
  for (std::size_t i = 0; i < made.base_.size(); ++i) made.base_[i] = Series(poses, 1 + i);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) made.angles_.emplace_back(poses, 1 + made.base_.size() + j);
  return made;
}

}  // namespace gaitlab::report
