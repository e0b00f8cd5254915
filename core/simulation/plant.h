// Interface of a physics engine: advances the state of one or more rollouts (lanes) of one robot.
#pragma once
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "core/dynamics/wrench.h"
#include "core/laws/contact.h"
#include "core/laws/contact_model.h"
#include "core/laws/ground.h"
#include "core/model/kinematics.h"
#include "core/recording/statistics.h"
#include "core/simulation/motor_laws.h"
#include "core/simulation/state_layout.h"

namespace gaitlab {

/// Force on the robot at a contact element, world axes, N, and the penetration of the element, m. Force and penetration are 0
/// without contact.
struct ContactSample {
  Vec3 force = Vec3::Zero();
  double fn = 0, penetration = 0;
  Vec3 point = Vec3::Zero();  ///< point of action, m, world
};

/// Motion of a box of the ground that has a mass. Position (m) and velocity (m/s) refer to the centre, world axes.
struct BoxMotion {
  Vec3 position = Vec3::Zero();
  Quat orientation = Quat::Identity();
  Vec3 velocity = Vec3::Zero();
};

/// Settings of one rollout.
struct LaneSettings {
  std::shared_ptr<const Robot> robot;
  Vec3 gravity = Vec3::Zero();
  Ground ground;  ///< NoGround without contacts
  std::vector<ContactElement> contacts;
  PenaltyContact law;
  double accuracy = 0;                  ///< relative accuracy of the torques, for integrators that choose their steps
  std::vector<std::size_t> stuck = {};  ///< joints that may get stuck during the run, for the stability check at the start
};

/// Settings from which an engine makes a plant. All referenced objects must outlive the plant. The base class contains the
/// settings of lane 0, the only lane of some engines.
struct PlantSettings : LaneSettings {
  std::vector<LaneSettings> others;  ///< lanes 1 ..
  Base base = Base::floating;
  const Actuator* actuator = nullptr;        ///< index joint * lanes + lane; nullptr without motors
  std::string integrator;                    ///< name of an integrator of the engine; "" is the default
  ContactLaw contact = ContactLaw::penalty;  ///< for any law except penalty, `law` is not used
  double step = 0;                           ///< longest step of advance(), s
};

/// Thrown by Engine::make for a robot with too many joints for the engine. The message contains the reason and the remedy.
struct TooManyJoints : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Advances a state that the simulation owns. The plant itself contains only caches, so that a copy of state and history is a
/// snapshot, unless ContactModel::complete_state is false. An engine implements at least the pure virtual functions.
class Plant {
 public:
  virtual ~Plant() = default;
  /// Sets the arrays of state (StateLayout) and history that the plant changes from now on.
  virtual void bind(Out state, Out history) = 0;
  /// Advances by one step of h seconds under constant commands (index joint * lanes + lane). Calls the actuator at every stage
  /// of the integrator.
  virtual void advance(In command, double h) = 0;
  [[nodiscard]] virtual StepEffort applied() const = 0;
  /// Computes accelerations by the forward dynamics of the engine at `state`, which need not be the state of bind(). Joint
  /// torques (N m), wrenches on bodies, weight and rotor inertia act; motors, stops, passive hinges and contacts do not.
  virtual void accelerate(std::size_t lane, const RobotState& state, In torque, std::span<const BodyWrench> wrenches,
                          Acceleration& out) = 0;
  /// Forces of all contact elements. If ContactModel::complete_state is false, these are the forces of the last step.
  virtual void contacts(std::size_t lane, std::span<ContactSample> out) const = 0;

  /// Number of values that the plant keeps from step to step in addition to the state, for all lanes. All are 0 at the start.
  [[nodiscard]] std::size_t history() const { return history_; }
  /// Largest damping rate at the present state under these commands, which limits the step. If `standing`, the weight rests in
  /// equal parts on the support of the robot (support.h) instead of on the present contacts. Nothing limits the step by
  /// default.
  [[nodiscard]] virtual Stability stability(std::size_t /*lane*/, In /*command*/, bool /*standing*/) { return {}; }
  /// Computes contacts and centre of mass of all lanes at the state of bind().
  virtual void update_contacts() {}
  /// Centre of mass, m, world; nothing if the engine does not compute it.
  [[nodiscard]] virtual std::optional<Vec3> com(std::size_t /*lane*/) const { return {}; }
  /// Writes the motion of the ground boxes that have a mass. Entries of other boxes stay unchanged.
  virtual void boxes(std::span<BoxMotion> /*out*/) const {}
  /// Writes the state of a lane at `eighth` (1 to 7) eighths of the last step into the lane's entries in `state`, which has
  /// entries of all lanes. Returns false and writes nothing unless the integrator divided the step at this time.
  virtual bool state_within(std::size_t /*lane*/, std::size_t /*eighth*/, Out /*state*/) const { return false; }
  /// Writes all members of `out` except the estimate of the torque error.
  virtual void tally(std::size_t /*lane*/, StepTally& /*out*/) const {}
  /// Applies new motor constants of the actuator and new stuck hinges. Called between steps. `hold` contains the angles of
  /// stuck hinges, rad, and NaN for all others. `since` contains the time that each has been stuck, s, at most
  /// HingeHold::kRamp, after which the hold no longer grows. Index joint * lanes + lane. Throws std::logic_error by default.
  virtual void change_joints(In /*hold*/, In /*since*/) {
    throw std::logic_error("this engine cannot simulate faults of motors and hinges");
  }
  /// Adds the friction of driven joints at the present state to their motor torques under these commands. A joint at rest has
  /// the torque that holds it there, as far as friction and gear can. Returns false and adds nothing if the integrator is
  /// explicit, with the law CreepingFriction.
  /// `within`: time since the last change_joints(), s.
  virtual bool add_friction(In /*command*/, double /*within*/, Out /*torque*/) { return false; }
  /// True if add_friction() also adds the dry friction of passive hinges, which is then set-valued.
  [[nodiscard]] virtual bool holds_hinges() const { return false; }
  /// nullptr if the actuator evaluates its laws itself.
  [[nodiscard]] virtual MotorLaws* motor_laws() { return nullptr; }

 protected:
  std::size_t history_ = 0;
};

}  // namespace gaitlab
