// What a physics engine must do: advance the state of one or more rollouts (lanes) of one robot.
#pragma once
#include <memory>
#include <vector>

#include "core/dynamics/wrench.h"
#include "core/laws/contact.h"
#include "core/laws/ground.h"
#include "core/model/kinematics.h"
#include "core/plugin/actuator.h"

namespace gaitlab {

/// Where the numbers of a rollout's state are. Entry e of lane l is at e * lanes + l; SI, world axes.
struct StateLayout {
  std::size_t joints = 0, lanes = 1;
  static constexpr std::size_t kPosition = 0;          ///< origin of the base frame, 3
  static constexpr std::size_t kOrientation = 3;       ///< quaternion w x y z, base -> world
  static constexpr std::size_t kVelocity = 7;          ///< of that origin, 3
  static constexpr std::size_t kAngularVelocity = 10;  ///< 3
  static constexpr std::size_t kAngles = 13;           ///< then the joints' speeds

  [[nodiscard]] std::size_t size() const { return (kAngles + 2 * joints) * lanes; }
  [[nodiscard]] std::size_t angles() const { return kAngles * lanes; }
  [[nodiscard]] std::size_t speeds() const { return (kAngles + joints) * lanes; }

  void read(In state, std::size_t lane, RobotState& out) const;
  void write(const RobotState& in, std::size_t lane, Out state) const;
};

/// Largest rate lambda of M^-1 (B + sum J^T G J), 1/s, and what it comes from. A step h is stable for h lambda <= 1 (explicit).
struct Stability {
  double rate = 0;
  enum class Source { motor, stop, contact } source = Source::motor;
  std::size_t index = 0;  ///< joint, or contact element
};

/// World force on the robot at a contact element, N, and its penetration, m; both 0 without contact.
struct ContactSample {
  Vec3 force = Vec3::Zero();
  double fn = 0, penetration = 0;
  Vec3 point = Vec3::Zero();  ///< where the force acts, m, world
};

/// What the last step applied, for the ledger and not for the trace. Works: J that the robot gave, a lane; every stage's power
/// with the integrator's weight.
struct Applied {
  In torque;                    ///< mean motor torque, N m (joint * lanes + lane)
  In speed;                     ///< joint speeds at which the motors gave it, rad/s: where their power is to be asked
  In contact, friction, stops;  ///< work on the ground along its normal, along it, and on the hinge stops
};

/// What an engine is made from; everything outlives the plant.
struct PlantSettings {
  std::shared_ptr<const Robot> robot;
  Base base = Base::floating;
  Vec3 gravity = Vec3::Zero();
  Ground ground;  ///< Kind::none: no contact at all
  std::vector<ContactElement> contacts;
  PenaltyContact law;
  const Actuator* actuator = nullptr;  ///< nullptr: no motors
  std::size_t lanes = 1;
  int integrator = 0;  ///< index into the engine's list
};

/// Stateless but for caches: the simulation owns the numbers and binds them once; a snapshot is a copy of them.
class Plant {
 public:
  virtual ~Plant() = default;
  [[nodiscard]] virtual std::size_t lanes() const = 0;
  /// The state this plant works on from now on (StateLayout).
  virtual void bind(Out state) = 0;
  /// One step of h seconds under held commands (joint * lanes + lane), asking the actuator at every stage the integrator needs.
  virtual void advance(In command, double h) = 0;
  [[nodiscard]] virtual Applied applied() const = 0;
  /// Forward dynamics by the engine's own algorithm at `state`, not the bound one: accelerations under these joint torques, N
  /// m, and wrenches on bodies. Weight acts; motors, stops and contacts do not, but for the motors' rotors.
  virtual void accelerate(const RobotState& state, In torque, std::span<const BodyWrench> wrenches, Acceleration& out) = 0;
  /// Forces of every contact element at the present state.
  virtual void contacts(std::size_t lane, std::span<ContactSample> out) const = 0;
  /// At the present state under these commands. standing: the weight rests in equal parts on the robot's support (support.h),
  /// whatever the contact forces are now.
  [[nodiscard]] virtual Stability stability(std::size_t lane, In command, bool standing) = 0;
};

}  // namespace gaitlab
