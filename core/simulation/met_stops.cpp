// Loads of docks where hinges meet their stops, at times within a step.
#include <algorithm>
#include <cmath>

#include "core/simulation/lane.h"
#include "core/simulation/simulation.h"

namespace gaitlab {

namespace {

// A stop acts at once with its damping, and a light hinge is at rest after 0.5 ms.
constexpr double kMeets = 2e-5;   // s; largest time from the start of a stop to the loads that are measured
constexpr double kStride = 5e-4;  // s; a stop that acts for longer is not missed
constexpr int kMostTries = 20;
// rad: a joint that is farther from its stops than this and twice its way in the step does not meet them in the step, or it
// gains 40 rad/s in 5 ms.
constexpr double kNearStop = 0.1;
// Joints that rattle between their stops would make a run 20 times as long. The loads at a stop grow with the speed, so that
// slower meetings than this share of the joint's fastest are left out; and so are those beyond one per joint and one in this
// many steps.
constexpr double kSlower = 0.5;
constexpr std::int64_t kStepsPerMeeting = 500;

/// Angle beyond a stop, rad, negative within the range, and its rate, rad/s.
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

/// Side of a joint's range whose stop it may have met in the last step: 1, -1, or 0. It is then beyond the stop at the end of
/// the step, or has turned back near it. `from` is the plant's state at the start of the step.
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
    if (!(before < 0)) continue;  // it was beyond already, or without a stop
    const double reach = h_ * std::max(side * v, -side * v_end);
    const bool turns = side * v > 0 && side * v_end < 0 && before + reach > 0;
    if (turns || side * (q_end - limit) > 0) return side;
  }
  return 0;
}

/// Measures the loads of docks where a hinge meets its stop within the step that has ended: at the first state beyond the stop.
/// Separate shorter steps from the start of the step lead there, as to a row within a step. saved_ begins with NaN if no joint
/// was near a stop at the start of the step.
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

/// Searches the first time of the joint beyond its stop, by Newton's method along its free motion, and measures the loads
/// there.
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
    if (t > 0) plant_->advance(command_, t);
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
