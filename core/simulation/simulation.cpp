#include "core/simulation/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/laws/hinge_stop.h"
#include "core/simulation/cpg_check.h"
#include "core/simulation/lane.h"

namespace gaitlab {

namespace {

// Beyond this no joint is a joint any more; a run stops here rather than at the overflow a few steps later.
constexpr double kLargestSpeed = 1e5;  // rad/s

}  // namespace

std::int64_t whole(double period, double step) { return std::llround(period / step); }

SimulationError::SimulationError(std::int64_t at_step, double at_time, std::string at, const std::string& what)
    : RunError(what), step(at_step), time(at_time), where(std::move(at)) {}

bool Simulation::control_tick(const Lane& lane) const { return !lane.closed && lane.clock.commands(step_number()); }
bool Simulation::trace_tick(const Lane& lane) const { return !lane.closed && lane.clock.records(step_number()); }
bool Simulation::any(bool (Simulation::*tick)(const Lane&) const) const {
  return std::any_of(lanes_.begin(), lanes_.end(), [&](const auto& lane) { return (this->*tick)(*lane); });
}

void Simulation::step() try {
  if (any(&Simulation::trace_tick)) record();
  if (any(&Simulation::control_tick)) {
    sense();
    command();
  }
  record_within_step();
  if (step_error_) step_error_->begin(step_number(), plant_state_, plant_history_);
  advance(h_, [](const Lane&) { return true; });
  if (step_error_) step_error_->follow(step_number(), plant_state_, command_, h_);
  state_[0] += 1;
  check();
} catch (const PluginError& error) {
  throw stopped(error);
}

bool Simulation::done() const {
  return step_number() >= steps_ || std::all_of(lanes_.begin(), lanes_.end(), [](const auto& lane) { return lane->closed; });
}

bool Simulation::run(const std::function<void(double)>& progress, const std::atomic<bool>* stop) try {
  const std::int64_t report_every = std::max<std::int64_t>(1, steps_ / 200);
  while (!done()) {
    step();
    if (progress && step_number() % report_every == 0)
      progress(static_cast<double>(step_number()) / static_cast<double>(steps_));
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) return false;
  }
  record();  // t = duration is a row even where it is not a multiple of the trace period
  return true;
} catch (const PluginError& error) {
  throw stopped(error);
}

SimulationError Simulation::stopped(const PluginError& error) const {
  return {step_number(), time(), word(error.kind),
          fmt::format("stopped at step {}, t = {:.6g} s: {}", step_number(), time(), error.what())};
}

/// What the lane's own code may throw ends the lane; where it is alone, the run.
template <class Work>
void Simulation::guard(Lane& lane, Work work) try {
  work();
} catch (const PluginError& error) {
  fail(lane, stopped(error));
} catch (const SimulationError& error) {
  fail(lane, error);
}

void Simulation::fail(Lane& lane, const SimulationError& error) {
  if (lanes_.size() == 1) throw SimulationError(error);
  lane.failure = error.what();
  end(lane);
}

/// Closes the record of the lane and resets it to its initial state with zero commands, so that the unused lane cannot produce
/// NaN.
void Simulation::end(Lane& lane) {
  close(lane);
  if (lanes_.size() > 1) place_at_start(lane);
}

/// The actuator law at these speeds under the commands in force.
void Simulation::evaluate_motors(In speeds) {
  if (actuator_ == nullptr) return;
  const Actuator::Electrical into{voltage_, current_, saturation_, power_in_, copper_, gear_};
  if (!plant_->evaluate_motors(command_, speeds, into)) actuator_->electrical(command_, speeds, into);
}

/// The torque that there is at these speeds in the direction of these torques, N m; infinity: the actuator states no limit.
void Simulation::evaluate_available(In speeds, In torques) {
  if (actuator_ == nullptr) return;
  const In limit = actuator_->command_limit();
  for (std::size_t i = 0; i < largest_.size(); ++i)
    largest_[i] = std::isfinite(limit[i]) ? std::copysign(limit[i], torques[i]) : 0;
  actuator_->effort(largest_, speeds, available_, slope_);
  for (std::size_t i = 0; i < largest_.size(); ++i) {
    available_[i] =
        std::isfinite(limit[i]) ? std::copysign(1.0, torques[i]) * available_[i] : std::numeric_limits<double>::infinity();
  }
}

/// Kinetic and potential, rotors included, J.
double Simulation::energy(const Lane& lane) const {
  const Sample& sample = lane.sample;
  double rotors = 0;
  const In inertia = actuator_ == nullptr ? In() : actuator_->reflected_inertia();
  for (std::size_t j = 0; j < layout_.joints && !inertia.empty(); ++j) {
    rotors += inertia[j * lanes_.size() + lane.index] * sample.state.qd[j] * sample.state.qd[j] / 2;
  }
  return sample.sums.kinetic + sample.sums.potential + rotors;
}

double Simulation::stop_torque(const Lane& lane, const RobotState& state, std::size_t joint) {
  const Joint& of = lane.robot.joints[joint];
  return HingeStop::at(state.q[joint], state.qd[joint], of.lo, of.hi).torque;
}

/// `whole`: also what no column asks for.
Sample& Simulation::take_sample(Lane& lane, bool whole) {
  const std::size_t lanes = lanes_.size();
  const std::size_t l = lane.index;
  Sample& s = lane.sample;
  s.t = time();
  layout_.read(plant_state_, l, s.state);
  const std::optional<Vec3> com = plant_->com(l);
  if (whole || !com || lane.probes->want_places()) s.forward_kinematics(lane.robot);
  if (com) s.sums.com = *com;
  plant_->contacts(l, s.contacts);
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
  std::copy(lane.cpg_state.begin(), lane.cpg_state.end(), s.cpg.begin());
  plant_->tally(l, s.tally);
  if (step_error_) {
    s.tally.estimated = step_error_->any(l);
    for (std::size_t j = 0; j < layout_.joints; ++j) {
      s.tally.torque_error[j] = step_error_->rms(j, l);
      s.tally.torque_peak[j] = step_error_->peak(j, l);
    }
  }
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
      return lane.closed ? std::numeric_limits<double>::infinity() : lane.clock.row_within(step_number(), at);
    };
    double row = std::numeric_limits<double>::infinity();
    for (const auto& lane : lanes_) row = std::min(row, next(*lane));
    if (!std::isfinite(row)) return;
    std::ranges::copy(state_, saved_.begin());
    const auto ends = [&](const Lane& lane) { return !lane.closed && lane.clock.ends_within(step_number(), row); };
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

void Simulation::sense() {
  const std::size_t lanes = lanes_.size();
  // The left limit, as in a row: what is measured depends on the state and the command in force, not on how the last step was
  // taken.
  if (actuator_ != nullptr) {
    actuator_->effort(command_, plant_state_.subspan(layout_.speeds(), command_.size()), torque_, slope_);
  }
  plant_->update_contacts();
  for (const auto& one : lanes_) {
    Lane& lane = *one;
    const std::size_t l = lane.index;
    if (!control_tick(lane)) continue;
    for (std::size_t j = 0; j < layout_.joints; ++j) {
      lane.angle[j] = plant_state_[layout_.angles() + j * lanes + l];
      lane.speed[j] = plant_state_[layout_.speeds() + j * lanes + l];
      lane.torque[j] = torque_[j * lanes + l];
    }
    std::fill(lane.touching.begin(), lane.touching.end(), 0.0);
    plant_->contacts(l, lane.sample.contacts);
    for (std::size_t c = 0; c < lane.contacts.size(); ++c) {
      if (lane.sample.contacts[c].fn > 0) lane.touching[lane.robot.bodies[lane.contacts[c].body].module] = 1;
    }
  }
}

void Simulation::command() {
  for (const auto& lane : lanes_) {
    if (!control_tick(*lane)) continue;
    if (lane->recording.control_ticks % lane->ticks_per_row == 0) record_tick(*lane);
    guard(*lane, [&] { command(*lane); });
  }
  record_loads([](const Lane& lane) { return !lane.closed; });
  watch_stability();
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

/// A row of Recording::poses; none of a state that is not one any more.
void Simulation::record_pose(Lane& lane) {
  if (!fine(lane)) return;
  RobotState& state = lane.sample.state;
  layout_.read(plant_state_, lane.index, state);
  Trace& poses = lane.recording.poses;
  const Vec3& p = state.position;
  const Quat& q = state.orientation;
  for (const double value : {time(), p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) poses.values.push_back(value);
  poses.values.insert(poses.values.end(), state.q.begin(), state.q.end());
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
  if (lane.loads->want_reactions()) s.compute_reactions(lane.contacts, *plant_, lane.index);
  Trace& loads = lane.recording.loads;
  loads.values.resize(loads.values.size() + loads.columns.size());
  lane.loads->measure(Out(loads.values).last(loads.columns.size()));
}

void Simulation::command(Lane& lane) {
  const std::size_t lanes = lanes_.size();
  const Measured measured = lane.measured(time());
  if (lane.cpg != nullptr) {
    lane.cpg->event(measured, lane.cpg_state);
    std::fill(lane.setpoint.begin(), lane.setpoint.end(), NAN);  // one that is not written is found below
    lane.cpg->output(time(), lane.cpg_state, lane.setpoint);
  } else {
    for (std::size_t j = 0; j < lane.setpoint.size(); ++j) lane.setpoint[j] = lane.scenario.initial.angles[j];
  }
  if (lane.controller != nullptr) {
    lane.controller->update(measured, lane.setpoint, lane.limit, lane.controller_state, lane.command);
  }
  for (std::size_t j = 0; j < lane.setpoint.size(); ++j) {
    setpoint_[j * lanes + lane.index] = lane.setpoint[j];
    command_[j * lanes + lane.index] = lane.command[j];
  }
  if (lane.cpg == nullptr) return;
  lane.integrate_cpg(time());
  check_cpg(*lane.cpg, lane.robot, lane.setpoint, lane.cpg_state, step_number(), time());
}

void Simulation::watch_stability() {
  for (const auto& lane : lanes_) {
    if (!control_tick(*lane)) continue;
    Recording& recording = lane->recording;
    const Stability now = plant_->stability(lane->index, command_, false);
    ++recording.control_ticks;
    if (h_ * now.rate > 1) ++recording.control_ticks_above_1;
    if (now.rate > recording.worst.rate) {
      recording.worst = now;
      recording.worst_time = time();
    }
  }
}

/// A step of the plant, into the ledger, which is part of the state, and into the figures of the lanes that `measured` is told.
void Simulation::advance(double h, const std::function<bool(const Lane&)>& measured) {
  plant_->advance(command_, h);
  const StepEffort applied = plant_->applied();
  const std::size_t lanes = lanes_.size();
  for (std::size_t l = 0; l < lanes; ++l) measured_[l] = measured(*lanes_[l]) ? 1 : 0;
  for (const StepEffort::Part& part : applied.parts) {
    evaluate_motors(part.speed);
    evaluate_available(part.speed, part.torque);
    meter_.add(time(), part, setpoint_, {voltage_, current_, saturation_, power_in_, copper_, gear_}, available_, measured_);
    if (part.instant) continue;
    for (std::size_t l = 0; l < lanes; ++l) {
      const Out sums = lanes_[l]->ledger;
      for (std::size_t i = l; i < command_.size(); i += lanes) {
        sums[0] += part.sum[l] * power_in_[i];
        sums[1] += part.sum[l] * copper_[i];
        sums[2] += part.sum[l] * gear_[i];
      }
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    const Out sums = lanes_[l]->ledger;
    sums[3] += applied.contact[l];
    sums[4] += applied.friction[l];
    sums[5] += applied.stops[l];
  }
}

void Simulation::check() {
  for (const auto& lane : lanes_) {
    if (!lane->closed) check(*lane);
  }
}

void Simulation::check(Lane& lane) {
  if (!fine(lane)) fail(lane, diverged(lane));
}

/// Whether every number of its state is one, and not beyond all bounds.
bool Simulation::fine(const Lane& lane) const {
  bool fine = true;
  for (std::size_t i = lane.index; i < plant_state_.size(); i += lanes_.size()) {
    fine = fine && std::abs(plant_state_[i]) < kLargestSpeed;  // false for NaN too
  }
  return fine;
}

SimulationError Simulation::diverged(const Lane& lane) const {
  std::string where = "base";
  double worst = 0;
  bool finite = true;
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    const double speed = std::abs(plant_state_[layout_.speeds() + j * lanes_.size() + lane.index]);
    if (!std::isfinite(speed) && finite) {
      finite = false;
      where = lane.robot.joints[j].name;
    }
    if (finite && speed > worst && speed >= kLargestSpeed) {
      worst = speed;
      where = lane.robot.joints[j].name;
    }
  }
  return {step_number(), time(), where,
          fmt::format("diverged at step {}, t = {:.6g} s: {}{}", step_number(), time(),
                      where == "base" ? "the base" : "joint " + where,
                      finite && worst > 0 ? fmt::format(" turns at {:.3g} rad/s", worst)
                                          : fmt::format(" is not finite, or beyond {:g} in SI units", kLargestSpeed))};
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
  if (!lane.failure.empty()) recording.outcome = lane.failure;
  recording.joints.clear();
  for (std::size_t j = 0; j < layout_.joints; ++j) recording.joints.push_back(meter_.statistics(j, lane.index));
}

Out Simulation::state() {
  if (plant_->state_is_complete()) return state_;
  throw InputError(scenarios_[0].place("contact.law"),
                   "contact.law: bullet gives no snapshot: its contact points and boxes are no part of the state");
}

const std::string& Simulation::failure(std::size_t lane) const { return lanes_[lane]->failure; }

Recording Simulation::take_recording(std::size_t lane) {
  if (!lanes_[lane]->closed) close(*lanes_[lane]);
  return std::move(lanes_[lane]->recording);
}

}  // namespace gaitlab
