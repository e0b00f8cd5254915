#include "report/analysis/upright.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/model/kinematics.h"
#include "report/analysis/states.h"

namespace gaitlab::report {

namespace {

constexpr double kRounds = 1e-9;                     // s
constexpr double kNearly = 1 / std::numbers::sqrt2;  // cosine of 45 degrees

/// Interval of one period, with the sum of its turns about horizontal axes, rad, and the cosines of the least and the largest
/// tilt.
struct Stretch {
  double from, to;
  Vec3 turn = Vec3::Zero();
  double most = -1, least = 1;
  /// The turns of a base that wobbles and yaws can also add up to a whole turn, but such a base does not point both nearly
  /// upwards and nearly downwards.
  [[nodiscard]] bool whole_turn() const {
    return std::hypot(turn.x(), turn.y()) > std::numbers::pi && most > kNearly && least < -kNearly;
  }
};

std::vector<Stretch> stretches(const Judged& judged, double set_points) {
  const bool cycle = judged.periods > 0;
  const std::size_t count = cycle ? judged.periods : set_points > 0 ? 1 : 2;
  const double period = !cycle && set_points > 0 ? set_points : (judged.to - judged.from) / static_cast<double>(count);
  std::vector<Stretch> all;
  for (std::size_t k = 0; k < count; ++k) {
    const double to = judged.to - static_cast<double>(k) * period;
    all.push_back({to - period, to});
  }
  return all;
}

/// Rotation vector, rad, world axes.
Vec3 turn_between(const Quat& before, const Quat& after) {
  const Eigen::AngleAxisd turn(after * before.inverse());  // the angle is at most pi
  return turn.angle() * turn.axis();
}

/// Axes of the links that point upwards at the start.
class Axes {
 public:
  Axes(const Robot& robot, const RobotState& start) : robot_(robot), now_(robot) {
    now_.place(robot, start);
    for (const Mat3& R : now_.R) up_.push_back(R.transpose() * Vec3::UnitZ());
  }
  /// Cosine of the tilt of a state.
  [[nodiscard]] double cosine(const RobotState& state) {
    now_.place(robot_, state);
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < up_.size(); ++i) mean += robot_.links[i].mass * (now_.R[i] * up_[i]);
    const double length = mean.norm();
    return std::max(base(state), length > 0 ? mean.z() / length : -1.0);
  }
  /// Cosine of the angle between the axis of the base and the vertical.
  [[nodiscard]] double base(const RobotState& state) const { return (state.orientation * up_[0]).z(); }

 private:
  const Robot& robot_;
  Kinematics now_;
  std::vector<Vec3> up_;
};

}  // namespace

std::optional<Upright> upright(const Scenario& scenario, const Recording& r, const Judged& judged, double set_points) {
  const States states = States::at_ticks(r, *scenario.robot);
  if (scenario.base != Base::floating || states.size() == 0) return {};
  Quat before = states(0).orientation;
  Axes axes(*scenario.robot, states(0));
  std::vector<Stretch> periods = stretches(judged, set_points);
  Upright found;
  double least = 1;  // cosine of the tilt
  for (std::size_t row = 0; row < states.size(); ++row) {
    const double time = states.time(row);
    const RobotState state = states(row);
    const Quat now = state.orientation;
    const double cosine = axes.cosine(state);
    const double of_base = axes.base(state);
    if (cosine < least) {
      least = cosine;
      found.tilt_time = time;
    }
    if (cosine < 0 && !found.over) found.over = time;
    for (Stretch& period : periods) {
      if (!(time > period.from + kRounds && time < period.to + kRounds)) continue;
      period.turn += turn_between(before, now);
      period.most = std::max(period.most, of_base);
      period.least = std::min(period.least, of_base);
    }
    before = now;
  }
  found.tilt = std::acos(std::clamp(least, -1.0, 1.0));
  found.rolls = std::ranges::all_of(periods, &Stretch::whole_turn);
  return found;
}

}  // namespace gaitlab::report
