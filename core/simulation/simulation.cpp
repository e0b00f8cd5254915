#include "core/simulation/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/laws/joint_friction.h"
#include "core/recording/motor_limit.h"
#include "core/simulation/lane.h"

namespace gaitlab {

namespace {

// Largest plausible joint speed. A run with a larger speed has diverged, and is ended before numbers overflow a few steps
// later.
constexpr double kLargestSpeed = 1e5;  // rad/s

}  // namespace

SimulationError::SimulationError(Ended how, std::int64_t at_step, double at_time, std::string at, const std::string& what)
    : RunError(what), ended(how), step(at_step), time(at_time), where(std::move(at)) {}

bool Simulation::recorded(const Lane& lane) const { return role_ == Role::run && lane.index < recorded_; }
bool Simulation::control_tick(const Lane& lane) const { return !lane.closed && lane.clock.commands(step_of(lane)); }
bool Simulation::trace_tick(const Lane& lane) const {
  return recorded(lane) && !lane.closed && lane.clock.records(step_of(lane));
}
bool Simulation::any(bool (Simulation::*tick)(const Lane&) const) const {
  return std::any_of(lanes_.begin(), lanes_.end(), [&](const auto& lane) { return (this->*tick)(*lane); });
}

void Simulation::step() try {
  apply_faults();
  if (step_error_) begin_window();
  if (any(&Simulation::trace_tick)) record();
  if (any(&Simulation::control_tick)) {
    sense();
    command();
  }
  record_within_step();
  const bool watches = std::ranges::any_of(lanes_, [&](const auto& lane) { return watches_docks(*lane); });
  if (watches) {
    const bool near = std::ranges::any_of(lanes_, [&](const auto& lane) {
      return watches_docks(*lane) && lane->near_stop(layout_, plant_state_, lanes_.size(), h_);
    });
    if (near) std::ranges::copy(state_, saved_.begin());
    if (!near) saved_[0] = std::numeric_limits<double>::quiet_NaN();
  }
  advance(h_, [](const Lane&) { return true; });
  if (watches) watch_docks();
  if (step_error_) estimate();
  state_[0] += 1;
  check();
} catch (const PluginError& error) {
  throw stopped(error, step_number(), time());
}

bool Simulation::done() const {
  return step_number() >= steps_ ||
         std::ranges::all_of(lanes_, [&](const auto& lane) { return lane->closed || !recorded(*lane); });
}

bool Simulation::run(const std::function<void(double)>& progress, const std::atomic<bool>* stop) try {
  const std::int64_t report_every = std::max<std::int64_t>(1, steps_ / 200);
  while (!done()) {
    step();
    if (watch_) ask_watch();
    if (progress && step_number() % report_every == 0)
      progress(static_cast<double>(step_number()) / static_cast<double>(steps_));
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) return false;
  }
  record();  // t = duration is a row even if it is not a multiple of the trace period
  return true;
} catch (const PluginError& error) {
  throw stopped(error, step_number(), time());
}

void Simulation::ask_watch() {
  constexpr double kSlack = 1e-9;  // s; more than the rounding error of the sum of steps
  if (done() || time() < asked_ + kWatchPeriod - kSlack) return;
  asked_ += kWatchPeriod;
  for (const auto& lane : lanes_) {
    if (lane->closed || !recorded(*lane)) continue;
    // Until the lane is closed, the recording lacks time and statistics.
    lane->recorder->recording.simulated = time();
    take_statistics(*lane);
    std::string reason = watch_(lane->index, lane->recorder->recording);
    if (reason.empty()) continue;
    lane->outcome = {Ended::stopped, std::move(reason)};
    end(*lane);
  }
}

SimulationError Simulation::stopped(const PluginError& error, std::int64_t step, double t) {
  return {Ended::plugin, step, t, word(error.kind), fmt::format("stopped at step {}, t = {:.6g} s: {}", step, t, error.what())};
}

void Simulation::fail(Lane& lane, const SimulationError& error) {
  if (recorded(lane) && recorded_ == 1) throw SimulationError(error);
  lane.outcome = error.outcome();
  if (recorded(lane)) return end(lane);
  lane.closed = true;
  place_at_start(lane);
}

/// Closes the recording of the lane and resets the lane to its initial state with zero commands, so that the unused lane cannot
/// produce NaN.
void Simulation::end(Lane& lane) {
  close(lane);
  if (lanes_.size() == 1) return;
  place_at_start(lane);
  apply_faults();
}

In Simulation::motor_speeds() {
  const In speeds = plant_state_.subspan(layout_.speeds(), command_.size());
  if (plays_.empty()) return speeds;
  const std::size_t lanes = lanes_.size();
  std::ranges::copy(speeds, motor_speed_.begin());
  for (std::size_t k = 0; k < plays_.size(); ++k) {
    std::copy_n(plant_state_.begin() + static_cast<std::ptrdiff_t>(layout_.rotor_speeds() + k * lanes), lanes,
                motor_speed_.begin() + static_cast<std::ptrdiff_t>(plays_[k] * lanes));
  }
  return motor_speed_;
}

/// Evaluates the actuator law at `speeds` under the commands in force.
void Simulation::evaluate_motors(In speeds) {
  if (actuator_ == nullptr) return;
  const Actuator::Electrical into{voltage_, current_, saturation_, power_in_, copper_, gear_};
  MotorLaws* const laws = plant_->motor_laws();
  if (laws == nullptr || !laws->evaluate_motors(commands(), speeds, into)) actuator_->electrical(commands(), speeds, into);
  for (std::size_t i = 0; i < bound_.size(); ++i) {
    if (saturation_[i] == 0 && std::abs(command_[i]) > bound_[i]) saturation_[i] = saturation_of(MotorLimit::voltage);
  }
}

/// Computes the torques of motors at the present state under the commands in force, and friction_, which is part of them except
/// for passive hinges. `within`: time since the last call of apply_faults(), s.
void Simulation::evaluate_torques(double within) {
  const In speeds = motor_speeds();
  if (actuator_ != nullptr) actuator_->effort(commands(), speeds, torque_, slope_);
  if (!rubs_) return;
  std::ranges::copy(torque_, friction_.begin());
  const bool added = plant_->add_friction(commands(), within, torque_);
  if (!added && actuator_ != nullptr) add_creeping(actuator_->friction(), speeds, torque_, slope_);
  for (std::size_t i = 0; i < friction_.size(); ++i) friction_[i] = torque_[i] - friction_[i];
  if (!plant_->holds_hinges()) return;
  for (const std::size_t j : lanes_.front()->passive) {
    for (std::size_t i = j * lanes_.size(); i < (j + 1) * lanes_.size(); ++i) torque_[i] -= friction_[i];
  }
}

/// Torque available to the recorded lanes in a part of a step, in the direction of their torques, N m. Infinity if the actuator
/// has no limit.
In Simulation::evaluate_available(const StepEffort::Part& part) {
  const Out available = Out(available_).first(largest_.size());
  if (actuator_ == nullptr) return available;
  const In torques = first_.of(part.torque, FirstLanes::torque);
  const In speeds = first_.of(part.speed, FirstLanes::speed);
  const Actuator& actuator = own_actuator_ ? *own_actuator_ : *actuator_;
  In found = available;
  if (MotorLaws* const laws = plant_->motor_laws();
      laws != nullptr && !bounded_ && laws->evaluate_available(part.speed, part.torque, available_)) {
    found = first_.of(In(available_), FirstLanes::available);
  } else {
    const In limit = actuator.command_limit();
    const In bound = bounded_ ? first_.of(In(bound_), FirstLanes::bound) : In();
    for (std::size_t i = 0; i < largest_.size(); ++i) {
      const double most = bounded_ ? std::min(limit[i], bound[i]) : limit[i];
      largest_[i] = std::isfinite(limit[i]) ? std::copysign(most, torques[i]) : 0;
    }
    actuator.effort(largest_, speeds, available, slope_);
    for (std::size_t i = 0; i < largest_.size(); ++i) {
      available[i] =
          std::isfinite(limit[i]) ? std::copysign(1.0, torques[i]) * available[i] : std::numeric_limits<double>::infinity();
    }
  }
  const std::span<const JointFriction> friction = actuator.friction();
  for (std::size_t i = 0; i < friction.size(); ++i)
    available[i] = found[i] + friction_along(friction[i], speeds[i], std::copysign(1.0, torques[i]));
  return friction.empty() ? found : In(available);
}

/// Advances the plant by a step. Adds the step to the ledger, which is part of the state, and to the statistics of the
/// `measured` lanes.
void Simulation::advance(double h, const std::function<bool(const Lane&)>& measured) {
  plant_->advance(commands(), h);
  const Scenario& first = scenarios_[0];
  const bool creeps = first.physics.integrator->limited && first.contact.law == ContactLaw::penalty;
  const StepEffort applied = plant_->applied();
  const std::span<const JointFriction> friction =
      actuator_ == nullptr ? std::span<const JointFriction>() : actuator_->friction();
  const std::size_t lanes = lanes_.size();
  for (std::size_t l = 0; l < recorded_; ++l) measured_[l] = measured(*lanes_[l]) ? 1 : 0;
  for (const StepEffort::Part& of_all : applied.parts) {
    if (lanes != recorded_ && !(of_all.instant || of_all.sum[0] != 0 || of_all.share[0] > 0)) continue;  // of companions only
    evaluate_motors(of_all.speed);
    StepEffort::Part part = of_all;
    part.torque = first_.of(of_all.torque, FirstLanes::torque);
    part.speed = first_.of(of_all.speed, FirstLanes::speed);
    part.angle = first_.of(of_all.angle, FirstLanes::angle);
    const Actuator::Electrical electrical{
        first_.of(Out(voltage_), FirstLanes::voltage),       first_.of(Out(current_), FirstLanes::current),
        first_.of(Out(saturation_), FirstLanes::saturation), first_.of(Out(power_in_), FirstLanes::power_in),
        first_.of(Out(copper_), FirstLanes::copper),         first_.of(Out(gear_), FirstLanes::gear)};
    for (std::size_t i = 0; i < friction.size(); ++i) dry_[i] = power_lost(friction[i], of_all.speed[i], creeps);
    if (role_ == Role::run) {
      const bool peaks = part.instant || std::ranges::any_of(part.share, [](double share) { return share > 0; });
      meter_.add(time(), part, first_.of(setpoint_, FirstLanes::setpoint), electrical, first_.of(In(dry_), FirstLanes::dry),
                 peaks ? evaluate_available(of_all) : available_, measured_);
    }
    if (part.instant) continue;
    for (std::size_t l = 0; l < recorded_; ++l) {
      const Out sums = lanes_[l]->ledger;
      for (std::size_t i = l; i < command_.size(); i += lanes) {
        sums[0] += part.sum[l] * power_in_[i];
        sums[1] += part.sum[l] * copper_[i];
        sums[2] += part.sum[l] * gear_[i];
        sums[7] += part.sum[l] * dry_[i];
      }
    }
  }
  for (std::size_t l = 0; l < recorded_; ++l) {
    const Out sums = lanes_[l]->ledger;
    sums[3] += applied.contact[l];
    sums[4] += applied.friction[l];
    sums[5] += applied.stops[l];
    sums[6] += applied.hinges[l];
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

/// True if all numbers of the state of a lane are finite and within bounds.
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
  return {Ended::diverged, step_of(lane), time(lane), where,
          fmt::format("diverged at step {}, t = {:.6g} s: {}{}", step_of(lane), time(lane),
                      where == "base" ? "the base" : "joint " + where,
                      finite && worst > 0 ? fmt::format(" turns at {:.3g} rad/s", worst)
                                          : fmt::format(" is not finite, or beyond {:g} in SI units", kLargestSpeed))};
}

Out Simulation::state() {
  const ContactModel& contact = scenarios_[0].contact.model();
  if (contact.complete_state) return state_;
  throw InputError(
      scenarios_[0].place("contact.law"),
      fmt::format("contact.law: {} allows no snapshot, because its contact points and boxes are not part of the state",
                  contact.text));
}

const Outcome& Simulation::outcome(std::size_t lane) const { return lanes_[lane]->outcome; }

double Simulation::solves(std::size_t lane) const {
  StepTally tally;
  plant_->tally(lane, tally);
  return tally.solves;
}

}  // namespace gaitlab
