// What a physics engine must do: advance the state of one or more rollouts (lanes) of one robot.
#pragma once
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "core/dynamics/wrench.h"
#include "core/laws/contact.h"
#include "core/laws/ground.h"
#include "core/model/kinematics.h"
#include "core/plugin/actuator.h"
#include "core/recording/statistics.h"
#include "core/simulation/state_layout.h"

namespace gaitlab {

/// World force on the robot at a contact element, N, and its penetration, m; both 0 without contact.
struct ContactSample {
  Vec3 force = Vec3::Zero();
  double fn = 0, penetration = 0;
  Vec3 point = Vec3::Zero();  ///< where the force acts, m, world
};

/// A box of the ground that has a mass, as it moves: its middle, world axes.
struct BoxMotion {
  Vec3 position = Vec3::Zero();
  Quat orientation = Quat::Identity();
  Vec3 velocity = Vec3::Zero();
};

/// What one rollout has of its own.
struct LaneSettings {
  std::shared_ptr<const Robot> robot;
  Vec3 gravity = Vec3::Zero();
  Ground ground;  ///< Kind::none: no contact at all
  std::vector<ContactElement> contacts;
  PenaltyContact law;
  double accuracy = 0;  ///< of the torques, relative: of an integrator that chooses its steps
};

/// What an engine is made from; everything outlives the plant. The base: what lane 0 has, and all there is for an engine of
/// one.
struct PlantSettings : LaneSettings {
  std::vector<LaneSettings> others;  ///< of lanes 1 ..
  Base base = Base::floating;
  const Actuator* actuator = nullptr;  ///< joint * lanes + lane; nullptr: no motors
  std::string integrator;              ///< one of the engine's by name; "": its default
  bool solver = false;                 ///< contact.law: bullet; `law` is not used
  double step = 0;                     ///< s: the longest that advance is given
};

/// Thrown by Engine::make for a robot with too many joints for the engine: the reason and the remedy.
struct TooManyJoints : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Stateless but for caches, unless it says otherwise (state_is_complete): the simulation owns the numbers and binds them once;
/// a snapshot is a copy of them.
class Plant {
 public:
  virtual ~Plant() = default;
  [[nodiscard]] virtual std::size_t lanes() const = 0;
  /// How many numbers it keeps from step to step beside the state, of all lanes; all 0 at the start.
  [[nodiscard]] virtual std::size_t history() const { return 0; }
  /// The state (StateLayout) and history this plant works on from now on.
  virtual void bind(Out state, Out history) = 0;
  /// One step of h seconds under held commands (joint * lanes + lane), asking the actuator at every stage the integrator needs.
  virtual void advance(In command, double h) = 0;
  [[nodiscard]] virtual StepEffort applied() const = 0;
  /// All but the torque error.
  virtual void tally(std::size_t /*lane*/, StepTally& /*out*/) const {}
  /// Actuator::electrical, by an engine that evaluates the law itself; false: it does not.
  virtual bool evaluate_motors(In, In, const Actuator::Electrical&) { return false; }
  /// Whether the bound numbers are all it goes by, so that a copy of them is a snapshot and forces follow from them.
  [[nodiscard]] virtual bool state_is_complete() const { return true; }
  /// Forward dynamics by the engine's own algorithm at `state`, not the bound one: accelerations under these joint torques, N
  /// m, and wrenches on bodies. Weight acts; motors, stops, passive hinges and contacts do not, but for the motors' rotors.
  virtual void accelerate(std::size_t lane, const RobotState& state, In torque, std::span<const BodyWrench> wrenches,
                          Acceleration& out) = 0;
  /// Takes the present state for contacts and com, all lanes at once.
  virtual void update_contacts() {}
  /// Centre of mass, world, m; none: the engine does not have it at hand.
  [[nodiscard]] virtual std::optional<Vec3> com(std::size_t lane) const = 0;
  /// Forces of every contact element; of a plant with a memory, those of its last step.
  virtual void contacts(std::size_t lane, std::span<ContactSample> out) const = 0;
  /// Where the boxes of Ground::boxes that have a mass are now; the others' entries stay as they are.
  virtual void boxes(std::span<BoxMotion> /*out*/) const {}
  /// At the present state under these commands. standing: the weight rests in equal parts on the robot's support (support.h),
  /// whatever the contact forces are now.
  [[nodiscard]] virtual Stability stability(std::size_t lane, In command, bool standing) = 0;
};

}  // namespace gaitlab
