// Loads of docks at the times within a step when hinges meet their stops.
#include <algorithm>
#include <cmath>

#include "core/simulation/lane.h"
#include "core/simulation/simulation.h"

namespace gaitlab {

namespace {

// The damping of a stop acts immediately, and a light hinge is at rest after 0.5 ms.
constexpr double kMeets = 2e-5;   // s; largest time from the contact with a stop to the measurement of the loads
constexpr double kStride = 5e-4;  // s; a stop that acts for longer is not missed
constexpr int kMostTries = 20;
// rad. If the distance of a joint from its stops exceeds this plus twice its way at the present speed, the joint does not meet
// them in the step, unless it gains 40 rad/s in 5 ms.
constexpr double kNearStop = 0.1;
// Joints that rattle between their stops would make a run 20 times as long. The loads at a stop grow with the speed. Meetings
// slower than this share of the joint's fastest meeting are therefore left out. The number of measured meetings is also limited
// to one per joint plus one in kStepsPerMeeting steps.
constexpr double kSlower = 0.5;
constexpr std::int64_t kStepsPerMeeting = 500;

/// Angle by which a joint is beyond a stop, rad, negative within the range, and the rate of this angle, rad/s.
struct Beyond {
  double angle = 0, speed = 0;
};

}  // namespace

bool Simulation::Lane::near_stop(const StateLayout& layout, In plant_state, std::size_t lanes, double h) const {
  const In angles = plant_state.subspan(layout.angles());
  const In speeds = plant_state.subspan(layout.speeds());
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const double q = angles[j * lanes + index];
    const double reach = kNearStop + 2 * h * std::abs(speeds[j * lanes + index]);
    if (q - reach < robot.joints[j].lo || q + reach > robot.joints[j].hi) return true;
  }
  return false;
}

/// True if the loads of a joint that meets its stop at this speed, rad/s, are to be measured.
bool Simulation::Lane::counts(std::size_t joint, double speed, std::int64_t step) {
  if (speed < kSlower * fastest[joint]) return false;
  fastest[joint] = std::max(fastest[joint], speed);
  return meetings++ < static_cast<std::int64_t>(fastest.size()) + step / kStepsPerMeeting;
}

/// Side of the stop that a joint may have met in the last step: 1, -1, or 0 for none. The joint is then beyond the stop at the
/// end of the step, or has turned back near it. `from` is the plant's state at the start of the step.
int Simulation::met_stop(const Lane& lane, std::size_t joint, In from) const {
  const std::size_t at = joint * lanes_.size() + lane.index;
  const double q = from[layout_.angles() + at];
  const double v = from[layout_.speeds() + at];
  const double q_end = plant_state_[layout_.angles() + at];
  const double v_end = plant_state_[layout_.speeds() + at];
  const Joint& own = lane.robot.joints[joint];
  if (!std::isnan(lane.changes.hold(joint))) return 0;
  for (const int side : {-1, 1}) {
    const double limit = side > 0 ? own.hi : own.lo;
    const double before = side * (q - limit);
    if (!(before < 0)) continue;  // the joint was beyond the stop already, or has no stop
    const double reach = h_ * std::max(side * v, -side * v_end);
    const bool turns = side * v > 0 && side * v_end < 0 && before + reach > 0;
    if (turns || side * (q_end - limit) > 0) return side;
  }
  return 0;
}

/// Measures the loads of docks at the first state beyond a stop that a hinge has met within the last step. Separate shorter
/// steps from the start of the step lead to this state, as to a row within a step. saved_ begins with NaN if no joint was near
/// a stop at the start of the step.
void Simulation::watch_stops() {
  if (std::isnan(saved_[0])) return;
  bool any = false;
  const In from = In(saved_).subspan(static_cast<std::size_t>(plant_state_.data() - state_.data()), plant_state_.size());
  end_.assign(plant_state_.begin(), plant_state_.end());
  std::vector<double>& history = history_at_end_;
  history.assign(plant_history_.begin(), plant_history_.end());
  for (const auto& lane : lanes_) {
    if (!watches_docks(*lane) || !lane->near_stop(layout_, from, lanes_.size(), h_)) continue;
    for (std::size_t j = 0; j < layout_.joints; ++j) {
      const int side = met_stop(*lane, j, from);
      const std::size_t at = layout_.speeds() + j * lanes_.size() + lane->index;
      if (side == 0 || !lane->counts(j, std::max(side * from[at], -side * plant_state_[at]), step_number())) continue;
      any = true;
      watch_stop(*lane, j, side);
      std::ranges::copy(end_, plant_state_.begin());
    }
  }
  if (any) std::ranges::copy(history, plant_history_.begin());
}

/// Searches for the first time when the joint is beyond its stop, by Newton's method along its free motion, and measures the
/// loads at this time.
void Simulation::watch_stop(const Lane& lane, std::size_t joint, int side) {
  const std::size_t at = joint * lanes_.size() + lane.index;
  const double limit = side > 0 ? lane.robot.joints[joint].hi : lane.robot.joints[joint].lo;
  const auto now = [&] {
    return Beyond{side * (plant_state_[layout_.angles() + at] - limit), side * plant_state_[layout_.speeds() + at]};
  };
  const auto go = [&](double t) {
    const auto saved = [&](Out part) {
      std::copy_n(saved_.begin() + (part.data() - state_.data()), part.size(), part.begin());
    };
    saved(plant_state_);
    saved(plant_history_);
    if (t > 0) plant_->advance(commands(), t);
    return now();
  };
  bool found = now().angle > 0;  // at the end of the step
  double within = 0;
  double beyond = h_;
  Beyond from = go(0);
  for (int i = 0; i < kMostTries; ++i) {
    const double free = from.speed > 0 ? std::min(kStride, -from.angle / from.speed + kMeets / 2) : kStride;
    double t = within + free;
    if (t >= beyond) {
      if (!found) return;
      t = (within + beyond) / 2;
    }
    const Beyond there = go(t);
    if (!(there.angle > 0)) {
      within = t;
      from = there;
      continue;
    }
    found = true;
    beyond = t;
    if (there.angle <= kMeets * there.speed || beyond - within <= kMeets) break;
  }
  if (!found) return;
  within_ = beyond;
  watch_docks([&](const Lane& one) { return &one == &lane; });
  within_ = 0;
}

}  // namespace gaitlab
