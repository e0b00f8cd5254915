// Control ticks of a simulation: measured values, set points and commands.
#include <algorithm>
#include <cmath>

#include "core/simulation/cpg_check.h"
#include "core/simulation/lane.h"
#include "core/simulation/simulation.h"

namespace gaitlab {

/// Runs code for one lane. An exception ends the lane or, if there is only one lane, the run.
template <class Work>
void Simulation::guard(Lane& lane, Work work) try {
  work();
} catch (const PluginError& error) {
  fail(lane, stopped(error, step_of(lane), time(lane)));
} catch (const SimulationError& error) {
  fail(lane, error);
}

void Simulation::sense() {
  const std::size_t lanes = lanes_.size();
  // Left limits, as in a trace row: the sensors depend on the state and the command in force, not on the method of the last
  // step.
  evaluate_torques(0);
  const auto need_current = [](const auto& lane) { return lane->sensors.need_current(); };
  if (std::ranges::any_of(lanes_, need_current)) evaluate_motors(motor_speeds());
  plant_->update_contacts();
  for (const auto& one : lanes_) {
    Lane& lane = *one;
    const std::size_t l = lane.index;
    // A stepped lane measures also at its end.
    const bool due = role_ == Role::stepped ? !lane.closed && lane.clock.at_tick(step_of(lane)) : control_tick(lane);
    if (!due || lane.sensed) continue;
    lane.sensed = true;
    for (std::size_t j = 0; j < layout_.joints; ++j) {
      lane.angle[j] = plant_state_[layout_.angles() + j * lanes + l];
      lane.speed[j] = plant_state_[layout_.speeds() + j * lanes + l];
      lane.torque[j] = torque_[j * lanes + l];
    }
    for (std::size_t k = 0; k < plays_.size(); ++k) {
      if (!lane.robot.joints[plays_[k]].play.encoder_at_motor) continue;
      lane.angle[plays_[k]] = plant_state_[layout_.rotors() + k * lanes + l];
      lane.speed[plays_[k]] = plant_state_[layout_.rotor_speeds() + k * lanes + l];
    }
    plant_->contacts(l, lane.sample.contacts);
    lane.take_contacts();
    if (!lane.sensors.empty()) sense(lane);
  }
}

/// Replaces true values of a lane by values of its sensors.
void Simulation::sense(Lane& lane) {
  LaneSensors& sensors = lane.sensors;
  for (std::size_t j = 0; sensors.need_current() && j < layout_.joints; ++j) {
    sensors.current()[j] = current_[j * lanes_.size() + lane.index];
  }
  if (sensors.need_motion()) layout_.read(plant_state_, lane.index, sensors.robot_state());
  sensors.sense(lane.clock.tick(step_of(lane)), lane.contacts, lane.sample.contacts,
                {lane.angle, lane.speed, lane.torque, lane.touching, lane.channels, lane.load});
}

void Simulation::command() {
  for (const auto& lane : lanes_) {
    if (!control_tick(*lane)) continue;
    if (recorded(*lane)) lane->recorder->tick_due() ? record_tick(*lane) : lane->recorder->skip_tick();
    guard(*lane, [&] { command(*lane); });
  }
  apply_faults();
  if (role_ != Role::run) return;
  record_loads([](const Lane& lane) { return !lane.closed; });
  watch_stability();
}

void Simulation::command(Lane& lane) {
  const std::size_t lanes = lanes_.size();
  lane.steer();
  const Measured measured = lane.measured(time(lane));
  const Action& action = lane.action;
  lane.sensed = false;
  const std::int64_t tick = lane.clock.tick(step_of(lane));
  lane.begin_tick(tick, plant_state_, layout_);
  const bool own = lane.cpg != nullptr && action.setpoint.empty();
  if (!action.setpoint.empty()) {
    std::ranges::copy(action.setpoint, lane.setpoint.begin());
  } else if (own) {
    lane.cpg->event(measured, lane.cpg_state);
    std::fill(lane.setpoint.begin(), lane.setpoint.end(), NAN);  // check_cpg finds entries that the CPG does not write
    lane.cpg->output(time(lane), lane.cpg_state, lane.setpoint);
  } else {
    for (std::size_t j = 0; j < lane.setpoint.size(); ++j) lane.setpoint[j] = lane.scenario.initial.angles[j];
  }
  for (std::size_t j = 0; j < action.residual.size(); ++j) lane.setpoint[j] += action.residual[j];
  for (const std::size_t j : lane.passive) lane.setpoint[j] = plant_state_[layout_.angles() + j * lanes + lane.index];
  lane.asked = lane.setpoint;
  lane.changes.lose(tick, setpoint_, lane.index, lane.setpoint);
  if (!action.command.empty()) {
    for (std::size_t j = 0; j < lane.command.size(); ++j)
      lane.command[j] = std::clamp(action.command[j], -lane.limit[j], lane.limit[j]);
  } else if (lane.controller != nullptr) {
    lane.controller->update(measured, lane.setpoint, lane.limit, lane.controller_state, lane.command);
  }
  lane.changes.cut(lane.command);
  for (const std::size_t j : lane.passive) lane.command[j] = 0;
  for (std::size_t j = 0; j < lane.setpoint.size(); ++j) {
    setpoint_[j * lanes + lane.index] = lane.setpoint[j];
    command_[j * lanes + lane.index] = lane.command[j];
  }
  supply(lane);
  if (recorded(lane)) meter_.command(time(lane), lane.index, lane.command);
  if (!own) return;
  lane.integrate_cpg(time(lane));
  check_cpg(*lane.cpg, lane.robot, lane.setpoint, lane.cpg_state, step_of(lane), time(lane));
}

void Simulation::watch_stability() {
  for (const auto& lane : lanes_) {
    if (!recorded(*lane) || !control_tick(*lane)) continue;
    Recording& recording = lane->recorder->recording;
    const Stability now = plant_->stability(lane->index, commands(), false);
    ++recording.control_ticks;
    if (h_ * now.rate > 1) ++recording.control_ticks_above_1;
    if (now.rate > recording.worst.rate) {
      recording.worst = now;
      recording.worst_time = time(*lane);
    }
  }
}

}  // namespace gaitlab
