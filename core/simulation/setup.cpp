// How a simulation is made from scenarios, and where it starts.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <new>
#include <string>

#include "core/simulation/lane.h"
#include "core/simulation/start.h"
#include "core/simulation/start_check.h"
#include "core/simulation/step_advice.h"

namespace gaitlab {

namespace {

constexpr double kTickRows = 2e-3;  // s, between rows of Recording::ticks at least

}  // namespace

bool can_share(const Scenario& a, const Scenario& b) {
  const auto same_link = [](const Link& x, const Link& y) { return x.parent == y.parent && x.joint == y.joint; };
  const auto same_drive = [](const Joint& x, const Joint& y) { return x.driven() == y.driven(); };
  const auto same_place = [](const ContactElement& x, const ContactElement& y) { return x.link == y.link; };
  const auto elements = [](const Scenario& s) { return contact_elements(*s.robot, s.contact.on); };
  return estimated_by_rollouts(a) == estimated_by_rollouts(b) && a.physics.engine == b.physics.engine &&
         a.physics.integrator == b.physics.integrator && a.physics.step == b.physics.step &&
         a.physics.adaptive_step == b.physics.adaptive_step && a.control_period == b.control_period &&
         a.actuator.entry == b.actuator.entry && a.base == b.base && a.contact.solver() == b.contact.solver() &&
         std::ranges::equal(a.robot->links, b.robot->links, same_link) &&
         std::ranges::equal(a.robot->joints, b.robot->joints, same_drive) &&
         std::ranges::equal(elements(a), elements(b), same_place);
}

Simulation::Simulation(std::span<const Scenario> lanes, Loads loads) : Simulation(lanes, loads, Role::run) {}

Simulation::Simulation(std::span<const Scenario> lanes, Loads loads, Role role) try
    : scenarios_(side_by_side(lanes, role)),
      recorded_(lanes.size()),
      loads_(loads),
      role_(role),
      h_(scenarios_.at(0).physics.step),
      layout_{scenarios_[0].robot->joints.size(), scenarios_.size()},
      first_(layout_, recorded_),
      meter_(std::span(scenarios_).first(recorded_)) {
  std::vector<const PluginSelection*> actuators;
  for (const Scenario& s : scenarios_) {
    if (!can_share(scenarios_[0], s)) throw std::invalid_argument("these scenarios cannot run side by side");
    actuators.push_back(&s.actuator);
    lanes_.push_back(std::make_unique<Lane>(s, lanes_.size()));
    steps_ = std::max(steps_, lanes_.back()->clock.steps());
  }
  const Scenario& first = scenarios_[0];
  const auto& widths = first.physics.engine->lanes;
  if (std::find(widths.begin(), widths.end(), lanes_.size()) == widths.end()) {
    throw std::invalid_argument(fmt::format("engine {} runs {} rollouts side by side, not {}", first.physics.engine->name,
                                            fmt::join(widths, " or "), lanes_.size()));
  }
  actuator_ = make_actuator(actuators, info(*first.robot));
  if (recorded_ != lanes_.size()) own_actuator_ = make_actuator(std::span(actuators).first(recorded_), info(*first.robot));
  plant_ = make_plant(first, plant_settings());
  for (auto* values : {&voltage_, &current_, &saturation_, &power_in_, &copper_, &gear_, &torque_, &slope_}) {
    values->assign(layout_.joints * lanes_.size(), 0.0);
  }
  for (auto* values : {&available_, &largest_}) values->assign(layout_.joints * recorded_, 0.0);
  numbers_.assign(state_size(), 0.0);
  cut_state(numbers_);
  set_start();
  if (role_ == Role::companion) return;
  check_standing();
  make_estimate();
} catch (const PluginError& error) {
  throw InputError(lanes[0].place(std::string(word(error.kind)) + ".type"), error.what());
}

Simulation::~Simulation() = default;

PlantSettings Simulation::plant_settings() const {
  const auto own = [](const Lane& lane) {
    const Scenario& s = lane.scenario;
    return LaneSettings{s.robot, s.physics.gravity, s.ground, lane.contacts, s.contact.penalty, s.physics.accuracy};
  };
  PlantSettings settings;
  static_cast<LaneSettings&>(settings) = own(*lanes_[0]);
  for (std::size_t l = 1; l < lanes_.size(); ++l) settings.others.push_back(own(*lanes_[l]));
  settings.base = scenarios_[0].base;
  settings.actuator = actuator_.get();
  settings.integrator = scenarios_[0].physics.integrator->name;
  settings.solver = scenarios_[0].contact.solver();
  settings.step = h_;
  return settings;
}

/// Numbers that change, without those of the rollouts apart.
std::size_t Simulation::state_size() const {
  std::size_t size = 1 + layout_.size() + plant_->history() + 2 * layout_.joints * lanes_.size();
  for (const auto& lane : lanes_) {
    size += lane->sample.cpg.size() + (lane->controller == nullptr ? 0 : lane->controller->states()) + Ledger::kSums;
  }
  return size;
}

/// step counter | plant | its history | set points | commands | per lane: CPG states, controller states, ledger's sums. Takes
/// the present values along.
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
  for (const auto& lane : lanes_) {
    lane->cpg_state = cut(lane->sample.cpg.size());
    lane->controller_state = cut(lane->controller == nullptr ? 0 : lane->controller->states());
    lane->ledger = cut(Ledger::kSums);
  }
  saved_.resize(state_.size());
  measured_.resize(lanes_.size());
  ended_.reserve(lanes_.size());
  plant_->bind(plant_state_, plant_history_);
}

namespace {

RowsNeeded rows_needed(const Scenario& s, const Recording& recording) {
  return {s.duration / s.trace.period + 2, static_cast<double>(recording.trace.columns.size() + recording.rest.columns.size())};
}

/// GB of memory that there are for the rows, and whose.
std::string memory_text(double bytes, const char* whose) { return fmt::format("{} {:.3g} GB of memory", whose, bytes / 1e9); }

/// Where the rows, which are kept until the end of the run, do not fit into what there is.
InputError too_many_rows(const Scenario& s, const RowsNeeded& needed, const std::string& there_is) {
  return {s.place("duration"),
          fmt::format("the run would record {:.3g} rows of {:.0f} columns, {:.3g} GB, and {}: take a longer trace.period than "
                      "{:.3g} s, fewer trace.columns, or a shorter duration",
                      needed.rows, needed.columns, needed.bytes() / 1e9, there_is, s.trace.period)};
}

/// InputError of a machine, a container (cgroup 2) or a process (ulimit -v) that has not so much.
void check_memory(const Scenario& s, const RowsNeeded& needed) {
  constexpr double kLittle = 1e8;  // bytes: nobody has less, and asking takes longer than a short rollout
  if (needed.bytes() < kLittle) return;
  const auto check = [&](double bytes, const char* whose) {
    if (bytes > 0 && needed.bytes() > bytes) throw too_many_rows(s, needed, memory_text(bytes, whose));
  };
  check(static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)), "this machine has");
  double container = 0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> container) check(container, "this container has");
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    check(static_cast<double>(limit.rlim_cur), "ulimit -v allows");
}

}  // namespace

RowsNeeded Simulation::rows_needed(std::size_t lane) const {
  return gaitlab::rows_needed(scenarios_[lane], lanes_[lane]->recording);
}

void Simulation::set_start() {
  for (const auto& one : lanes_) {
    Lane& lane = *one;
    const std::size_t l = lane.index;
    const Scenario& s = lane.scenario;
    Sample& sample = lane.sample;
    sample.gravity = s.physics.gravity;
    place_at_start(lane);
    sample.forward_kinematics(lane.robot);
    lane.energy_at_start = energy(lane);
    sample.set_boxes(s.ground);
    if (lane.cpg != nullptr) lane.cpg->start(lane.cpg_state);
    if (lane.controller != nullptr) lane.controller->start(lane.controller_state);
    for (std::size_t j = 0; actuator_ != nullptr && j < layout_.joints; ++j) {
      lane.limit[j] = actuator_->command_limit()[j * lanes_.size() + l];
    }
    if (recorded(lane)) set_recording(lane);
  }
}

void Simulation::set_recording(Lane& lane) {
  const Scenario& s = lane.scenario;
  lane.probes = std::make_unique<Probes>(s, lane.contacts, lane.cpg.get(),
                                         actuator_ == nullptr ? "" : actuator_->command_unit(), lane.sample);
  Recording& recording = lane.recording;
  recording.trace.columns = lane.probes->columns();
  recording.rest.columns = lane.probes->rest_columns();
  recording.ticks.columns = tick_columns(layout_.joints);
  recording.poses.columns = pose_columns(layout_.joints);
  lane.ticks_per_row = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(kTickRows / s.control_period - 1e-9)));
  check_memory(s, gaitlab::rows_needed(s, recording));
  const auto reserve = [&](Trace& table, double rows) {
    try {
      table.values.reserve(static_cast<std::size_t>(rows + 3) * table.columns.size());
    } catch (const std::bad_alloc&) {
      throw too_many_rows(s, gaitlab::rows_needed(s, recording), "so much memory is not to be had");
    }
  };
  for (Trace* table : {&recording.trace, &recording.rest}) reserve(*table, s.duration / s.trace.period);
  const double ticks = s.duration / (s.control_period * static_cast<double>(lane.ticks_per_row));
  for (Trace* table : {&recording.ticks, &recording.poses})
    reserve(*table, std::min(ticks, static_cast<double>(kMostTickRows)));
  if (loads_ == Loads::left_out) return;
  lane.loads = std::make_unique<LoadMeter>(s, lane.contacts);
  recording.loads.columns = lane.loads->columns();
  reserve(recording.loads, std::min(ticks, static_cast<double>(kMostTickRows)));
}

/// No command yet: set point = angle, command 0.
void Simulation::place_at_start(Lane& lane) {
  const RobotState start = start_state(lane.scenario);
  lane.sample.state = start;  // copied, not moved: the probes read its vectors where they are
  layout_.write(lane.sample.state, lane.index, plant_state_);
  for (std::size_t j = 0; j < layout_.joints; ++j) {
    setpoint_[j * lanes_.size() + lane.index] = lane.sample.state.q[j];
    command_[j * lanes_.size() + lane.index] = 0;
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
