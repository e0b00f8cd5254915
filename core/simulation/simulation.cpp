#include "core/simulation/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/laws/hinge_stop.h"
#include "core/scenario/plugin_instance.h"
#include "core/simulation/cpg_check.h"
#include "core/simulation/start.h"
#include "core/simulation/start_check.h"
#include "core/simulation/step_advice.h"

namespace gaitlab {

namespace {

// Beyond this no joint is a joint any more; a run stops here rather than at the overflow a few steps later.
constexpr double kLargestSpeed = 1e5;  // rad/s

}  // namespace

std::int64_t whole(double period, double step) { return std::llround(period / step); }

SimulationError::SimulationError(std::int64_t at_step, double at_time, std::string at, const std::string& what)
    : RunError(what), step(at_step), time(at_time), where(std::move(at)) {}

/// The scalar half of one rollout: its CPG, controller, sensors, trace row.
struct Simulation::Lane {
  Lane(const Scenario& s, const RobotInfo& info, std::size_t contacts)
      : scenario(s),
        cpg(make_cpg(s.cpg, info)),
        controller(make_controller(s.controller, info)),
        sample(*s.robot, contacts, cpg == nullptr ? 0 : cpg->states()) {
    const std::size_t n = info.joints.size();
    for (auto* values : {&angle, &speed, &torque, &setpoint, &command, &limit}) values->assign(n, 0.0);
    touching.assign(info.modules.size(), 0.0);
    for (auto* values : {&k1, &k2, &k3, &k4, &stage}) values->assign(sample.cpg.size(), 0.0);
  }

  [[nodiscard]] Measured measured(double t) const { return {t, scenario.control_period, angle, speed, torque, touching}; }

  /// CPG states from t to t + Ts: classical Runge-Kutta, sub-step cpg.step, inputs held.
  void integrate_cpg(double t) {
    const std::int64_t sub_steps = whole(scenario.control_period, scenario.cpg_step);
    const double h = scenario.cpg_step;
    for (std::int64_t i = 0; i < sub_steps && !cpg_state.empty(); ++i) {
      const auto slope = [&](double reach, In k, Out out) {
        const Measured m = measured(t + (static_cast<double>(i) + reach) * h);
        for (std::size_t j = 0; j < stage.size(); ++j) stage[j] = cpg_state[j] + (k.empty() ? 0 : reach * h * k[j]);
        cpg->derivative(m, stage, out);
      };
      slope(0, {}, k1);
      slope(0.5, k1, k2);
      slope(0.5, k2, k3);
      slope(1, k3, k4);
      for (std::size_t j = 0; j < stage.size(); ++j) cpg_state[j] += h / 6 * (k1[j] + 2 * (k2[j] + k3[j]) + k4[j]);
    }
  }

  const Scenario& scenario;
  std::unique_ptr<Cpg> cpg;
  std::unique_ptr<Controller> controller;
  Out cpg_state, controller_state, ledger;                                       // parts of the one state array
  double energy_at_start = 0;                                                    // J
  std::vector<double> angle, speed, torque, touching, setpoint, command, limit;  // one lane, contiguous, for the plugins
  std::vector<double> k1, k2, k3, k4, stage;
  Sample sample;
  std::unique_ptr<Probes> probes;
  RunRecord record;
};

Simulation::Simulation(std::span<const Scenario> lanes) try
    : scenarios_(lanes.begin(), lanes.end()),
      robot_(*scenarios_.at(0).robot),
      h_(scenarios_[0].physics.step),
      steps_(whole(scenarios_[0].duration, h_)),
      control_every_(whole(scenarios_[0].control_period, h_)),
      trace_every_(whole(scenarios_[0].trace.period, h_)),
      contacts_(contact_elements(robot_, static_cast<ContactSet>(scenarios_[0].contact.on))),
      layout_{robot_.joints.size(), scenarios_.size()},
      meter_(robot_, scenarios_.size()) {
  const Scenario& first = scenarios_[0];
  if (scenarios_.size() > first.physics.engine->max_lanes) {
    throw std::invalid_argument(fmt::format("engine {} runs {} rollouts side by side, not {}", first.physics.engine->name,
                                            first.physics.engine->max_lanes, scenarios_.size()));
  }
  const RobotInfo about = info(robot_);
  std::vector<const Choice*> actuators;
  for (const Scenario& lane : scenarios_) actuators.push_back(&lane.actuator);
  actuator_ = make_actuator(actuators, about);
  PlantSettings settings{first.robot,     first.base,        first.physics.gravity,
                         first.ground,    contacts_,         first.contact.penalty,
                         actuator_.get(), scenarios_.size(), first.physics.integrator};
  plant_ = first.physics.engine->make(settings);
  for (const Scenario& lane : scenarios_) lanes_.push_back(std::make_unique<Lane>(lane, about, contacts_.size()));
  for (auto* values : {&voltage_, &current_, &saturation_, &power_in_, &copper_, &gear_, &torque_, &slope_, &angle_, &speed_}) {
    values->assign(robot_.joints.size() * lanes_.size(), 0.0);
  }
  cut_state();
  set_start();
  check_standing();
} catch (const PluginError& error) {
  throw InputError(lanes[0].place(std::string(word(error.kind)) + ".type"), error.what());
}

Simulation::~Simulation() = default;

/// step counter | plant | set points | commands | per lane: CPG states, controller states, ledger's sums.
void Simulation::cut_state() {
  const std::size_t joints = robot_.joints.size() * lanes_.size();
  std::size_t size = 1 + layout_.size() + 2 * joints;
  for (const auto& lane : lanes_) {
    size += lane->sample.cpg.size() + (lane->controller == nullptr ? 0 : lane->controller->states()) + Ledger::kSums;
  }
  state_.assign(size, 0.0);
  std::size_t at = 1;
  const auto cut = [&](std::size_t count) {
    const Out part = Out(state_).subspan(at, count);
    at += count;
    return part;
  };
  plant_state_ = cut(layout_.size());
  setpoint_ = cut(joints);
  command_ = cut(joints);
  for (const auto& lane : lanes_) {
    lane->cpg_state = cut(lane->sample.cpg.size());
    lane->controller_state = cut(lane->controller == nullptr ? 0 : lane->controller->states());
    lane->ledger = cut(Ledger::kSums);
  }
  plant_->bind(plant_state_);
}

void Simulation::set_start() {
  const std::size_t lanes = lanes_.size();
  for (std::size_t l = 0; l < lanes; ++l) {
    Lane& lane = *lanes_[l];
    const Scenario& s = lane.scenario;
    Sample& sample = lane.sample;
    sample.gravity = s.physics.gravity;
    RobotState& start = sample.state;
    start = start_state(s);
    sample.place(robot_);
    layout_.write(start, l, plant_state_);
    lane.energy_at_start = energy(sample, l);
    // No command yet: set point = angle, command 0.
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) setpoint_[j * lanes + l] = start.q[j];
    if (lane.cpg != nullptr) lane.cpg->start(lane.cpg_state);
    if (lane.controller != nullptr) lane.controller->start(lane.controller_state);
    for (std::size_t j = 0; actuator_ != nullptr && j < robot_.joints.size(); ++j) {
      lane.limit[j] = actuator_->command_limit()[j * lanes + l];
    }
    lane.probes =
        std::make_unique<Probes>(s, contacts_, lane.cpg.get(), actuator_ == nullptr ? "" : actuator_->command_unit(), sample);
    const auto rows = static_cast<std::size_t>(steps_ / trace_every_ + 1);
    lane.record.trace.columns = lane.probes->columns();
    lane.record.trace.values.reserve(rows * lane.record.trace.columns.size());
    for (auto* series : {&lane.record.com_x, &lane.record.com_y, &lane.record.com_z}) series->reserve(rows);
    lane.record.poses.reserve(rows * 7);
    for (auto* series : {&lane.record.angles, &lane.record.setpoints, &lane.record.torques})
      series->reserve(rows * robot_.joints.size());
    lane.record.loads.reserve(rows * robot_.modules.size());
  }
}

void Simulation::check_standing() {
  const In rotors = actuator_ == nullptr ? In{} : actuator_->reflected_inertia();
  for (std::size_t l = 0; l < lanes_.size(); ++l) {
    check_inertia(scenarios_[l], lanes_[l]->sample.kinematics, rotors, lanes_.size(), l, scenarios_[l].place("robot"));
    const Stability one = plant_->stability(l, command_, true);
    if (one.rate > standing_.rate) standing_ = one;
  }
  if (!(h_ * standing_.rate > 1)) return;
  const Scenario& s = scenarios_[0];
  throw InputError(s.place("physics.step"), step_advice(s, contacts_, standing_, "standing"));
}

void Simulation::step() {
  if (trace_tick()) record();
  if (control_tick()) {
    sense();
    command();
  }
  advance();
  check();
}

bool Simulation::run(const std::function<void(double)>& progress, const std::atomic<bool>* stop) try {
  const std::int64_t report_every = std::max<std::int64_t>(1, steps_ / 200);
  while (!done()) {
    step();
    if (progress && step_number() % report_every == 0)
      progress(static_cast<double>(step_number()) / static_cast<double>(steps_));
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) return false;
  }
  record();  // t = duration is a row even where it is no multiple of the trace period
  return true;
} catch (const PluginError& error) {
  throw SimulationError(step_number(), time(), word(error.kind),
                        fmt::format("stopped at step {}, t = {:.6g} s: {}", step_number(), time(), error.what()));
}

/// The actuator law at these speeds under the commands in force.
void Simulation::report(In speeds) {
  if (actuator_ == nullptr) return;
  actuator_->report(command_, speeds, {voltage_, current_, saturation_, power_in_, copper_, gear_});
}

/// Kinetic and potential, rotors included, J.
double Simulation::energy(const Sample& sample, std::size_t l) const {
  double rotors = 0;
  const In inertia = actuator_ == nullptr ? In() : actuator_->reflected_inertia();
  for (std::size_t j = 0; j < robot_.joints.size() && !inertia.empty(); ++j) {
    rotors += inertia[j * lanes_.size() + l] * sample.state.qd[j] * sample.state.qd[j] / 2;
  }
  return sample.sums.kinetic + sample.sums.potential + rotors;
}

Sample& Simulation::take_sample(Lane& lane, std::size_t l) {
  const std::size_t lanes = lanes_.size();
  Sample& s = lane.sample;
  s.t = time();
  layout_.read(plant_state_, l, s.state);
  s.place(robot_);
  plant_->contacts(l, s.contacts);
  for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
    const std::size_t i = j * lanes + l;
    s.setpoint[j] = setpoint_[i];
    s.command[j] = command_[i];
    s.voltage[j] = voltage_[i];
    s.current[j] = current_[i];
    s.saturation[j] = saturation_[i];
    s.torque[j] = torque_[i];
    s.stop_torque[j] = HingeStop::at(s.state.q[j], s.state.qd[j], robot_.joints[j].lo, robot_.joints[j].hi).torque;
  }
  std::copy(lane.cpg_state.begin(), lane.cpg_state.end(), s.cpg.begin());
  s.ledger = Ledger::of(lane.ledger, energy(s, l) - lane.energy_at_start);
  return s;
}

void Simulation::record() {
  report(plant_state_.subspan(layout_.speeds(), command_.size()));
  if (actuator_ != nullptr) {
    actuator_->effort(command_, plant_state_.subspan(layout_.speeds(), command_.size()), torque_, slope_);
  }
  for (std::size_t l = 0; l < lanes_.size(); ++l) {
    Lane& lane = *lanes_[l];
    Sample& s = take_sample(lane, l);
    if (lane.probes->want_reactions()) s.react(contacts_, *plant_);
    RunRecord& r = lane.record;
    r.ledger = s.ledger;
    r.trace.values.resize(r.trace.values.size() + r.trace.columns.size());
    lane.probes->fill(s, Out(r.trace.values).last(r.trace.columns.size()));
    r.com_x.push_back(s.sums.com.x());
    r.com_y.push_back(s.sums.com.y());
    r.com_z.push_back(s.sums.com.z());
    const Quat& turn = s.state.orientation;
    for (const double x :
         {s.state.position.x(), s.state.position.y(), s.state.position.z(), turn.w(), turn.x(), turn.y(), turn.z()}) {
      r.poses.push_back(x);
    }
    r.angles.insert(r.angles.end(), s.state.q.begin(), s.state.q.end());
    r.setpoints.insert(r.setpoints.end(), s.setpoint.begin(), s.setpoint.end());
    r.torques.insert(r.torques.end(), s.torque.begin(), s.torque.end());
    r.loads.resize(r.loads.size() + robot_.modules.size(), 0.0);
    const Out loads = Out(r.loads).last(robot_.modules.size());
    for (std::size_t c = 0; c < contacts_.size(); ++c) loads[robot_.bodies[contacts_[c].body].module] += s.contacts[c].fn;
  }
}

void Simulation::sense() {
  const std::size_t lanes = lanes_.size();
  // The left limit, as in a row: what is measured depends on the state and the command in force, not on how the last step was
  // taken.
  if (actuator_ != nullptr) {
    actuator_->effort(command_, plant_state_.subspan(layout_.speeds(), command_.size()), torque_, slope_);
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    Lane& lane = *lanes_[l];
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      lane.angle[j] = plant_state_[layout_.angles() + j * lanes + l];
      lane.speed[j] = plant_state_[layout_.speeds() + j * lanes + l];
      lane.torque[j] = torque_[j * lanes + l];
    }
    std::fill(lane.touching.begin(), lane.touching.end(), 0.0);
    plant_->contacts(l, lane.sample.contacts);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (lane.sample.contacts[c].fn > 0) lane.touching[robot_.bodies[contacts_[c].body].module] = 1;
    }
  }
}

void Simulation::command() {
  const std::size_t lanes = lanes_.size();
  for (std::size_t l = 0; l < lanes; ++l) {
    Lane& lane = *lanes_[l];
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
      setpoint_[j * lanes + l] = lane.setpoint[j];
      command_[j * lanes + l] = lane.command[j];
    }
    if (lane.cpg == nullptr) continue;
    lane.integrate_cpg(time());
    check_cpg(*lane.cpg, robot_, lane.setpoint, lane.cpg_state, step_number(), time());
  }
  watch_stability();
}

void Simulation::watch_stability() {
  for (std::size_t l = 0; l < lanes_.size(); ++l) {
    RunRecord& record = lanes_[l]->record;
    const Stability now = plant_->stability(l, command_, false);
    ++record.ticks;
    if (h_ * now.rate > 1) ++record.ticks_above_1;
    if (now.rate > record.worst.rate) {
      record.worst = now;
      record.worst_time = time();
    }
  }
}

void Simulation::advance() {
  const auto part = [&](std::size_t at) { return plant_state_.subspan(at, command_.size()); };
  std::ranges::copy(part(layout_.angles()), angle_.begin());
  std::ranges::copy(part(layout_.speeds()), speed_.begin());
  plant_->advance(command_, h_);
  report(plant_->applied().speed);
  meter_.add(angle_, speed_, setpoint_, plant_->applied().torque, {voltage_, current_, saturation_, power_in_, copper_, gear_},
             h_);
  keep_ledger();
  state_[0] += 1;
}

void Simulation::keep_ledger() {
  const std::size_t lanes = lanes_.size();
  const Applied applied = plant_->applied();
  for (std::size_t l = 0; l < lanes; ++l) {
    const Out sums = lanes_[l]->ledger;
    for (std::size_t i = l; i < command_.size(); i += lanes) {
      sums[0] += h_ * power_in_[i];
      sums[1] += h_ * copper_[i];
      sums[2] += h_ * gear_[i];
    }
    sums[3] += applied.contact[l];
    sums[4] += applied.friction[l];
    sums[5] += applied.stops[l];
  }
}

void Simulation::check() const {
  bool fine = true;
  for (const double value : plant_state_) fine = fine && std::abs(value) < kLargestSpeed;  // false for NaN too
  if (!fine) diverged();
}

void Simulation::diverged() const {
  const std::size_t lanes = lanes_.size();
  std::string where = "base";
  double worst = 0;
  bool finite = true;
  for (std::size_t i = 0; i < command_.size(); ++i) {
    const double speed = std::abs(plant_state_[layout_.speeds() + i]);
    if (!std::isfinite(speed) && finite) {
      finite = false;
      where = robot_.joints[i / lanes].name;
    }
    if (finite && speed > worst && speed >= kLargestSpeed) {
      worst = speed;
      where = robot_.joints[i / lanes].name;
    }
  }
  throw SimulationError(step_number(), time(), where,
                        fmt::format("diverged at step {}, t = {:.6g} s: {}{}", step_number(), time(),
                                    where == "base" ? "the base" : "joint " + where,
                                    finite && worst > 0 ? fmt::format(" turns at {:.3g} rad/s", worst)
                                                        : fmt::format(" has left the numbers (+-{:g})", kLargestSpeed)));
}

RunRecord Simulation::take_record(std::size_t lane) {
  RunRecord record = std::move(lanes_[lane]->record);
  record.steps = step_number();
  for (std::size_t j = 0; j < robot_.joints.size(); ++j) record.joints.push_back(meter_.figures(j, lane));
  return record;
}

}  // namespace gaitlab
