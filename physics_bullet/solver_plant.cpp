#include "physics_bullet/solver_plant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/laws/hinge_stop.h"
#include "core/laws/passive_hinge.h"
#include "core/simulation/integrator.h"
#include "physics_bullet/world.h"

namespace gaitlab {

namespace {

constexpr double kUnlimited = 1e30;  // N m; for a row without a limit
constexpr double kStill = 1e-5;      // rad/s; below this speed, dry friction is viscous
constexpr double kFast = 1e5;  // rad/s; largest joint speed of a run, at which a motor with a torque limit is at this limit

/// Plant without a rule that limits the step, because all damping is implicit.
class SolverPlant final : public Plant {
 public:
  explicit SolverPlant(const PlantSettings& s)
      : settings_(s),
        robot_(*s.robot),
        layout_{robot_.joints.size(), 1},
        body_(robot_, s.base, s.contacts),
        world_(s, body_),
        kinematics_(robot_),
        after_(robot_),
        samples_(s.contacts.size()) {
    const std::size_t n = robot_.joints.size();
    state_.q.resize(n);
    state_.qd.resize(n);
    for (auto* values : {&torque_, &slope_, &limited_, &limited_slope_, &applied_, &start_speed_}) values->resize(n);
    hold_.assign(n, NAN);
    since_.assign(n, 0.0);
    for (auto* values : {&least_, &most_, &off_, &fast_}) values->resize(n);
    find_limits();
    elements_of_body_.resize(robot_.bodies.size());
    for (std::size_t e = 0; e < s.contacts.size(); ++e) elements_of_body_[s.contacts[e].body].push_back(e);
  }

  void bind(Out numbers, Out) override { numbers_ = numbers; }

  void advance(In command, double h) override {
    layout_.read(numbers_, 0, state_);
    last_ = h;
    start_speed_ = state_.qd;
    kinematics_.update(robot_, state_);
    body_.set(state_, kinematics_);
    drive(command, h);
    world_.step(kinematics_, h);
    body_.read_velocities(state_, h);
    settle(h);
    ExplicitIntegrator::drift(state_, h);
    layout_.write(state_, 0, numbers_);
    part_.set(applied_, numbers_.subspan(layout_.speeds(), layout_.joints), numbers_.subspan(layout_.angles(), layout_.joints),
              h);
  }

  [[nodiscard]] StepEffort applied() const override { return part_.applied(work_); }

  void accelerate(std::size_t, const RobotState& state, In torque, std::span<const BodyWrench> wrenches,
                  Acceleration& out) override {
    kinematics_.update(robot_, state);
    body_.load(state, kinematics_, settings_.gravity, torque, wrenches);
    body_.accelerate(state, out);
  }

  void contacts(std::size_t, std::span<ContactSample> out) const override {
    std::copy(samples_.begin(), samples_.end(), out.begin());
  }

  /// Adds the friction of the last step, as the contact forces are those of the last step.
  bool add_friction(In, double, Out torque) override {
    for (std::size_t j = 0; last_ > 0 && j < torque.size(); ++j) torque[j] += world_.friction(j).torque(last_);
    return true;
  }

  void boxes(std::span<BoxMotion> out) const override { world_.boxes(out); }

  void change_joints(In hold, In since) override {
    std::ranges::copy(hold, hold_.begin());
    std::ranges::copy(since, since_.begin());
    find_limits();
  }

 private:
  void find_limits() {
    std::ranges::fill(least_, -kUnlimited);
    std::ranges::fill(most_, kUnlimited);
    for (const double sign : {-1.0, 1.0}) find_limits(sign, sign < 0 ? most_ : least_);
  }

  /// Fills `limit` with the torque of limited motors that are driven fast in the direction `sign`. This is the largest torque
  /// against that direction at any speed.
  void find_limits(double sign, std::vector<double>& limit) {
    if (settings_.actuator == nullptr) return;
    std::ranges::fill(fast_, sign * kFast);
    settings_.actuator->effort(off_, fast_, limited_, limited_slope_);
    settings_.actuator->unlimited(off_, fast_, torque_, slope_);
    for (std::size_t j = 0; j < limit.size(); ++j) {
      if (limited_[j] != torque_[j]) limit[j] = limited_[j];
    }
  }

  /// Sets motors and stops as rows of the solver. A torque that does not depend on speed is applied directly.
  void drive(In command, double h) {
    std::span<const JointFriction> friction;
    if (settings_.actuator != nullptr) {
      settings_.actuator->unlimited(command, state_.qd, torque_, slope_);
      settings_.actuator->effort(command, state_.qd, limited_, limited_slope_);
      friction = settings_.actuator->friction();
    }
    for (std::size_t j = 0; j < torque_.size(); ++j) {
      if (!robot_.joints[j].driven()) {
        hang(j, h);
        continue;
      }
      const bool damps = slope_[j] > 0;
      if (damps) {
        // The limit at this speed if it is active, else the limit over all speeds.
        const bool above = torque_[j] > limited_[j];
        const bool below = torque_[j] < limited_[j];
        world_.motor(j).set(slope_[j], state_.qd[j] + torque_[j] / slope_[j], below ? limited_[j] : least_[j],
                            above ? limited_[j] : most_[j]);
      } else {
        world_.motor(j).set(0, 0, 0, 0);
        body_.add_torque(j, limited_[j]);
      }
      applied_[j] = damps ? 0 : limited_[j];
      stop(j, h);
      if (!friction.empty()) rub(j, friction[j]);
    }
  }

  /// Uses a row for friction, which is linear between the speeds 0 and that at the start, and at most the friction at this
  /// speed. Dry friction stops the joint but never drives it.
  void rub(std::size_t j, const JointFriction& friction) {
    const double speed = std::abs(state_.qd[j]);
    const double most = friction.dry + friction.viscous * speed;
    world_.friction(j).set(friction.dry / kStill + friction.viscous, 0, -most, most);
  }

  /// Uses the row of the missing motor for the torque of a passive hinge at the end of the step. The torque is linearised at
  /// the initial speed.
  void hang(std::size_t j, double h) {
    const PassiveHinge hinge = law(*robot_.joints[j].passive);
    const double qd = state_.qd[j];
    const PassiveHinge::Loss loss = hinge.loss(qd);
    const double torque = hinge.spring(state_.q[j] + h * qd) + loss.torque;
    const double slope = loss.slope + h * hinge.stiffness;
    if (slope > 0) {
      world_.motor(j).set(slope, qd + torque / slope, -kUnlimited, kUnlimited);
    } else {
      // At high speed tanh is flat, and only dry friction is left. The row has the limit F, and stops the hinge but never
      // drives it.
      world_.motor(j).set(hinge.friction / hinge.friction_speed, 0, -hinge.friction, hinge.friction);
    }
    applied_[j] = 0;
    stop(j, h);
  }

  /// Sets the row of a stop: -ks (q + h qd+ - q_lim) - cs qd+, with torques that oppose the excess only, or of a stuck hinge,
  /// with torques in both directions.
  void stop(std::size_t j, double h) {
    if (!std::isnan(hold_[j])) {
      const double slope = HingeHold::kDamping + h * HingeHold::kStiffness;
      const double target = -HingeHold::kStiffness * (state_.q[j] - hold_[j]) / slope;
      world_.stop(j).set(HingeHold::grip(since_[j] + h) * slope, target, -kUnlimited, kUnlimited);
      return;
    }
    const Joint& joint = robot_.joints[j];
    const double excess = state_.q[j] - std::clamp(state_.q[j], joint.lo, joint.hi);
    const double slope = HingeStop::kDamping + h * HingeStop::kStiffness;
    world_.stop(j).set(excess == 0 ? 0 : slope, -HingeStop::kStiffness * excess / slope, excess > 0 ? -kUnlimited : 0,
                       excess > 0 ? 0 : kUnlimited);
  }

  /// Computes torques, works and contact forces after a step, from state_ with its new velocities. The work of an impulse uses
  /// the mean of the velocities before and after the impulse, which gives the change of kinetic energy.
  void settle(double h) {
    after_.update(robot_, state_);
    work_ = {};
    for (std::size_t j = 0; j < applied_.size(); ++j) {
      if (robot_.joints[j].driven()) {
        applied_[j] += world_.motor(j).torque(h) + world_.friction(j).torque(h);
      } else {
        const double spring = law(*robot_.joints[j].passive).spring(state_.q[j] + h * state_.qd[j]);
        work_[3] -= h * (world_.motor(j).torque(h) - spring) * (start_speed_[j] + state_.qd[j]) / 2;
      }
      work_[2] -= h * world_.stop(j).torque(h) * (start_speed_[j] + state_.qd[j]) / 2;
    }
    for (ContactSample& sample : samples_) sample = {};
    world_.for_each_touch([&](const bullet::WorldTouch& touch) {
      settle(touch, touch.a, 1, h);
      settle(touch, touch.b, -1, h);
    });
  }

  void settle(const bullet::WorldTouch& touch, const bullet::WorldTouch::Side& side, double sign, double h) {
    if (side.link < 0) return;
    const auto link = static_cast<std::size_t>(side.link);
    const Vec3 v = (kinematics_.velocity(link, side.point) + after_.velocity(link, side.point)) / 2;
    work_[0] -= sign * touch.push * touch.normal.dot(v);
    work_[1] -= sign * touch.friction.dot(v);
    const bool alone = touch.a.link < 0 || touch.b.link < 0;  // false if both sides are parts of the robot
    if (!alone || !(touch.push > 0)) return;
    const int element = side.element >= 0 ? side.element : nearest(side);
    if (element < 0) return;
    ContactSample& sample = samples_[static_cast<std::size_t>(element)];
    if (touch.push / h > sample.fn) sample.point = side.point;
    sample.force += sign / h * (touch.push * touch.normal + touch.friction);
    sample.fn += touch.push / h;
    sample.penetration = std::max(sample.penetration, -touch.distance);
  }

  /// Element of the body whose surface is nearest to the contact point of the outline. -1 if the body has no element.
  [[nodiscard]] int nearest(const bullet::WorldTouch::Side& side) const {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t e : elements_of_body_[static_cast<std::size_t>(side.body)]) {
      const ContactElement& element = settings_.contacts[e];
      const Vec3 centre = kinematics_.point(element.link, element.centre);
      const double distance = std::abs((side.point - centre).norm() - element.radius);
      if (distance >= least) continue;
      least = distance;
      best = static_cast<int>(e);
    }
    return best;
  }

  PlantSettings settings_;
  const Robot& robot_;
  StateLayout layout_;
  Out numbers_;
  bullet::MultiBody body_;
  bullet::BulletWorld world_;
  Kinematics kinematics_, after_;
  RobotState state_;
  std::vector<double> torque_, slope_, limited_, limited_slope_, applied_, start_speed_, least_, most_;
  std::vector<double> hold_;        ///< angles of stuck hinges, rad; NaN for the others
  std::vector<double> since_;       ///< time that each has been stuck, s
  std::vector<double> off_, fast_;  ///< zero commands, and the speeds at which find_limits() evaluates the motors
  std::vector<ContactSample> samples_;
  std::vector<std::vector<std::size_t>> elements_of_body_;
  std::array<double, 4> work_ = {};  ///< works of the last step, J: contact, friction, stops, hinges
  OnePart part_;
  double last_ = 0;  ///< s, last step; 0 before the first
};

}  // namespace

std::unique_ptr<Plant> make_solver_plant(const PlantSettings& settings) { return std::make_unique<SolverPlant>(settings); }

}  // namespace gaitlab
