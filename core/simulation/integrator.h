// Explicit time integrators of the motion of a robot.
#pragma once
#include <array>
#include <vector>

#include "core/math/runge_kutta.h"
#include "core/model/kinematics.h"

namespace gaitlab {

/// Method semi_implicit: v+ = v + h a(q, v), q+ = q (+) h v+, of order 1, symplectic for conservative forces. The operator (+)
/// turns an orientation by a rotation vector. Method rk4: the classical Runge-Kutta method of order 4. It integrates the
/// orientation as a quaternion, q' = (0, omega) q / 2, which is normalised after the step. For damping of rate lambda,
/// semi_implicit is stable up to h lambda = 2 and rk4 up to 2.8; gaitlab requires h lambda <= 1. `accelerate(state, weight,
/// out)` is called once with weight 1 (semi_implicit), or four times with weights 1/6, 1/3, 1/3, 1/6 (rk4). step() allocates
/// nothing.
class ExplicitIntegrator {
 public:
  enum Method { semi_implicit, rk4 };

  /// `plays`: number of joints with play.
  ExplicitIntegrator(Method method, std::size_t joints, std::size_t plays) : method_(method) {
    a_.joints.resize(joints);
    a_.rotors.resize(plays);
    for (auto* values : {&stage_.q, &stage_.qd}) values->resize(joints);
    for (auto* values : {&stage_.rotor, &stage_.rotor_speed}) values->resize(plays);
    start_ = stage_;
    rate_ = stage_;
  }

  template <class Accelerate>
  void step(RobotState& s, double h, Accelerate&& accelerate) {
    if (method_ == semi_implicit) {
      accelerate(s, 1.0, a_);
      kick(s, a_, h);
      drift(s, h);
    } else {
      runge_kutta(s, h, accelerate);
    }
  }

  /// Advances the positions of s with the velocities of s: q+ = q (+) h v.
  static void drift(RobotState& s, double h) {
    s.position += h * s.velocity;
    s.orientation = (turn(h * s.angular_velocity) * s.orientation).normalized();
    for (std::size_t j = 0; j < s.q.size(); ++j) s.q[j] += h * s.qd[j];
    for (std::size_t k = 0; k < s.rotor.size(); ++k) s.rotor[k] += h * s.rotor_speed[k];
  }

 private:
  static void kick(RobotState& s, const Acceleration& a, double h) {
    s.velocity += h * a.linear;
    s.angular_velocity += h * a.angular;
    for (std::size_t j = 0; j < s.q.size(); ++j) s.qd[j] += h * a.joints[j];
    for (std::size_t k = 0; k < s.rotor.size(); ++k) s.rotor_speed[k] += h * a.rotors[k];
  }

  /// Derivative of an orientation: q' = (0, omega) q / 2. It is not a unit quaternion; its coefficients are to be summed.
  static Quat spin(const Vec3& omega, const Quat& q) { return Quat(0, 0.5 * omega.x(), 0.5 * omega.y(), 0.5 * omega.z()) * q; }

  /// s = start_ + h * (velocities of `at`, a). The orientation of `at` need not have unit length, because stages of RK4 do not.
  void from_start(RobotState& s, const RobotState& at, const Acceleration& a, double h) const {
    s.position = start_.position + h * at.velocity;
    s.orientation.coeffs() = start_.orientation.coeffs() + h * spin(at.angular_velocity, at.orientation).coeffs();
    s.velocity = start_.velocity + h * a.linear;
    s.angular_velocity = start_.angular_velocity + h * a.angular;
    for (std::size_t j = 0; j < s.q.size(); ++j) {
      s.q[j] = start_.q[j] + h * at.qd[j];
      s.qd[j] = start_.qd[j] + h * a.joints[j];
    }
    for (std::size_t k = 0; k < s.rotor.size(); ++k) {
      s.rotor[k] = start_.rotor[k] + h * at.rotor_speed[k];
      s.rotor_speed[k] = start_.rotor_speed[k] + h * a.rotors[k];
    }
  }

  /// rate_ += weight * derivative at `at`.
  void accumulate(const RobotState& at, const Acceleration& a, double weight) {
    rate_.position += weight * at.velocity;
    rate_.orientation.coeffs() += weight * spin(at.angular_velocity, at.orientation).coeffs();
    rate_.velocity += weight * a.linear;
    rate_.angular_velocity += weight * a.angular;
    for (std::size_t j = 0; j < at.q.size(); ++j) {
      rate_.q[j] += weight * at.qd[j];
      rate_.qd[j] += weight * a.joints[j];
    }
    for (std::size_t k = 0; k < at.rotor.size(); ++k) {
      rate_.rotor[k] += weight * at.rotor_speed[k];
      rate_.rotor_speed[k] += weight * a.rotors[k];
    }
  }

  template <class Accelerate>
  void runge_kutta(RobotState& s, double h, Accelerate&& accelerate) {
    constexpr auto kWeight = math::RungeKutta::kWeight;
    constexpr auto kReach = math::RungeKutta::kReach;
    start_ = s;
    clear(rate_);
    for (std::size_t i = 0; i < 4; ++i) {
      // The dynamics use a unit quaternion. The stage keeps its unnormalised quaternion; otherwise the method would lose its
      // order.
      const Quat raw = s.orientation;
      s.orientation.normalize();
      accelerate(s, kWeight[i], a_);
      s.orientation = raw;
      accumulate(s, a_, kWeight[i]);
      if (i == 3) break;
      from_start(stage_, s, a_, kReach[i] * h);
      std::swap(s, stage_);
    }
    s.position = start_.position + h * rate_.position;
    s.orientation.coeffs() = start_.orientation.coeffs() + h * rate_.orientation.coeffs();
    s.orientation.normalize();
    s.velocity = start_.velocity + h * rate_.velocity;
    s.angular_velocity = start_.angular_velocity + h * rate_.angular_velocity;
    for (std::size_t j = 0; j < s.q.size(); ++j) {
      s.q[j] = start_.q[j] + h * rate_.q[j];
      s.qd[j] = start_.qd[j] + h * rate_.qd[j];
    }
    for (std::size_t k = 0; k < s.rotor.size(); ++k) {
      s.rotor[k] = start_.rotor[k] + h * rate_.rotor[k];
      s.rotor_speed[k] = start_.rotor_speed[k] + h * rate_.rotor_speed[k];
    }
  }

  static void clear(RobotState& s) {
    s.position = s.velocity = s.angular_velocity = Vec3::Zero();
    s.orientation.coeffs().setZero();
    for (auto* values : {&s.q, &s.qd, &s.rotor, &s.rotor_speed}) std::fill(values->begin(), values->end(), 0.0);
  }

  Method method_;
  Acceleration a_;
  RobotState start_, stage_, rate_;
};

}  // namespace gaitlab
