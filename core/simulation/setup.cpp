// Set-up of a simulation from scenarios, and its initial state.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/laws/dc_motor.h"
#include "core/scenario/built_robot.h"
#include "core/simulation/lane.h"
#include "core/simulation/start.h"
#include "core/simulation/start_check.h"
#include "core/simulation/step_advice.h"

namespace gaitlab {

const char* keeps_apart(const Scenario& a, const Scenario& b) {
  const auto same_link = [](const Link& x, const Link& y) { return x.parent == y.parent && x.joint == y.joint; };
  const auto same_drive = [](const Joint& x, const Joint& y) {
    return x.driven() == y.driven() && x.play.any() == y.play.any();
  };
  const auto same_place = [](const ContactElement& x, const ContactElement& y) { return x.link == y.link; };
  const auto elements = [](const Scenario& s) { return contact_elements(*s.robot, s.contact.on); };
  if (a.physics.engine != b.physics.engine) return "physics.engine";
  if (a.physics.integrator != b.physics.integrator) return "physics.integrator";
  if (a.physics.step != b.physics.step || a.physics.adaptive_step != b.physics.adaptive_step) return "physics.step";
  if (estimated_by_rollouts(a) != estimated_by_rollouts(b)) return "physics.estimate";
  if (a.control_period != b.control_period) return "controller.period";
  if (a.actuator.entry != b.actuator.entry) return "actuator.type";
  if (a.base != b.base) return "robot.base";
  if (a.contact.law != b.contact.law) return "contact.law";
  const bool same = std::ranges::equal(a.robot->links, b.robot->links, same_link) &&
                    std::ranges::equal(a.robot->joints, b.robot->joints, same_drive) &&
                    std::ranges::equal(elements(a), elements(b), same_place);
  return same ? nullptr : "the links, motors or contact elements of the robot";
}

Simulation::Simulation(std::span<const Scenario> lanes, Records records) : Simulation(lanes, records, Role::run) {}

Simulation::Simulation(std::span<const Scenario> lanes, Records records, Role role) try
    : scenarios_(side_by_side(lanes, role)),
      recorded_(lanes.size()),
      records_(records),
      role_(role),
      h_(scenarios_.at(0).physics.step),
      plays_(joints_with_play(*scenarios_[0].robot)),
      layout_{scenarios_[0].robot->joints.size(), scenarios_.size(), plays_.size()},
      first_(layout_, recorded_),
      meter_(std::span(scenarios_).first(recorded_)) {
  // A log of the real robot is compared with rows of the trace.
  if (std::ranges::any_of(scenarios_, [](const Scenario& s) { return s.measured.any(); })) records_.rows = true;
  std::vector<const Scenario*> all;
  for (const Scenario& s : scenarios_) {
    if (!can_share(scenarios_[0], s)) throw std::invalid_argument("these scenarios cannot run side by side");
    all.push_back(&s);
    lanes_.push_back(std::make_unique<Lane>(s, lanes_.size(), records_.rows));
    steps_ = std::max(steps_, lanes_.back()->clock.steps());
  }
  const Scenario& first = scenarios_[0];
  const auto& widths = first.physics.engine->lanes;
  if (std::find(widths.begin(), widths.end(), lanes_.size()) == widths.end()) {
    throw std::invalid_argument(fmt::format("engine {} runs {} rollouts side by side, not {}", first.physics.engine->name,
                                            fmt::join(widths, " or "), lanes_.size()));
  }
  actuator_ = make_motors(all);
  if (recorded_ != lanes_.size()) own_actuator_ = make_motors(std::span(all).first(recorded_));
  prepare_faults();
  plant_ = make_plant(first, plant_settings());
  make_supplies();
  for (auto* values :
       {&voltage_, &current_, &saturation_, &power_in_, &copper_, &gear_, &torque_, &slope_, &friction_, &dry_}) {
    values->assign(layout_.joints * lanes_.size(), 0.0);
  }
  const DcMotor* const motors = actuator_ == nullptr ? nullptr : actuator_->dc_motors();
  rubs_ = actuator_ != nullptr && !actuator_->friction().empty();
  for (std::size_t i = 0; motors != nullptr && i < torque_.size(); ++i) rubs_ = rubs_ || motors[i].jumps > 0;
  for (const auto& lane : lanes_) {
    for (const std::size_t j : lane->passive) rubs_ = rubs_ || lane->robot.joints[j].passive->friction > 0;
  }
  if (!plays_.empty()) motor_speed_.assign(layout_.joints * lanes_.size(), 0.0);
  available_.assign(layout_.joints * lanes_.size(), 0.0);
  largest_.assign(layout_.joints * recorded_, 0.0);
  numbers_.assign(state_size(), 0.0);
  cut_state(numbers_);
  set_start();
  if (role_ == Role::companion) return;
  check_standing();
  if (role_ == Role::run) make_estimate();
} catch (const PluginError& error) {
  throw InputError(lanes[0].place(std::string(word(error.kind)) + ".type"), error.what());
}

Simulation::~Simulation() = default;

PlantSettings Simulation::plant_settings() const {
  const auto own = [](const Lane& lane) {
    const Scenario& s = lane.scenario;
    return LaneSettings{s.robot,           s.physics.gravity,  s.ground,       lane.contacts,
                        s.contact.penalty, s.physics.accuracy, stuck_joints(s)};
  };
  PlantSettings settings;
  static_cast<LaneSettings&>(settings) = own(*lanes_[0]);
  for (std::size_t l = 1; l < lanes_.size(); ++l) settings.others.push_back(own(*lanes_[l]));
  settings.base = scenarios_[0].base;
  settings.actuator = actuator_.get();
  settings.integrator = scenarios_[0].physics.integrator->name;
  settings.contact = scenarios_[0].contact.law;
  settings.step = h_;
  return settings;
}

/// Joints of a lane whose gears have a rated peak torque.
std::vector<std::size_t> Simulation::rated_gears(const Lane& lane) const {
  std::vector<std::size_t> joints;
  if (actuator_ == nullptr || actuator_->ratings().empty()) return joints;
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    const DriveRatings& ratings = actuator_->ratings()[j * lanes_.size() + lane.index];
    if (lane.robot.joints[j].driven() && ratings.torque_peak > 0) joints.push_back(j);
  }
  return joints;
}

/// Number of changing values of this simulation, without the values of separate companions.
std::size_t Simulation::state_size() const {
  std::size_t size = 1 + layout_.size() + plant_->history() + 2 * layout_.joints * lanes_.size();
  if (bounded_) size += 2 * (layout_.joints + buses_) * lanes_.size();
  for (const auto& lane : lanes_) {
    size += lane->sample.cpg.size() + (lane->controller == nullptr ? 0 : lane->controller->states()) + Ledger::kSums;
    size += lane->sensors.states() + lane->changes.states();
  }
  return size;
}

/// Divides `numbers` into step counter | plant | its history | set points | commands | per lane: CPG states, controller states,
/// sums of the ledger, sensors, changes. The present values are copied.
void Simulation::cut_state(Out numbers) {
  std::ranges::copy(own_, numbers.begin());
  own_ = numbers.first(state_size());
  state_ = numbers;
  const std::size_t joints = layout_.joints * lanes_.size();
  std::size_t at = 1;
  const auto cut = [&](std::size_t count) {
    const Out part = numbers.subspan(at, count);
    at += count;
    return part;
  };
  plant_state_ = cut(layout_.size());
  plant_history_ = cut(plant_->history());
  setpoint_ = cut(joints);
  command_ = cut(joints);
  if (bounded_) {
    bound_ = cut(joints);
    within_bound_ = cut(joints);
    bus_ = cut(2 * buses_ * lanes_.size());
  }
  for (const auto& lane : lanes_) {
    const std::size_t from = at;
    lane->cpg_state = cut(lane->sample.cpg.size());
    lane->controller_state = cut(lane->controller == nullptr ? 0 : lane->controller->states());
    lane->ledger = cut(Ledger::kSums);
    lane->sensors.bind(cut(lane->sensors.states()));
    lane->changes.bind(cut(lane->changes.states()));
    lane->block = numbers.subspan(from, at - from);
  }
  saved_.resize(state_.size());
  measured_.resize(lanes_.size());
  ended_.reserve(lanes_.size());
  plant_->bind(plant_state_, plant_history_);
}

RowsNeeded Simulation::rows_needed(std::size_t lane) const { return lanes_[lane]->recorder->rows_needed(); }

void Simulation::set_start() {
  for (const auto& one : lanes_) {
    Lane& lane = *one;
    const std::size_t l = lane.index;
    const Scenario& s = lane.scenario;
    Sample& sample = lane.sample;
    sample.gravity = s.physics.gravity;
    place_at_start(lane);
    sample.forward_kinematics(lane.robot);
    lane.energy_at_start = sample.energy(lane.robot, rotors(lane), lane.passive);
    sample.set_boxes(s.ground);
    if (lane.cpg != nullptr) lane.cpg->start(lane.cpg_state);
    if (lane.controller != nullptr) lane.controller->start(lane.controller_state);
    for (std::size_t j = 0; actuator_ != nullptr && j < layout_.joints; ++j) {
      const bool duty = lane.controller != nullptr && lane.controller->command_unit() == "duty";
      lane.limit[j] = duty ? 1 : actuator_->command_limit()[j * lanes_.size() + l];
    }
    if (!recorded(lane)) continue;
    const std::string_view unit = actuator_ == nullptr ? "" : actuator_->command_unit();
    lane.recorder = std::make_unique<Recorder>(s, lane.contacts, lane.cpg, unit, sample, records_, rated_gears(lane));
  }
  // The row at t = 0 is recorded before the first tick, but contains the readings of this tick. The tick then repeats the
  // readings.
  if (std::ranges::any_of(lanes_, [](const auto& lane) { return !lane->sensors.empty(); })) sense();
  for (const auto& lane : lanes_) lane->sensed = false;
}

/// Resets a lane to its initial state, without a command yet: set point = angle, command 0.
void Simulation::place_at_start(Lane& lane) {
  const RobotState start = start_state(lane.scenario);
  lane.sample.state = start;  // copied, not moved, because the probes point into its vectors
  layout_.write(lane.sample.state, lane.index, plant_state_);
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    setpoint_[j * lanes_.size() + lane.index] = lane.sample.state.q[j];
    command_[j * lanes_.size() + lane.index] = 0;
  }
  if (!bounded_) return;
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    bound_[j * lanes_.size() + lane.index] = std::numeric_limits<double>::infinity();
    within_bound_[j * lanes_.size() + lane.index] = 0;
  }
  for (std::size_t b = 0; b < lane.supply.buses(); ++b) {
    const std::size_t at = 2 * (b * lanes_.size() + lane.index);
    bus_[at] = lane.supply.open_circuit(b);
    bus_[at + 1] = 0;
  }
}

void Simulation::check_standing() {
  const In rotors = actuator_ == nullptr ? In{} : actuator_->reflected_inertia();
  for (const auto& lane : lanes_) {
    const Scenario& s = lane->scenario;
    check_inertia(s, lane->sample.kinematics, rotors, lanes_.size(), lane->index, s.place("robot"));
    const Stability one = plant_->stability(lane->index, command_, true);
    if (one.rate > standing_.rate) standing_ = one;
    if (h_ * one.rate > 1) throw InputError(s.place("physics.step"), step_advice(s, lane->contacts, one, "standing"));
  }
}

}  // namespace gaitlab
