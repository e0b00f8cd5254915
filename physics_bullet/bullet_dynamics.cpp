#include "physics_bullet/bullet_dynamics.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/dynamics/rotor_inertia.h"
#include "physics_bullet/multibody.h"

namespace gaitlab {

namespace {

class BulletDynamics final : public articulated::OtherDynamics {
 public:
  explicit BulletDynamics(const PlantSettings& s)
      : robot_(*s.robot),
        gravity_(s.gravity),
        base_(s.base),
        actuator_(s.actuator),
        layout_{robot_.joints.size(), 1, joints_with_play(robot_).size()},
        body_(robot_, s.base, s.contacts),
        kinematics_(robot_) {
    for (auto* values : {&state_.q, &state_.qd, &acceleration_.joints}) values->resize(layout_.joints);
  }

  void fall(In state, Out out) override {
    layout_.read(state, 0, state_);
    kinematics_.update(robot_, state_);
    body_.load(state_, kinematics_, gravity_, {}, {});
    body_.accelerate(state_, acceleration_);
    for (std::size_t i = 0; i < 3; ++i) {
      out[i] = acceleration_.linear[static_cast<Eigen::Index>(i)];
      out[3 + i] = acceleration_.angular[static_cast<Eigen::Index>(i)];
    }
    std::ranges::copy(acceleration_.joints, out.begin() + 6);
  }

  void accelerate(const RobotState& state, In torque, std::span<const BodyWrench> wrenches, Acceleration& out) override {
    kinematics_.update(robot_, state);
    body_.load(state, kinematics_, gravity_, torque, wrenches);
    body_.accelerate(state, out);
    if (!has_rotors(actuator_)) return;
    if (!rotors_) rotors_.emplace(robot_, base_, actuator_->reflected_inertia());
    rotors_->update(kinematics_);
    rotors_->add_to(out);
  }

 private:
  const Robot& robot_;
  Vec3 gravity_;
  Base base_;
  const Actuator* actuator_;
  StateLayout layout_;
  bullet::MultiBody body_;
  Kinematics kinematics_;
  std::optional<RotorInertia> rotors_;  ///< matrices of all joints, made by the first accelerate()
  RobotState state_;
  Acceleration acceleration_;
};

}  // namespace

std::unique_ptr<articulated::OtherDynamics> make_bullet_dynamics(const PlantSettings& settings) {
  return std::make_unique<BulletDynamics>(settings);
}

}  // namespace gaitlab
