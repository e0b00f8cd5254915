// Companion rollouts of a run, from which its torque error is estimated: scenarios, steps and comparison.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/periods.h"
#include "core/plugin/plugin_instance.h"
#include "core/simulation/lane.h"
#include "core/simulation/simulation.h"
#include "core/simulation/twin_windows.h"

namespace gaitlab {

namespace {

constexpr double kEventShare = 0.01;  // event threshold, as a share of a torque's peak, for integrators without an accuracy
/// Factors for torque differences, by Companion; the last one is kIll / kChaotic without rounding.
constexpr std::array<double, kDifferences> kFactors{StepError::kOfFiner, StepError::kOfCoarser, 1, 1000};

/// Number of steps h in `seconds`, rounded up to whole control periods.
std::int64_t whole_periods(double seconds, double h, std::int64_t control_every) {
  const double periods = seconds / (h * static_cast<double>(control_every));
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(periods - 1e-9))) * control_every;
}

/// Scenarios of the companions of a run with an accuracy.
std::vector<Scenario> companions(const Scenario& s) {
  std::vector<Scenario> all(kCompanions, s);
  all[static_cast<std::size_t>(Companion::twin)].physics.accuracy *= StepError::kFiner;
  all[static_cast<std::size_t>(Companion::coarse)].physics.accuracy *= StepError::kCoarser;
  all[static_cast<std::size_t>(Companion::chaotic)].physics.gravity *= 1 + StepError::kChaotic;
  return all;
}

}  // namespace

TwinWindows twin_windows(const Scenario& s, bool limited) {
  const Physics& physics = s.physics;
  const double h = physics.step;
  const std::int64_t control_every = math::steps_in(s.control_period, h);
  TwinWindows how;
  for (std::int64_t n = 1; n <= control_every; ++n) {
    if (control_every % n == 0 && static_cast<double>(n) * h <= StepError::kApart * (1 + 1e-9)) how.compare = n;
  }
  if (physics.adapts()) return how;
  const double ratio = 1 << physics.integrator->order;
  const bool longer = control_every % 2 == 0 && !limited;
  how.steps = longer ? 2 : -2;
  how.factor = (longer ? 1 : ratio) * StepError::kSafety / (ratio - 1);
  how.window = whole_periods(longer ? 0.18 : 0.09, h, control_every);
  how.cycle = (longer ? 5 : 20) * how.window;
  how.settle = whole_periods(StepError::kGrowth, h, control_every);
  return how;
}

bool estimated_by_rollouts(const Scenario& s) {
  return s.physics.estimate == Estimate::full && s.physics.adapts() && s.actuator.entry != nullptr && !s.robot->joints.empty();
}

std::vector<Scenario> Simulation::side_by_side(std::span<const Scenario> lanes, Role role) {
  std::vector<Scenario> all(lanes.begin(), lanes.end());
  if (role != Role::run || lanes.size() != 1 || !estimated_by_rollouts(lanes[0])) return all;
  const auto& widths = lanes[0].physics.engine->lanes;
  if (std::ranges::find(widths, 1 + kCompanions) == widths.end()) return all;
  std::ranges::move(companions(lanes[0]), std::back_inserter(all));
  return all;
}

TwinWindows Simulation::twin_windows() const { return gaitlab::twin_windows(scenarios_[0], standing_.rate > 0); }

/// Companions that are separate simulations. A run with a fixed step has one twin, with as many lanes as the run, compared in
/// windows. The companions of a run with an accuracy are lanes in the lane group of the run. If the processor does not have
/// such lanes, the companions are simulations of one lane each, with the same bits.
std::vector<std::unique_ptr<Simulation>> Simulation::rollouts_apart() const {
  std::vector<std::unique_ptr<Simulation>> all;
  const auto add = [&](std::span<const Scenario> lanes) {
    all.emplace_back(new Simulation(lanes, Loads::left_out, Role::companion));
  };
  if (!scenarios_[0].physics.adapts()) {
    std::vector<Scenario> twins = scenarios_;
    for (Scenario& one : twins) {
      one.physics.step = how_.steps > 0 ? one.physics.step * how_.steps : one.physics.step / -how_.steps;
    }
    add(twins);
  } else if (lanes_.size() == recorded_) {
    for (const Scenario& one : companions(scenarios_[0])) add({&one, 1});
  }
  return all;
}

/// Sets up the estimate if there are motors and the state can be copied. Several runs with an accuracy side by side have no
/// estimate, because each would need a separate lane group.
void Simulation::make_estimate() {
  const Physics& physics = scenarios_[0].physics;
  const bool wanted = std::ranges::any_of(scenarios_, [](const Scenario& s) { return s.physics.estimate == Estimate::full; });
  const bool possible =
      physics.adapts() ? recorded_ == 1 : physics.integrator->order > 0 && scenarios_[0].contact.model().complete_state;
  if (!wanted || !possible || actuator_ == nullptr || layout_.joints == 0) return;
  how_ = twin_windows();
  apart_ = rollouts_apart();
  std::vector<double> accuracy;
  for (std::size_t l = 0; l < recorded_; ++l)
    accuracy.push_back(physics.adapts() ? scenarios_[l].physics.accuracy : kEventShare);
  const StateLayout layout{layout_.joints, recorded_};
  step_error_ = std::make_unique<StepError>(layout, accuracy, physics.adapts() ? jumps() : std::vector<double>());

  // One array for all changing numbers: numbers of this simulation, of step_error_ and of the separate companions.
  const std::size_t own = own_.size();
  const std::size_t sums = StepError::size(layout);
  std::size_t size = own + sums;
  for (const auto& one : apart_) size += one->own_.size();
  std::vector<double> numbers(size);
  cut_state(numbers);
  step_error_->bind(Out(numbers).subspan(own, sums));
  std::size_t at = own + sums;
  for (const auto& one : apart_) {
    one->cut_state(Out(numbers).subspan(at));
    one->numbers_ = {};
    at += one->own_.size();
  }
  numbers_ = std::move(numbers);
}

/// 1 for each joint whose torque jumps at rest, else 0, by joint; empty if there is none.
std::vector<double> Simulation::jumps() const {
  const DcMotor* const motors = actuator_->dc_motors();
  const std::span<const JointFriction> friction = actuator_->friction();
  std::vector<double> jumps(layout_.joints, 0.0);
  for (std::size_t j = 0; j < jumps.size(); ++j) {
    const std::size_t i = j * lanes_.size();
    if ((motors != nullptr && motors[i].jumps > 0) || (!friction.empty() && friction[i].dry > 0)) jumps[j] = 1;
  }
  for (const std::size_t j : lanes_.front()->passive)
    jumps[j] = plant_->holds_hinges() && lanes_.front()->robot.joints[j].passive->friction > 0 ? 1 : 0;
  return std::ranges::find(jumps, 1.0) == jumps.end() ? std::vector<double>() : jumps;
}

/// Copies the present state to the twin if a window starts. Called before a step.
void Simulation::begin_window() {
  if (!how_.begins(step_number())) return;
  Simulation& twin = *apart_.front();
  std::ranges::copy(own_, twin.own_.begin());
  twin.state_[0] = static_cast<double>(math::steps_in(time(), twin.h_));
  for (std::size_t l = 0; l < lanes_.size(); ++l) twin.lanes_[l]->closed = lanes_[l]->closed;
}

/// Advances the companions and compares torques. Called after a step, before the step counter advances.
void Simulation::estimate() {
  const std::int64_t step = step_number();
  const std::int64_t at = how_.at(step);
  const bool asked = (at + 1) % how_.compare == 0;
  if (how_.steps == 0) {
    for (const auto& one : apart_) one->step_companion(1);
  }
  if (step_error_->jumps()) add_to_means();
  if (asked) {
    evaluate_torques(h_);
    step_error_->see(first_.of(In(torque_), FirstLanes::torque), first_.of(In(slope_), FirstLanes::speed),
                     first_.of(motor_speeds(), FirstLanes::angle));
  }
  const double t = static_cast<double>(step + 1) * h_;
  if (how_.steps != 0) return estimate_in_window(asked, t);
  In torque, speed;
  for (std::size_t k = 0; asked && k < kDifferences; ++k) {
    if (k < kCompanions && !apart_.empty()) apart_[k]->evaluate_torques(apart_[k]->h_);
    if (k < kCompanions) {
      torque = apart_.empty() ? first_.from(torque_, recorded_ + k, FirstLanes::torque) : In(apart_[k]->torque_);
      speed = apart_.empty() ? first_.from(motor_speeds(), recorded_ + k, FirstLanes::speed) : apart_[k]->motor_speeds();
    }
    step_error_->compare(static_cast<Companion>(k), torque, kFactors[k], 1, t, speed);
  }
}

/// Adds the last step of the run and of its companions with other accuracies to their mean torques. A part of a step without
/// weight in a lane need not be finite there.
void Simulation::add_to_means() {
  const double interval = static_cast<double>(how_.compare) * h_;
  const auto each = [](const StepEffort& of, std::size_t lane, const auto& add) {
    for (const StepEffort::Part& part : of.parts) {
      if (!part.instant && (part.sum[lane] != 0 || part.share[lane] != 0)) add(part);
    }
  };
  const StepEffort own = plant_->applied();
  each(own, 0, [&](const StepEffort::Part& part) {
    step_error_->add(first_.of(part.torque, FirstLanes::torque), part.sum[0] / interval, part.share[0] / interval);
  });
  for (const Companion which : {Companion::twin, Companion::coarse}) {
    const auto k = static_cast<std::size_t>(which);
    const bool beside = apart_.empty();
    const std::size_t lane = beside ? recorded_ + k : 0;
    each(beside ? own : apart_[k]->plant_->applied(), lane, [&](const StepEffort::Part& part) {
      const In torque = beside ? first_.from(part.torque, lane, FirstLanes::torque) : part.torque;
      step_error_->add(which, torque, part.sum[lane] / interval, part.share[lane] / interval);
    });
  }
}

void Simulation::estimate_in_window(bool asked, double t) {
  const std::int64_t step = step_number();
  const bool together = how_.steps < 0 || how_.at(step) % how_.steps == how_.steps - 1;
  if (!how_.runs(step) || !together) return;
  apart_.front()->step_companion(std::max(1, -how_.steps));
  if (!asked || !how_.compares(step)) return;
  const double weight = step < how_.cycle ? StepError::kStart : 1;
  apart_.front()->evaluate_torques(apart_.front()->h_);
  step_error_->compare(Companion::twin, apart_.front()->torque_, how_.factor, weight, t);
}

/// Advances a companion by `times` steps without recording. A lane that diverges or whose plugin throws stops and stays at its
/// initial state.
void Simulation::step_companion(int times) try {
  for (int i = 0; i < times; ++i) {
    apply_faults();
    if (any(&Simulation::control_tick)) {
      sense();
      command();
    }
    plant_->advance(commands(), h_);
    state_[0] += 1;
    check();
  }
} catch (const PluginError& error) {  // the run continues
  for (const auto& lane : lanes_) fail(*lane, stopped(error, step_number(), time()));
}

}  // namespace gaitlab
