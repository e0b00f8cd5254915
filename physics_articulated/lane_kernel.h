// Kernel for a scalar type T, included by one source file per width, which is compiled for a processor with that width.
#pragma once
#include <algorithm>

#include "physics_articulated/kernel.h"

namespace gaitlab::articulated {

template <class T>
class LaneKernel final : public Kernel {
 public:
  explicit LaneKernel(const KernelSettings& s)
      : tree_(trees(s.rollouts)),
        environment_(environment<T>(s)),
        stepper_(tree_, environment_, s.actuator, s.method, accuracy(s), s.solos),
        x_(StateLayout::kAngles + 2 * (tree_.lo.size() + tree_.plays.size())) {
    contact_forces_.reserve(tree_.points.size());
    parts_.reserve(stepper_.most_parts());
    forces_.reserve(tree_.points.size());
  }

  void step(Out state, Out history, In command, double h) override {
    load(state);
    const Out own = math::numbers(stepper_.history());
    std::ranges::copy(history, own.begin());
    stepper_.step(x_, command, h);
    std::ranges::copy(math::numbers(std::span<const T>(x_)), state.begin());
    std::ranges::copy(own, history.begin());
  }
  bool state_within(std::size_t lane, std::size_t eighth, Out state) const override {
    return stepper_.eighths().state(lane, eighth, state);
  }
  void change(In hold, In since) override { stepper_.implicit.change(hold, since, {0, math::kLanes<T>}); }
  void add_friction(In state, In command, double within, Out torque) override {
    load(state);
    stepper_.implicit.stops.holds.at(within);
    stepper_.implicit.add_friction(x_, command, torque);
  }
  [[nodiscard]] History history() const override { return stepper_.layout; }

  [[nodiscard]] StepEffort applied() const override {
    parts_.clear();
    for (const StepPart<T>& part : stepper_.parts()) {
      if (part.h > 0 && !part.weighed()) continue;
      parts_.push_back(
          {numbers(part.torque), numbers(part.speed), numbers(part.angle), of(part.sum), of(part.share), !(part.h > 0)});
    }
    return {parts_, of(stepper_.contact), of(stepper_.friction), of(stepper_.stops), of(stepper_.hinges)};
  }

  bool evaluate_motors(In command, In speed, const Actuator::Electrical& out) override {
    return stepper_.implicit.motors.evaluate(command, speed, out);
  }

  bool evaluate_available(In speed, In torque, Out available) override {
    return stepper_.implicit.motors.available(speed, torque, available);
  }

  void update_contacts(In state) override {
    load(state);
    stepper_.implicit.body.forward_kinematics(x_);
    stepper_.implicit.contacts.find(stepper_.implicit.body, 0, 0);
    stepper_.implicit.contacts.begin(0);
    forces_.clear();
    for (const Contact<T>& c : stepper_.implicit.contacts.touching()) forces_.push_back(c.force());
    com_ = stepper_.implicit.body.com();
  }

  std::span<const ContactForce> contact_forces(std::size_t lane) override {
    contact_forces_.clear();
    const auto& touching = stepper_.implicit.contacts.touching();
    for (std::size_t i = 0; i < forces_.size(); ++i) {
      const Contact<T>& c = touching[i];
      const double penetration = math::lane(c.touch.penetration, lane);
      if (!(penetration > 0)) continue;
      contact_forces_.push_back(
          {c.element,
           math::lane(c.law.fn, lane),
           of_lane(forces_[i], lane),
           {penetration, of_lane(c.n, lane), of_lane(c.touch.point, lane), math::lane(c.touch.friction, lane)}});
    }
    return contact_forces_;
  }
  Vec<double> com(std::size_t lane) override { return of_lane(com_, lane); }

 private:
  static In numbers(const std::vector<T>& values) { return math::numbers(std::span<const T>(values)); }
  static In of(const T& value) { return math::numbers(std::span<const T>(&value, 1)); }
  static T accuracy(const KernelSettings& s) {
    T all = 0.0;
    for (std::size_t l = 0; l < s.rollouts.size(); ++l) put(all, l, s.rollouts[l].accuracy);
    return all;
  }
  static Tree<T> trees(std::span<const LaneConstants> rollouts) {
    std::vector<const Tree<double>*> each;
    for (const LaneConstants& one : rollouts) each.push_back(&one.tree);
    return side_by_side<T>(each);
  }
  static Vec<double> of_lane(const Vec<T>& v, std::size_t lane) {
    return {math::lane(v.x, lane), math::lane(v.y, lane), math::lane(v.z, lane)};
  }
  void load(In state) { std::ranges::copy(state, math::numbers(std::span<T>(x_)).begin()); }

  Tree<T> tree_;
  Environment<T> environment_;
  Stepper<T> stepper_;
  std::vector<T> x_;
  std::vector<Vec<T>> forces_;  // contact forces that update_contacts() computed
  std::vector<ContactForce> contact_forces_;
  mutable std::vector<StepEffort::Part> parts_;
  Vec<T> com_;
};

}  // namespace gaitlab::articulated
