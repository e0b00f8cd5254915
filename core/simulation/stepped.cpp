#include "core/simulation/stepped.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/periods.h"
#include "core/model/kinematics.h"
#include "core/simulation/lane.h"

namespace gaitlab {

namespace {

constexpr std::size_t kClock = 3;     // numbers of save() before those of each(): steps, ended, measured
constexpr double kLatestStep = 1e15;  // of a clock that is read

}  // namespace

SteppedLanes::SteppedLanes(std::span<const Scenario> lanes)
    : simulation_(lanes, Records(Loads::left_out, false), Simulation::Role::stepped),
      steps_per_tick_(math::steps_in(lanes[0].control_period, lanes[0].physics.step)) {
  simulation_.state();  // refuses contact laws without a complete state
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    start_.emplace_back(size(l));
    save(l, start_[l]);
  }
  arrive();
}

/// Takes faults into force and measures, in lanes that have not done so at this tick.
void SteppedLanes::arrive() {
  simulation_.apply_faults();
  simulation_.sense();
}

void SteppedLanes::tick(std::span<const Action> actions) {
  Simulation& s = simulation_;
  for (const auto& lane : s.lanes_) {
    lane->action = actions[lane->index];
    if (!lane->closed) continue;
    const Outcome outcome = std::move(lane->outcome);
    load(lane->index, start_[lane->index]);  // so that an idle lane cannot produce NaN
    lane->outcome = outcome;
    lane->closed = true;
  }
  s.command();
  for (std::int64_t step = 0; step < steps_per_tick_; ++step) {
    if (step > 0) s.apply_faults();
    s.advance(s.h_, [](const Simulation::Lane&) { return true; });
    s.state_[0] += 1;
    s.check();
  }
  arrive();
  for (const auto& lane : s.lanes_) {
    lane->steer();  // the last values sent stay in force
    if (lane->closed || s.step_of(*lane) < lane->clock.steps()) continue;
    lane->outcome = {};
    lane->closed = true;
  }
}

bool SteppedLanes::ended(std::size_t lane) const { return simulation_.lanes_[lane]->closed; }
const Outcome& SteppedLanes::outcome(std::size_t lane) const { return simulation_.lanes_[lane]->outcome; }
double SteppedLanes::time(std::size_t lane) const { return simulation_.time(*simulation_.lanes_[lane]); }
Measured SteppedLanes::measured(std::size_t lane) const { return simulation_.lanes_[lane]->measured(time(lane)); }
const std::vector<double>& SteppedLanes::asked(std::size_t lane) const { return simulation_.lanes_[lane]->asked; }
double SteppedLanes::energy(std::size_t lane) const { return simulation_.lanes_[lane]->ledger[0]; }

void SteppedLanes::read(std::size_t lane, RobotState& out) const {
  simulation_.layout_.read(simulation_.plant_state_, lane, out);
}

void SteppedLanes::loads(std::size_t lane, Out by_body) const {
  const Simulation::Lane& own = *simulation_.lanes_[lane];
  std::fill(by_body.begin(), by_body.end(), 0.0);
  for (std::size_t c = 0; c < own.contacts.size(); ++c) by_body[own.contacts[c].body] += own.sample.contacts[c].fn;
}

void SteppedLanes::stop(std::size_t lane, std::string reason) {
  Simulation::Lane& own = *simulation_.lanes_[lane];
  own.closed = true;
  own.outcome = {Ended::stopped, std::move(reason)};
}

void SteppedLanes::restart(std::size_t lane) {
  load(lane, start_[lane]);
  arrive();
}

void SteppedLanes::restart(std::size_t lane, const RobotState& start) {
  load(lane, start_[lane]);
  simulation_.layout_.write(start, lane, simulation_.plant_state_);
  for (std::size_t j = 0; j < start.q.size(); ++j) simulation_.setpoint_[j * simulation_.lanes_.size() + lane] = start.q[j];
  arrive();
}

/// Calls part(numbers, index of the lane's first number, distance of its numbers) for everything that changes in a lane, except
/// its clock.
template <class Part>
void SteppedLanes::each(std::size_t lane, Part part) const {
  const Simulation& s = simulation_;
  const std::size_t lanes = s.lanes_.size();
  for (const Out all : {s.plant_state_, s.plant_history_, s.setpoint_, s.command_, s.bound_, s.within_bound_})
    part(all, lane, lanes);
  part(s.bus_, 2 * lane, 2 * lanes);
  if (!s.bus_.empty()) part(s.bus_, 2 * lane + 1, 2 * lanes);
  Simulation::Lane& own = *s.lanes_[lane];
  part(own.block, 0, 1);
  for (std::vector<double>* const values : own.values()) part(*values, 0, 1);
}

std::size_t SteppedLanes::size(std::size_t lane) const {
  std::size_t count = kClock;
  each(lane, [&](Out all, std::size_t first, std::size_t distance) {
    if (all.size() > first) count += (all.size() - first - 1) / distance + 1;
  });
  return count;
}

void SteppedLanes::save(std::size_t lane, Out to) const {
  const Simulation::Lane& own = *simulation_.lanes_[lane];
  to[0] = static_cast<double>(simulation_.step_of(own));
  to[1] = own.closed ? 1 : 0;
  to[2] = own.sensed ? 1 : 0;
  std::size_t at = kClock;
  each(lane, [&](Out all, std::size_t first, std::size_t distance) {
    for (std::size_t i = first; i < all.size(); i += distance) to[at++] = all[i];
  });
}

bool SteppedLanes::fits(std::size_t lane, In from) const {
  if (from.size() != size(lane)) return false;
  const auto whole = [](double x, double most) { return x >= 0 && x <= most && x == std::floor(x); };
  Simulation::Lane& own = *simulation_.lanes_[lane];
  std::size_t after = 0;  // numbers behind the block
  for (const std::vector<double>* const values : own.values()) after += values->size();
  const std::size_t changes = from.size() - after - own.changes.states();
  const double segments = static_cast<double>(own.changes.segments()) - 1;
  return whole(from[0], kLatestStep) && whole(from[1], 1) && whole(from[2], 1) &&
         (own.changes.states() == 0 || whole(from[changes], segments));
}

void SteppedLanes::load(std::size_t lane, In from) {
  Simulation::Lane& own = *simulation_.lanes_[lane];
  own.begun = simulation_.step_number() - static_cast<std::int64_t>(from[0]);
  own.closed = from[1] != 0;
  own.sensed = from[2] != 0;
  own.outcome = {};
  std::size_t at = kClock;
  each(lane, [&](Out all, std::size_t first, std::size_t distance) {
    for (std::size_t i = first; i < all.size(); i += distance) all[i] = from[at++];
  });
  own.cpg = own.changes.cpg();
  own.controller = own.changes.controller();
}

}  // namespace gaitlab
