#include "core/simulation/sample.h"

#include <algorithm>
#include <cmath>

#include "core/laws/gear_play.h"
#include "core/laws/hinge_stop.h"
#include "core/laws/passive_hinge.h"

namespace gaitlab {

Sample::Sample(const Robot& robot, std::size_t contacts_count, std::size_t cpg_states)
    : kinematics(robot),
      orientation(robot.links.size(), Quat::Identity()),
      contacts(contacts_count),
      cpg(cpg_states),
      reactions(robot) {
  for (auto* values : {&state.q, &state.qd, &setpoint, &command, &voltage, &current, &saturation, &torque, &friction,
                       &stop_torque, &passive_torque, &gear_torque, &fault, &stuck_for, &acceleration_.joints, &applied_,
                       &tally.torque_error, &tally.torque_peak}) {
    values->assign(robot.joints.size(), 0.0);
  }
  plays_ = joints_with_play(robot);
  state.rotor.assign(plays_.size(), 0.0);
  state.rotor_speed = state.rotor;
  for (auto* values : {&bus_voltage, &bus_current}) values->assign(robot.modules.size() + 1, 0.0);
  hold.assign(robot.joints.size(), NAN);
  ground_.reserve(contacts_count);
}

void Sample::forward_kinematics(const Robot& robot) {
  kinematics.update(robot, state);
  orientation[0] = state.orientation;
  for (std::size_t i = 1; i < robot.links.size(); ++i) {
    orientation[i] =
        orientation[static_cast<std::size_t>(robot.links[i].parent)] * Quat(robot.links[i].in_parent.R) * kinematics.turns[i];
  }
  sums = gaitlab::sums(robot, kinematics, gravity);
}

void Sample::compute_hinges(const Robot& robot, const std::vector<std::size_t>& passive) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    stop_torque[j] = std::isnan(hold[j]) ? HingeStop::at(state.q[j], state.qd[j], robot.joints[j].lo, robot.joints[j].hi).torque
                                         : HingeHold::torque(state.q[j], state.qd[j], hold[j], HingeHold::grip(stuck_for[j]));
  }
  for (std::size_t k = 0; k < plays_.size(); ++k) {
    const std::size_t j = plays_[k];
    const double speed = state.rotor_speed[k] - state.qd[j];
    gear_torque[j] = -law(robot.joints[j].play).at(state.rotor[k] - state.q[j], speed).torque;
  }
  for (const std::size_t j : passive) {
    PassiveHinge hinge = law(*robot.joints[j].passive);
    if (sticks) hinge.friction = 0;
    passive_torque[j] = hinge.spring(state.q[j]) + hinge.loss(state.qd[j]).torque + (sticks ? friction[j] : 0);
  }
}

double Sample::energy(const Robot& robot, const Rotors& rotors, const std::vector<std::size_t>& passive) const {
  double turning = 0;
  const auto speed = [&](std::size_t j) {
    const auto play = std::ranges::find(plays_, j);
    return play == plays_.end() ? state.qd[j] : state.rotor_speed[static_cast<std::size_t>(play - plays_.begin())];
  };
  for (std::size_t j = 0; j < robot.joints.size() && !rotors.inertia.empty(); ++j) {
    turning += rotors.inertia[j * rotors.lanes + rotors.lane] * speed(j) * speed(j) / 2;
  }
  double stored = sums.kinetic + sums.potential + turning;
  for (const std::size_t j : passive) stored += law(*robot.joints[j].passive).energy(state.q[j]);
  return stored;
}

void Sample::set_boxes(const Ground& ground) {
  // Without movable boxes, no column needs them.
  if (std::ranges::none_of(ground.boxes(), [](const Box& box) { return box.mass > 0; })) return;
  for (const Box& box : ground.boxes()) {
    Quat turned(box.R);
    if (turned.w() < 0) turned.coeffs() *= -1;
    boxes.push_back({box.center, turned});
  }
}

void Sample::place_boxes(const Plant& plant) {
  for (BoxMotion& box : boxes) before_.push_back(box.orientation);
  plant.boxes(boxes);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].orientation.dot(before_[i]) < 0) boxes[i].orientation.coeffs() *= -1;
  }
  before_.clear();
}

void Sample::compute_reactions(const std::vector<ContactElement>& elements, Plant& plant, std::size_t lane) {
  for (std::size_t j = 0; j < applied_.size(); ++j) applied_[j] = torque[j] + stop_torque[j] + passive_torque[j];
  for (const std::size_t j : plays_) applied_[j] = gear_torque[j] + stop_torque[j];
  ground_.clear();
  for (std::size_t c = 0; c < elements.size(); ++c) {
    if (contacts[c].fn > 0) ground_.push_back({elements[c].body, contacts[c].point, contacts[c].force});
  }
  plant.accelerate(lane, state, applied_, ground_, acceleration_);
  reactions.update(kinematics, acceleration_, gravity, ground_);
}

}  // namespace gaitlab
