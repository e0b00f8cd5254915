// Steps of rollouts side by side, with one implementation per width and instruction set.
#pragma once
#include <memory>
#include <span>

#include "core/simulation/motor_laws.h"
#include "physics_articulated/stepper.h"

namespace gaitlab::articulated {

/// Constants of one rollout. `ground` must outlive the kernel.
struct LaneConstants {
  Tree<double> tree;
  Vec<double> gravity;
  PenaltyContact law;
  bool plane = true;
  double friction = 0;  ///< friction coefficient of the plane
  double accuracy = 0;  ///< relative accuracy of torques
  const Ground* ground = nullptr;
};

/// Force of the ground on a contact element of one lane, world, N.
struct ContactForce {
  std::size_t element = 0;
  double fn = 0;
  Vec<double> force;
  Touch<double> touch;
};

class Kernel : public MotorLaws {
 public:
  virtual ~Kernel() = default;
  /// See Plant::advance for the step, and Plant::history for `history`.
  virtual void step(Out state, Out history, In command, double h) = 0;
  /// See Plant::state_within.
  virtual bool state_within(std::size_t lane, std::size_t eighth, Out state) const = 0;
  virtual void change(In hold, In since) = 0;  ///< see Plant::change_joints; the solos are not changed
  virtual void add_friction(In state, In command, double within, Out torque) = 0;  ///< see Plant::add_friction
  [[nodiscard]] virtual History history() const = 0;                               ///< layout of the history of one rollout
  [[nodiscard]] virtual StepEffort applied() const = 0;
  /// Computes contacts and centre of mass of all lanes at `state`, for contact_forces() and com().
  virtual void update_contacts(In state) = 0;
  /// Forces on the touching elements, in the order of the elements. The result is valid until the next call.
  virtual std::span<const ContactForce> contact_forces(std::size_t lane) = 0;
  virtual Vec<double> com(std::size_t lane) = 0;  ///< centre of mass, world, m
};

/// Input of a kernel. All rollouts have the same structure, and their number is the width of the kernel. Joints of the actuator
/// have the index joint * lanes + lane.
struct KernelSettings {
  std::span<const LaneConstants> rollouts;
  const Actuator* actuator = nullptr;
  StepMethod method = StepMethod::adaptive;
  Touch<double> (*query)(const Ground&, const Vec<double>& centre, double radius) = nullptr;
  OtherDynamics* dynamics = nullptr;  ///< for a kernel of one lane; must outlive the kernel
  std::span<const SoloOfLane> solos;  ///< one per lane or none, for a kernel of several lanes; must outlive the kernel
};

/// Environment of the rollouts, one per lane.
template <class T>
Environment<T> environment(const KernelSettings& s) {
  Environment<T> all;
  all.query = s.query;
  all.dynamics = s.dynamics;
  for (std::size_t l = 0; l < s.rollouts.size(); ++l) {
    const LaneConstants& one = s.rollouts[l];
    put(all.gravity, l, one.gravity);
    put(all.law.kn, l, one.law.kn);
    put(all.law.k, l, one.law.k);
    put(all.law.cd, l, one.law.cd);
    put(all.law.d, l, one.law.d);
    put(all.law.v_lim, l, one.law.v_lim);
    put(all.friction, l, one.friction);
    all.plane = all.plane && one.plane;
    all.ground.push_back(one.ground);
  }
  return all;
}

/// Solos of the rollouts. There are none if the motors are not DC motors, because the actuator can evaluate such motors only
/// for all lanes.
std::vector<std::unique_ptr<Solo>> make_solos(const KernelSettings&);

std::unique_ptr<Kernel> make_kernel_1(const KernelSettings&);
std::unique_ptr<Kernel> make_kernel_4(const KernelSettings&);  ///< four rollouts, with AVX2
std::unique_ptr<Kernel> make_kernel_8(const KernelSettings&);  ///< eight rollouts, with AVX-512

}  // namespace gaitlab::articulated
