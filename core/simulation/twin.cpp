// The twin of a simulation, from which the torque error is estimated: when it steps, and what it is compared in.
#include <algorithm>
#include <cmath>

#include "core/plugin/plugin_instance.h"
#include "core/simulation/lane.h"
#include "core/simulation/simulation.h"

namespace gaitlab {

namespace {

/// Steps of h in as many control periods as last for `seconds`.
std::int64_t whole_periods(double seconds, double h, std::int64_t control_every) {
  const double periods = seconds / (h * static_cast<double>(control_every));
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(periods - 1e-9))) * control_every;
}

constexpr double kEventShare = 0.01;  // of a torque's peak, of integrators without an accuracy

}  // namespace

StepTwin Simulation::twin_schedule() const {
  const Physics& physics = scenarios_[0].physics;
  const std::int64_t control_every = std::llround(scenarios_[0].control_period / h_);
  StepTwin how{.factor = StepError::kOfAccuracy};
  for (std::int64_t n = 1; n <= control_every; ++n) {
    if (control_every % n == 0 && static_cast<double>(n) * h_ <= StepError::kApart * (1 + 1e-9)) how.compare = n;
  }
  if (physics.adapts()) return how;
  const double ratio = 1 << physics.integrator->order;
  // An explicit step of twice the length may be too long for the robot.
  const bool longer = control_every % 2 == 0 && !(standing_.rate > 0);
  how.steps = longer ? 2 : -2;
  how.factor = (longer ? 1 : ratio) * StepError::kSafety / (ratio - 1);
  how.window = whole_periods(longer ? 0.18 : 0.09, h_, control_every);
  how.cycle = (longer ? 5 : 20) * how.window;
  how.settle = whole_periods(StepError::kGrowth, h_, control_every);
  return how;
}

std::vector<Scenario> Simulation::twins(const StepTwin& how) const {
  std::vector<Scenario> all = scenarios_;
  for (Scenario& one : all) {
    if (how.window == 0) one.physics.accuracy *= StepError::kCoarser;
    if (how.steps > 1) one.physics.step *= how.steps;
    if (how.steps < 0) one.physics.step /= -how.steps;
  }
  return all;
}

/// Where there are motors, and a state that can be copied.
void Simulation::make_twin() {
  const Physics& physics = scenarios_[0].physics;
  const bool wanted = std::ranges::any_of(scenarios_, [](const Scenario& s) { return s.physics.estimate == Estimate::full; });
  const bool known = physics.adapts() || physics.integrator->order > 0;
  if (!wanted || actuator_ == nullptr || !known || !plant_->state_is_complete() || layout_.joints == 0) return;
  how_ = twin_schedule();
  twin_.reset(new Simulation(twins(how_), Loads::left_out, Role::twin));
  std::vector<double> accuracy;
  for (const Scenario& s : scenarios_) accuracy.push_back(s.physics.adapts() ? s.physics.accuracy : kEventShare);
  step_error_ = std::make_unique<StepError>(*actuator_, layout_, accuracy);

  // One array for all that changes: this, the twin, the sums.
  const std::size_t own = own_.size();
  const std::size_t sums = StepError::size(layout_);
  std::vector<double> numbers(own + sums + twin_->own_.size());
  cut_state(numbers);
  step_error_->bind(Out(numbers).subspan(own, sums));
  twin_->cut_state(Out(numbers).subspan(own + sums));
  twin_->numbers_ = {};
  numbers_ = std::move(numbers);
}

/// Before a step: at the start of a window the twin goes on from here.
void Simulation::begin_twin() {
  if (!how_.begins(step_number())) return;
  std::ranges::copy(own_, twin_->own_.begin());
  twin_->state_[0] = static_cast<double>(std::llround(time() / twin_->h_));
  for (std::size_t l = 0; l < lanes_.size(); ++l) twin_->lanes_[l]->closed = lanes_[l]->closed;
}

/// After a step, before it is counted.
void Simulation::follow_twin() {
  const std::int64_t step = step_number();
  const std::int64_t at = how_.at(step);
  const bool asked = (at + 1) % how_.compare == 0;
  if (asked) step_error_->see(command_, plant_state_.subspan(layout_.speeds(), command_.size()));
  const bool together = how_.steps < 2 || at % how_.steps == how_.steps - 1;
  if (!how_.runs(step) || !together) return;
  try {
    for (int i = 0; i < std::max(1, -how_.steps); ++i) twin_->step_twin();
    if (!asked || !how_.compares(step)) return;
    const bool first = how_.window > 0 && step < how_.cycle;
    step_error_->compare(twin_->command_, twin_->plant_state_.subspan(layout_.speeds(), command_.size()), how_.factor,
                         first ? StepError::kStart : 1, static_cast<double>(step + 1) * h_);
  } catch (const PluginError& error) {  // of the twin: the run goes on
    for (const auto& lane : twin_->lanes_) twin_->fail(*lane, twin_->stopped(error));
  }
}

/// step() of a twin: nothing is recorded, and a lane that leaves the numbers, or whose plugin throws, waits at its start.
void Simulation::step_twin() {
  if (any(&Simulation::control_tick)) {
    sense();
    command();
  }
  plant_->advance(command_, h_);
  state_[0] += 1;
  check();
}

}  // namespace gaitlab
