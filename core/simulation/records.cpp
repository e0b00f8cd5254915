// What a simulation writes down: rows of the trace, of ticks, poses and loads, and the end of a recording.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/laws/hinge_stop.h"
#include "core/laws/passive_hinge.h"
#include "core/simulation/lane.h"
#include "core/simulation/simulation.h"

namespace gaitlab {

/// Kinetic and potential, rotors and springs of passive hinges included, J.
double Simulation::energy(const Lane& lane) const {
  const Sample& sample = lane.sample;
  double rotors = 0;
  const In inertia = actuator_ == nullptr ? In() : actuator_->reflected_inertia();
  for (std::size_t j = 0; j < layout_.joints && !inertia.empty(); ++j) {
    rotors += inertia[j * lanes_.size() + lane.index] * sample.state.qd[j] * sample.state.qd[j] / 2;
  }
  double stored = sample.sums.kinetic + sample.sums.potential + rotors;
  for (const std::size_t j : lane.passive) stored += law(*lane.robot.joints[j].passive).energy(sample.state.q[j]);
  return stored;
}

/// What passive hinges give at the state of a sample.
void Simulation::take_passive(const Lane& lane, Sample& s) {
  for (const std::size_t j : lane.passive) {
    const PassiveHinge hinge = law(*lane.robot.joints[j].passive);
    s.passive_torque[j] = hinge.spring(s.state.q[j]) + hinge.loss(s.state.qd[j]).torque;
  }
}

double Simulation::stop_torque(const Lane& lane, const RobotState& state, std::size_t joint) {
  const Joint& of = lane.robot.joints[joint];
  return HingeStop::at(state.q[joint], state.qd[joint], of.lo, of.hi).torque;
}

/// State, centre of mass and contacts of now. `places`: of all bodies, too.
void Simulation::read_state(Lane& lane, bool places) {
  Sample& s = lane.sample;
  layout_.read(plant_state_, lane.index, s.state);
  const std::optional<Vec3> com = plant_->com(lane.index);
  if (places || !com) s.forward_kinematics(lane.robot);
  if (com) s.sums.com = *com;
  plant_->contacts(lane.index, s.contacts);
}

/// `whole`: also what no column asks for.
Sample& Simulation::take_sample(Lane& lane, bool whole) {
  const std::size_t lanes = lanes_.size();
  const std::size_t l = lane.index;
  Sample& s = lane.sample;
  s.t = time();
  read_state(lane, whole || lane.probes->want_places());
  s.place_boxes(*plant_);
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    const std::size_t i = j * lanes + l;
    s.setpoint[j] = setpoint_[i];
    s.command[j] = command_[i];
    s.voltage[j] = voltage_[i];
    s.current[j] = current_[i];
    s.saturation[j] = saturation_[i];
    s.torque[j] = torque_[i];
    s.stop_torque[j] = stop_torque(lane, s.state, j);
  }
  take_passive(lane, s);
  std::copy(lane.cpg_state.begin(), lane.cpg_state.end(), s.cpg.begin());
  plant_->tally(l, s.tally);
  if (step_error_ && lane.scenario.physics.estimate == Estimate::full) step_error_->put(l, s.tally);
  s.ledger = Ledger::of(lane.ledger, energy(lane) - lane.energy_at_start);
  return s;
}

/// The left limit of what is not the plant's state: the actuator law under the command in force.
void Simulation::observe() {
  evaluate_motors(plant_state_.subspan(layout_.speeds(), command_.size()));
  if (actuator_ != nullptr) {
    actuator_->effort(command_, plant_state_.subspan(layout_.speeds(), command_.size()), torque_, slope_);
  }
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
  Sample& s = take_sample(lane, false);
  if (lane.probes->want_reactions()) s.compute_reactions(lane.contacts, *plant_, lane.index);
  Recording& r = lane.recording;
  for (Trace* table : {&r.trace, &r.rest}) table->values.resize(table->values.size() + table->columns.size());
  lane.probes->fill(Out(r.trace.values).last(r.trace.columns.size()), Out(r.rest.values).last(r.rest.columns.size()));
}

/// Rows and ends within the step that starts now: each by a shorter step of its own, after which the state is put back, so that
/// nothing depends on which rows there are.
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
    }
    at = row;
  }
}

/// A row of Recording::ticks.
void Simulation::record_tick(Lane& lane) {
  Trace& ticks = lane.recording.ticks;
  const std::size_t columns = ticks.columns.size();
  if (!ticks.values.empty() && ticks.values[ticks.values.size() - columns] == time()) return;
  if (ticks.rows() > kMostTickRows) {
    halve_ticks(ticks);
    halve_rows(lane.recording.loads);
    halve_rows(lane.recording.poses);
    lane.ticks_per_row *= 2;
    if (lane.recording.control_ticks % lane.ticks_per_row != 0 && !lane.closed) return;
  }
  ticks.values.resize(ticks.values.size() + columns);
  const Out row = Out(ticks.values).last(columns);
  row[0] = time();
  meter_.tick(lane.index, row.subspan(1));
  record_pose(lane);
  lane.loads_due = lane.loads != nullptr;
}

/// A row of Recording::poses; none of a state that is not one any more. Contacts are those of the present state.
void Simulation::record_pose(Lane& lane) {
  if (!fine(lane)) return;
  read_state(lane, false);
  const Sample& s = lane.sample;
  Trace& poses = lane.recording.poses;
  const Vec3& p = s.state.position;
  const Quat& q = s.state.orientation;
  for (const double value : {time(), p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) poses.values.push_back(value);
  poses.values.insert(poses.values.end(), s.state.q.begin(), s.state.q.end());
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    const bool driven = lane.robot.joints[j].driven();
    poses.values.push_back(driven ? setpoint_[j * lanes_.size() + lane.index] : s.state.q[j]);
  }
  double load = 0;
  for (const ContactSample& contact : s.contacts) load += contact.fn;
  for (const double value : {s.sums.com.x(), s.sums.com.y(), s.sums.com.z(), load}) poses.values.push_back(value);
}

/// What lanes that are `wanted` bear in this moment under the commands that begin now, which change torques at once; of a lane
/// that ends, under those in force.
void Simulation::record_loads(const std::function<bool(const Lane&)>& wanted) {
  const auto due = [&](const auto& lane) { return lane->loads_due && wanted(*lane); };
  if (std::ranges::none_of(lanes_, due)) return;
  if (actuator_ != nullptr)
    actuator_->effort(command_, plant_state_.subspan(layout_.speeds(), command_.size()), torque_, slope_);
  for (const auto& lane : lanes_) {
    if (due(lane)) record_loads(*lane);
  }
}

void Simulation::record_loads(Lane& lane) {
  lane.loads_due = false;
  if (!fine(lane)) return;
  Sample& s = lane.loads->sample();
  s.t = time();
  layout_.read(plant_state_, lane.index, s.state);
  s.forward_kinematics(lane.robot);
  plant_->contacts(lane.index, s.contacts);
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    s.torque[j] = torque_[j * lanes_.size() + lane.index];
    s.stop_torque[j] = stop_torque(lane, s.state, j);
  }
  take_passive(lane, s);
  if (lane.loads->want_reactions()) s.compute_reactions(lane.contacts, *plant_, lane.index);
  Trace& loads = lane.recording.loads;
  loads.values.resize(loads.values.size() + loads.columns.size());
  lane.loads->measure(Out(loads.values).last(loads.columns.size()));
}

/// What is known of it at this step, beside the rows.
void Simulation::close(Lane& lane) {
  lane.closed = true;
  plant_->update_contacts();
  record_tick(lane);
  record_loads([&](const Lane& one) { return &one == &lane; });
  Recording& recording = lane.recording;
  if (lane.loads) lane.loads->drop_idle_feet(recording.loads);
  recording.steps = step_number();
  recording.simulated = time();
  const Sample& last = take_sample(lane, true);
  recording.tally = last.tally;
  recording.ledger = last.ledger;
  recording.outcome = lane.outcome;
  recording.joints.clear();
  for (std::size_t j = 0; j < layout_.joints; ++j) recording.joints.push_back(meter_.statistics(j, lane.index));
}

Recording Simulation::take_recording(std::size_t lane) {
  if (!lanes_[lane]->closed) close(*lanes_[lane]);
  return std::move(lanes_[lane]->recording);
}

}  // namespace gaitlab
