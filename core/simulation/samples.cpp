// Samples of a simulation, for its recorders: at rows of the trace, at control ticks, and at the end.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/simulation/lane.h"
#include "core/simulation/simulation.h"

namespace gaitlab {

Rotors Simulation::rotors(const Lane& lane) const {
  return {actuator_ == nullptr ? In() : actuator_->reflected_inertia(), lanes_.size(), lane.index};
}

/// Reads state, centre of mass and contacts from the plant. If `places`, computes also the kinematics of all bodies.
void Simulation::read_state(Lane& lane, bool places) {
  Sample& s = lane.sample;
  layout_.read(plant_state_, lane.index, s.state);
  const std::optional<Vec3> com = plant_->com(lane.index);
  if (places || !com) s.forward_kinematics(lane.robot);
  if (com) s.sums.com = *com;
  plant_->contacts(lane.index, s.contacts);
}

/// Fills the sample of the lane at the present time. `places` is passed to read_state.
Sample& Simulation::take_sample(Lane& lane, bool places) {
  const std::size_t lanes = lanes_.size();
  const std::size_t l = lane.index;
  Sample& s = lane.sample;
  s.t = time();
  read_state(lane, places);
  s.place_boxes(*plant_);
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    const std::size_t i = j * lanes + l;
    s.setpoint[j] = setpoint_[i];
    s.command[j] = command_[i];
    s.voltage[j] = voltage_[i];
    s.current[j] = current_[i];
    s.saturation[j] = saturation_[i];
    s.torque[j] = torque_[i];
    s.friction[j] = friction_[i];
  }
  if (bounded_) {
    for (std::size_t b = 0; b < lane.supply.buses(); ++b) {
      s.bus_voltage[b] = bus_[2 * (b * lanes + l)];
      s.bus_current[b] = bus_[2 * (b * lanes + l) + 1];
    }
  }
  s.sticks = rubs_ && plant_->holds_hinges();
  lane.read_changes(s);
  s.compute_hinges(lane.robot, lane.passive);
  std::copy(lane.cpg_state.begin(), lane.cpg_state.end(), s.cpg.begin());
  std::ranges::copy(lane.sensors.values(), s.sensed.begin());
  plant_->tally(l, s.tally);
  if (step_error_ && lane.scenario.physics.estimate == Estimate::full) step_error_->put(l, s.tally);
  s.ledger = Ledger::of(lane.ledger, s.energy(lane.robot, rotors(lane), lane.passive) - lane.energy_at_start);
  return s;
}

/// Computes motor quantities and contacts as left limits, under the command in force.
void Simulation::observe() {
  evaluate_motors(motor_speeds());
  evaluate_torques(within_);
  plant_->update_contacts();
}

void Simulation::record() {
  observe();
  for (const auto& lane : lanes_) {
    if (!trace_tick(*lane)) continue;
    record(*lane);
    if (lane->clock.ends(step_number())) end(*lane);
  }
}

void Simulation::record(Lane& lane) {
  Recorder& recorder = *lane.recorder;
  if (!recorder.has_rows()) return;
  Sample& s = take_sample(lane, recorder.wants_places());
  if (recorder.wants_reactions()) s.compute_reactions(lane.contacts, *plant_, lane.index);
  recorder.add_row();
}

/// Records rows and ends of lanes within the step that starts now. A separate shorter step leads to each row or end. The state
/// is then restored, so that results do not depend on the rows.
void Simulation::record_within_step() {
  if (!scenarios_[0].physics.adaptive_step) return;
  for (double at = 0;;) {
    const auto next = [&](const Lane& lane) {
      return lane.closed || !recorded(lane) ? std::numeric_limits<double>::infinity()
                                            : lane.clock.row_within(step_number(), at);
    };
    double row = std::numeric_limits<double>::infinity();
    for (const auto& lane : lanes_) row = std::min(row, next(*lane));
    if (!std::isfinite(row)) return;
    std::ranges::copy(state_, saved_.begin());
    const auto ends = [&](const Lane& lane) {
      return recorded(lane) && !lane.closed && lane.clock.ends_within(step_number(), row);
    };
    advance(row, ends);
    ended_.clear();
    for (const auto& lane : lanes_) {
      if (ends(*lane)) ended_.push_back(lane.get());
    }
    within_ = row;
    observe();
    for (const auto& lane : lanes_) {
      if (next(*lane) <= row) record(*lane);
    }
    for (Lane* lane : ended_) {
      check(*lane);
      if (!lane->closed) close(*lane);
    }
    within_ = 0;
    std::ranges::copy(saved_, state_.begin());
    if (lanes_.size() > 1) {
      for (Lane* lane : ended_) place_at_start(*lane);
      apply_faults();
    }
    at = row;
  }
}

/// Adds a row to Recording::ticks and, unless the state has diverged, to Recording::poses. The contacts belong to the present
/// state.
void Simulation::record_tick(Lane& lane) {
  const std::optional<Out> row = lane.recorder->add_tick(time(), lane.closed);
  if (!row) return;
  meter_.tick(lane.index, *row);
  if (!fine(lane)) return;
  read_state(lane, false);
  Sample& s = lane.sample;
  for (std::size_t j = 0; j < layout_.joints; ++j) s.setpoint[j] = setpoint_[j * lanes_.size() + lane.index];
  lane.recorder->add_pose(time(), s);
}

/// Records the loads of the `wanted` lanes under the commands that begin now, because commands change torques immediately. The
/// last commands of a lane that ends remain in force.
void Simulation::record_loads(const std::function<bool(const Lane&)>& wanted) {
  const auto due = [&](const auto& lane) { return lane->recorder != nullptr && lane->recorder->loads_due() && wanted(*lane); };
  if (std::ranges::none_of(lanes_, due)) return;
  evaluate_torques(within_);
  for (const auto& lane : lanes_) {
    if (due(lane)) record_loads(*lane);
  }
}

void Simulation::record_loads(Lane& lane) {
  lane.recorder->leave_out_loads();
  if (!fine(lane)) return;
  fill_loads(lane);
  lane.recorder->add_loads();
}

/// Fills the sample of the load meter at the present state under the commands in force.
void Simulation::fill_loads(Lane& lane) {
  LoadMeter& meter = lane.recorder->loads();
  Sample& s = meter.sample();
  s.t = time();
  layout_.read(plant_state_, lane.index, s.state);
  if (meter.want_reactions()) {
    s.kinematics.update(lane.robot, s.state);
  } else {
    s.kinematics.place(lane.robot, s.state);
  }
  s.sums.com = centre_of_mass(lane.robot, s.kinematics);
  plant_->contacts(lane.index, s.contacts);
  for (std::size_t j = 0; j < layout_.joints; ++j) s.torque[j] = torque_[j * lanes_.size() + lane.index];
  lane.read_changes(s);
  s.compute_hinges(lane.robot, lane.passive);
  if (meter.want_reactions()) s.compute_reactions(lane.contacts, *plant_, lane.index);
}

namespace {

constexpr double kWatchEvery = 1e-3;  // s; least interval between measurements of dock loads at the ends of steps

}  // namespace

/// Measures the loads of docks between control ticks, at the ends of steps that are at least kWatchEvery apart. If the
/// integrator divided a step, also measures at the eighths at which parts of the step ended, because an impact divides steps
/// and can be over at the end of its step. saved_ contains the state at the start of the step.
void Simulation::watch_docks() {
  const auto every = static_cast<std::int64_t>(std::ceil(kWatchEvery / h_ - 1e-9));
  within_ = h_;
  if (step_number() % every == every - 1)
    watch_docks([&](const Lane& lane) { return watches_docks(lane) && !lane.clock.commands(step_number() + 1); });
  end_.assign(plant_state_.begin(), plant_state_.end());
  for (std::size_t eighth = 1; eighth < kEighths; ++eighth) {
    bool any = false;
    for (const auto& lane : lanes_) {
      lane->divided = watches_docks(*lane) && plant_->state_within(lane->index, eighth, plant_state_);
      any = any || lane->divided;
    }
    if (!any) continue;
    within_ = static_cast<double>(eighth) / kEighths * h_;
    watch_docks([](const Lane& lane) { return lane.divided; });
    std::ranges::copy(end_, plant_state_.begin());
  }
  within_ = 0;
  watch_stops();
}

bool Simulation::watches_docks(const Lane& lane) const {
  return lane.recorder != nullptr && !lane.closed && lane.recorder->watches_docks();
}

void Simulation::watch_docks(const std::function<bool(const Lane&)>& wanted) {
  const auto due = [&](const auto& lane) { return wanted(*lane) && fine(*lane); };
  if (std::ranges::none_of(lanes_, due)) return;
  plant_->update_contacts();
  evaluate_torques(within_);
  for (const auto& lane : lanes_) {
    if (!due(lane)) continue;
    fill_loads(*lane);
    lane->recorder->loads().watch();
  }
}

/// Completes the recording of a lane with the last rows and the totals.
void Simulation::close(Lane& lane) {
  lane.closed = true;
  plant_->update_contacts();
  record_tick(lane);
  record_loads([&](const Lane& one) { return &one == &lane; });
  lane.recorder->finish(step_number(), time(), lane.outcome, take_sample(lane, true));
  take_statistics(lane);
}

/// Updates the joint statistics of the recording.
void Simulation::take_statistics(Lane& lane) {
  std::vector<JointStatistics>& joints = lane.recorder->recording.joints;
  joints.clear();
  for (std::size_t j = 0; j < layout_.joints; ++j) joints.push_back(meter_.statistics(j, lane.index));
  std::tie(lane.recorder->recording.current_peak, lane.recorder->recording.current_rms) = meter_.current(lane.index);
}

Recording Simulation::take_recording(std::size_t lane) {
  if (!lanes_[lane]->closed) close(*lanes_[lane]);
  return std::move(lanes_[lane]->recorder->recording);
}

}  // namespace gaitlab
