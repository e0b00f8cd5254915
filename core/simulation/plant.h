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

/// Force on the robot at a contact element, world axes, N, and its penetration, m; both 0 without contact.
struct ContactSample {
  Vec3 force = Vec3::Zero();
  double fn = 0, penetration = 0;
  Vec3 point = Vec3::Zero();  ///< point of action, m, world
};

/// Motion of a box of the ground that has a mass: its centre, world axes.
struct BoxMotion {
  Vec3 position = Vec3::Zero();
  Quat orientation = Quat::Identity();
  Vec3 velocity = Vec3::Zero();
};

/// Settings of one rollout.
struct LaneSettings {
  std::shared_ptr<const Robot> robot;
  Vec3 gravity = Vec3::Zero();
  Ground ground;  ///< Kind::none: without contact
  std::vector<ContactElement> contacts;
  PenaltyContact law;
  double accuracy = 0;  ///< relative accuracy of the torques, for integrators that choose their steps
};

/// Settings from which an engine makes a plant; everything referred to outlives the plant. The base is lane 0, the only one of
/// an engine without lanes.
struct PlantSettings : LaneSettings {
  std::vector<LaneSettings> others;  ///< lanes 1 ..
  Base base = Base::floating;
  const Actuator* actuator = nullptr;        ///< joint * lanes + lane; nullptr: no motors
  std::string integrator;                    ///< one of the engine's by name; "": its default
  ContactLaw contact = ContactLaw::penalty;  ///< of another one `law` is not used
  double step = 0;                           ///< s: the longest that advance is given
};

/// Thrown by Engine::make for a robot with too many joints for the engine: the reason and the remedy.
struct TooManyJoints : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Holds only caches beside the numbers that the simulation owns and binds once, unless the contact law says otherwise
/// (ContactModel::complete_state): a snapshot is a copy of them. An engine defines the five functions without a default.
class Plant {
 public:
  virtual ~Plant() = default;
  /// The state (StateLayout) and history this plant works on from now on.
  virtual void bind(Out state, Out history) = 0;
  /// Advances by one step of h seconds under held commands (joint * lanes + lane); calls the actuator at every stage of the
  /// integrator.
  virtual void advance(In command, double h) = 0;
  [[nodiscard]] virtual StepEffort applied() const = 0;
  /// Forward dynamics by the engine's own algorithm at `state`, not the bound one: accelerations under these joint torques, N
  /// m, and wrenches on bodies. Weight and the motors' rotors act; motors, stops, passive hinges and contacts do not.
  virtual void accelerate(std::size_t lane, const RobotState& state, In torque, std::span<const BodyWrench> wrenches,
                          Acceleration& out) = 0;
  /// Forces of every contact element; of a plant with a memory, those of its last step.
  virtual void contacts(std::size_t lane, std::span<ContactSample> out) const = 0;

  /// Number of values kept from step to step beside the state, of all lanes; all 0 at the start.
  [[nodiscard]] std::size_t history() const { return history_; }
  /// The rule for the longest step at the present state under these commands. standing: the weight rests in equal parts on the
  /// robot's support (support.h), whatever the contact forces are now. Default: no rule limits the step.
  [[nodiscard]] virtual Stability stability(std::size_t /*lane*/, In /*command*/, bool /*standing*/) { return {}; }
  /// Computes contacts and centre of mass at the bound state, of all lanes at once.
  virtual void update_contacts() {}
  /// Centre of mass, world, m; none: the engine does not have it at hand.
  [[nodiscard]] virtual std::optional<Vec3> com(std::size_t /*lane*/) const { return {}; }
  /// Positions of the boxes of the ground that have a mass; the others' entries stay as they are.
  virtual void boxes(std::span<BoxMotion> /*out*/) const {}
  /// All but the torque error.
  virtual void tally(std::size_t /*lane*/, StepTally& /*out*/) const {}
  /// nullptr: the actuator evaluates its laws.
  [[nodiscard]] virtual MotorLaws* motor_laws() { return nullptr; }

 protected:
  std::size_t history_ = 0;
};

}  // namespace gaitlab
