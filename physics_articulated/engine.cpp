#include "physics_articulated/engine.h"

#include <memory>

#include "core/simulation/stability.h"
#include "physics_articulated/stepper.h"

namespace gaitlab {

namespace {

using articulated::Contact;
using articulated::vec;
using articulated::vec3;

constexpr int kMonitorIterations = 20;  // the rate is right to second order in the vector's error: 20 give 1 % and better
constexpr int kStartIterations = 200;   // once, before the run

class ArticulatedPlant final : public Plant, private InverseMass {
 public:
  explicit ArticulatedPlant(const PlantSettings& s)
      : settings_(s),
        robot_(*s.robot),
        layout_{robot_.joints.size(), 1},
        tree_(robot_, s.base, s.contacts),
        stepper_(tree_, s),
        x_(layout_.size()),
        a_(6 + layout_.joints),
        torque_(layout_.joints),
        slope_(layout_.joints),
        at_rest_(layout_.joints),
        zero_(layout_.joints),
        state_{.q = zero_, .qd = zero_},
        kinematics_(robot_),
        monitor_(robot_) {
    monitor_.contacts.reserve(s.contacts.size());
  }

  [[nodiscard]] std::size_t lanes() const override { return 1; }
  void bind(Out numbers) override { numbers_ = numbers; }
  void advance(In command, double h) override { stepper_.step(numbers_, command, h); }

  [[nodiscard]] Applied applied() const override {
    const auto& done = stepper_.done;
    return {done.torque, done.speed, {&done.contact, 1}, {&done.friction, 1}, {&done.stops, 1}};
  }

  void accelerate(const RobotState& state, In torque, std::span<const BodyWrench> wrenches, Acceleration& out) override {
    layout_.write(state, 0, x_);
    stepper_.body.place(x_);
    for (const BodyWrench& w : wrenches) {
      const std::size_t link = robot_.bodies[w.body].link;
      stepper_.body.add_force(link, vec(w.point - state.position), vec(w.force));
      stepper_.body.add_moment(link, vec(w.torque));
    }
    stepper_.body.solve(torque, stepper_.rotor, a_);
    out.linear = Vec3(a_[0], a_[1], a_[2]);
    out.angular = Vec3(a_[3], a_[4], a_[5]);
    std::copy(a_.begin() + 6, a_.end(), out.joints.begin());
  }

  void contacts(std::size_t, std::span<ContactSample> out) const override {
    std::copy(numbers_.begin(), numbers_.end(), x_.begin());
    stepper_.body.place(x_);
    stepper_.contacts.find(stepper_.body, 0);
    for (ContactSample& sample : out) sample = {};
    for (const Contact<double>& c : stepper_.contacts.touching()) {
      out[c.element] = {vec3(c.force()), c.law.fn, c.touch.penetration, c.touch.point};
    }
  }

  /// The rule is that of the explicit method; what damps acts implicitly in the others, and limits no step.
  [[nodiscard]] Stability stability(std::size_t, In command, bool standing) override {
    if (settings_.integrator != articulated::Stepper<double>::rk4) return {};
    layout_.read(numbers_, 0, state_);
    kinematics_.update(robot_, state_);
    stepper_.body.place(numbers_);
    stepper_.contacts.find(stepper_.body, 0);
    stepper_.body.solve(zero_, stepper_.rotor, a_);  // factorises the mass matrix for apply
    // A robot that stands does not turn its motors: at speed they may be saturated, and their slope 0.
    const In speed = standing ? In(at_rest_) : In(state_.qd);
    if (settings_.actuator != nullptr) settings_.actuator->effort(standing ? In(at_rest_) : command, speed, torque_, slope_);
    for (std::size_t j = 0; j < layout_.joints; ++j) {
      monitor_.motor[j] = slope_[j];
      monitor_.stop[j] = HingeStop::at(state_.q[j], state_.qd[j], tree_.lo[j], tree_.hi[j]).damping;
    }
    monitor_.contacts.clear();
    if (standing && settings_.base != Base::fixed) {
      stand(settings_, kinematics_, monitor_.contacts);
    } else {
      for (const Contact<double>& c : stepper_.contacts.touching()) {
        monitor_.contacts.push_back({c.element, c.link, c.touch.point, c.touch.normal, vec3(c.along), c.gt, c.gn});
      }
    }
    return monitor_.largest(robot_, kinematics_, *this, standing ? kStartIterations : kMonitorIterations);
  }

 private:
  void apply(In force, Out acceleration) override { stepper_.body.respond(force, acceleration); }

  PlantSettings settings_;
  const Robot& robot_;
  StateLayout layout_;
  Out numbers_;
  articulated::Tree tree_;
  mutable articulated::Stepper<double> stepper_;  // caches: every entry point fills them anew from the state
  mutable std::vector<double> x_;
  std::vector<double> a_, torque_, slope_, at_rest_, zero_;
  RobotState state_;
  Kinematics kinematics_;
  RateMonitor monitor_;
};

}  // namespace

void register_articulated(Catalog& catalog) {
  catalog.add(Engine{
      "articulated",
      "Our own articulated-body recursion, linearly implicit in motors, stops and contacts: long steps, no Bullet.\n\n"
      "    (M + h B + h sum J^T G J) v' = tau + sum J^T f + weight - c        v+ = v + h v'\n\n"
      "B: slopes of motors and stops; G: slopes of normal force and friction at each contact. implicit has order 1 and no\n"
      "limit on the step but the accuracy asked for; extrapolated (two half steps and a whole one) has order 2 and costs "
      "three\n"
      "times as much; rk4 is explicit, and its step must be at most 1 / lambda (docs/equations.md, 7).",
      {"implicit", "extrapolated", "rk4"},
      5e-4,
      1,
      true,
      [](const PlantSettings& s) -> std::unique_ptr<Plant> { return std::make_unique<ArticulatedPlant>(s); }});
}

}  // namespace gaitlab
