// Robot whose joints have dry friction as a set-valued law, simulated in short steps of first order, written from
// docs/equations.md, 1, 2, 3 and 6. It uses neither an engine nor core/laws; masses and bias forces are those of core/dynamics.
#pragma once
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/dynamics/mass_matrix.h"
#include "core/scenario/scenario.h"
#include "core/simulation/start.h"

namespace gaitlab::oracle {

/// Motor, gear and friction of a joint. E = per_volt u - per_speed w within +-largest; the gear gives eta E while the motor
/// drives and E / eta while the joint drives it.
struct Drive {
  double per_volt = 0, per_speed = 0;    ///< N m/V, N m s/rad
  double supply = 0, largest = 0;        ///< V, N m
  double eta = 1, dry = 0, viscous = 0;  ///< 1, N m, N m s/rad
  double rotor = 0;                      ///< kg m^2 at the joint

  [[nodiscard]] double motor(double u, double w) const {
    return std::clamp(per_volt * std::clamp(u, -supply, supply) - per_speed * w, -largest, largest);
  }
  /// Least and largest torque at the speed w if the joint may turn to both sides. A joint that turns forward has the least one.
  [[nodiscard]] std::array<double, 2> bounds(double u, double w) const {
    const double E = motor(u, w);
    return {std::min(eta * E, E / eta) - dry - viscous * w, std::max(eta * E, E / eta) + dry - viscous * w};
  }
};

class StickingRobot {
 public:
  /// `h`: length of a step, s. All explicit terms (stops, contacts) are stable for h times their decay rate < 2.
  StickingRobot(const Scenario& scenario, std::vector<Drive> drives, double h)
      : scenario_(scenario),
        robot_(*scenario.robot),
        drives_(std::move(drives)),
        h_(h),
        elements_(contact_elements(robot_, scenario.contact.on)),
        state_(start_state(scenario)),
        kinematics_(robot_),
        dynamics_(robot_),
        mass_(robot_, scenario.base),
        torque_(drives_.size(), 0.0) {
    still_.joints.assign(drives_.size(), 0.0);
  }

  [[nodiscard]] const RobotState& state() const { return state_; }
  /// Torques of the last step on the joints, friction included, N m.
  [[nodiscard]] const std::vector<double>& torque() const { return torque_; }
  /// Steps of joints: at rest; with a motor at its largest torque; beyond the range. Steps of elements: in contact.
  struct Seen {
    long rest = 0, largest = 0, beyond = 0, touch = 0;
  };
  [[nodiscard]] const Seen& seen() const { return seen_; }

  /// v+ = v + h M^-1 (stops + contacts - c + T), where T of every joint is between its bounds and belongs to the speed at the
  /// end: the least for w+ > 0, the largest for w+ < 0.
  void step(const std::vector<double>& volts) {
    kinematics_.update(robot_, state_);
    mass_.update(kinematics_);
    touch();
    dynamics_.update(kinematics_, still_, scenario_.physics.gravity, forces_);
    const auto joints = static_cast<Eigen::Index>(drives_.size());
    Eigen::MatrixXd M = mass_.matrix();
    Eigen::VectorXd f = -generalised_force(dynamics_, scenario_.base);
    const Eigen::Index base = f.size() - joints;
    for (Eigen::Index j = 0; j < joints; ++j) {
      M(base + j, base + j) += drives_[static_cast<std::size_t>(j)].rotor;
      f(base + j) += stop(static_cast<std::size_t>(j));
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(M);
    Eigen::VectorXd v = speeds(base) + h_ * factor.solve(f);
    const Eigen::MatrixXd response = h_ * factor.solve(Eigen::MatrixXd::Identity(f.size(), f.size()).rightCols(joints));
    balance(volts, v.tail(joints), response.bottomRows(joints));
    v += response * Eigen::Map<const Eigen::VectorXd>(torque_.data(), joints);
    move(v, base);
  }

 private:
  /// Forces of the plane z = 0: Fn = Kn p + Cd p p' >= 0, Ft = -f Fn v / max(|v|, v_lim).
  void touch() {
    forces_.clear();
    const auto& law = scenario_.contact.penalty;
    for (const ContactElement& e : elements_) {
      const Vec3 at = kinematics_.point(e.link, e.centre) - Vec3(0, 0, e.radius);
      if (!scenario_.ground.exists() || at.z() >= 0) continue;
      const Vec3 v = kinematics_.velocity(e.link, at);
      const double fn = std::max(0.0, -law.kn * at.z() + law.cd * at.z() * v.z());
      const double slip = std::hypot(v.x(), v.y());
      const double ft = scenario_.ground.friction * fn / std::max(slip, law.v_lim);
      forces_.push_back({e.body, at, {-ft * v.x(), -ft * v.y(), fn}, Vec3::Zero()});
      ++seen_.touch;
    }
  }

  /// 50 N m/rad and 0.5 N m s/rad beyond the range, which never pull.
  double stop(std::size_t j) {
    const Joint& joint = robot_.joints[j];
    const double q = state_.q[j];
    const double over = q > joint.hi ? q - joint.hi : q < joint.lo ? q - joint.lo : 0;
    if (over == 0) return 0;
    ++seen_.beyond;
    const double torque = -50 * over - 0.5 * state_.qd[j];
    return over > 0 ? std::min(0.0, torque) : std::max(0.0, torque);
  }

  [[nodiscard]] Eigen::VectorXd speeds(Eigen::Index base) const {
    std::array<double, 6> all{};
    Vec3::Map(all.data()) = state_.velocity;
    Vec3::Map(all.data() + 3) = state_.angular_velocity;
    Eigen::VectorXd v(base + static_cast<Eigen::Index>(state_.qd.size()));
    Eigen::Index at = 0;
    for (const std::size_t entry : base_entries(scenario_.base)) v(at++) = all[entry];
    for (const double speed : state_.qd) v(at++) = speed;
    return v;
  }

  /// Finds the torques by projected Gauss-Seidel sweeps, which converge because `response` is positive definite: each joint in
  /// turn takes the torque between its bounds that brings it nearest to rest. `without`: speeds at the end without torques.
  void balance(const std::vector<double>& volts, const Eigen::VectorXd& without, const Eigen::MatrixXd& response) {
    Eigen::VectorXd w = without;
    std::vector<std::array<double, 2>> bounds;
    for (std::size_t j = 0; j < drives_.size(); ++j) {
      bounds.push_back(drives_[j].bounds(volts[j], state_.qd[j]));
      w += response.col(static_cast<Eigen::Index>(j)) * torque_[j];
      seen_.largest += std::abs(drives_[j].motor(volts[j], state_.qd[j])) == drives_[j].largest;
    }
    for (int sweep = 0; sweep < 10'000; ++sweep) {
      double changed = 0;
      for (std::size_t j = 0; j < drives_.size(); ++j) {
        const auto row = static_cast<Eigen::Index>(j);
        const double next = std::clamp(torque_[j] - w(row) / response(row, row), bounds[j][0], bounds[j][1]);
        w += response.col(row) * (next - torque_[j]);
        changed = std::max(changed, std::abs(next - torque_[j]));
        torque_[j] = next;
      }
      if (changed < 1e-9) break;  // N m; a joint at rest keeps a speed of about this times h / inertia
    }
    for (std::size_t j = 0; j < drives_.size(); ++j) seen_.rest += torque_[j] > bounds[j][0] && torque_[j] < bounds[j][1];
  }

  void move(const Eigen::VectorXd& v, Eigen::Index base) {
    std::array<double, 6> all{};
    Eigen::Index at = 0;
    for (const std::size_t entry : base_entries(scenario_.base)) all[entry] = v(at++);
    state_.velocity = Vec3::Map(all.data());
    state_.angular_velocity = Vec3::Map(all.data() + 3);
    state_.position += h_ * state_.velocity;
    state_.orientation = (turn(h_ * state_.angular_velocity) * state_.orientation).normalized();
    for (std::size_t j = 0; j < state_.qd.size(); ++j) {
      state_.qd[j] = v(base + static_cast<Eigen::Index>(j));
      state_.q[j] += h_ * state_.qd[j];
    }
  }

  const Scenario& scenario_;
  const Robot& robot_;
  std::vector<Drive> drives_;
  double h_;
  std::vector<ContactElement> elements_;
  RobotState state_;
  Kinematics kinematics_;
  InverseDynamics dynamics_;
  MassMatrix mass_;
  Acceleration still_;
  std::vector<BodyWrench> forces_;
  std::vector<double> torque_;
  Seen seen_;
};

}  // namespace gaitlab::oracle
