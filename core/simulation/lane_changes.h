// Changes of one lane over time: CPG and controller of each segment, and faults of joints.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "core/math/philox.h"
#include "core/plugin/controller.h"
#include "core/plugin/cpg.h"
#include "core/plugin/robot_info.h"
#include "core/scenario/scenario.h"

namespace gaitlab {

/// Fault of one joint.
struct FaultInForce {
  FaultKind kind = FaultKind::none;
  double share = 0;        ///< share of the torque of a weak motor, or of set points that are lost
  std::int64_t delay = 0;  ///< delay of late set points, in control ticks
  bool operator==(const FaultInForce&) const = default;
};

/// CPG, controller and faults of a lane by segment. Segment k begins with the k-th entry of `at`, at the first control tick at
/// or after its time; segment 0 is the start. All numbers that change are in the array that bind() sets: the present segment,
/// the angles of stuck joints and the ticks at which they jammed, and the set points of the last ticks. Only the constructor
/// allocates.
class LaneChanges {
 public:
  LaneChanges(const Scenario& scenario, const RobotInfo& robot);

  [[nodiscard]] std::size_t states() const;
  void bind(Out numbers) { numbers_ = numbers; }
  /// Begins the segment of a control tick. A joint that becomes stuck is held at its entry of `angle`, rad.
  void begin(std::int64_t tick, In angle);

  [[nodiscard]] std::size_t segment() const { return numbers_.empty() ? 0 : static_cast<std::size_t>(numbers_[0]); }
  /// CPG and controller of the present segment; nullptr if the scenario has none.
  [[nodiscard]] Cpg* cpg() const { return segments_[segment()].cpg.get(); }
  [[nodiscard]] Controller* controller() const { return controller(segment()); }
  [[nodiscard]] Controller* controller(std::size_t segment) const { return segments_[segment].controller.get(); }
  [[nodiscard]] std::size_t segments() const { return segments_.size(); }
  [[nodiscard]] const FaultInForce& fault(std::size_t joint) const { return segments_[segment()].faults[joint]; }
  /// Angle of a stuck joint, rad; NaN for a joint that is not stuck.
  [[nodiscard]] double hold(std::size_t joint) const;
  /// Time that a joint has been stuck at time t, s, at most HingeHold::kRamp; 0 for a joint that is not stuck.
  [[nodiscard]] double stuck_for(std::size_t joint, double t) const;
  /// True if a fault of the scenario changes motors or hinges.
  [[nodiscard]] bool change_joints() const { return change_joints_; }

  /// Replaces the set points of a tick by the set points that reach the controllers. `before` contains the set points of the
  /// previous tick, with the index joint * lanes + lane.
  void lose(std::int64_t tick, In before, std::size_t lane, Out setpoint);
  /// Sets the commands of dead motors to 0.
  void cut(Out command) const;

 private:
  struct Segment {
    std::int64_t tick = 0;
    std::unique_ptr<Cpg> cpg;
    std::unique_ptr<Controller> controller;
    std::vector<FaultInForce> faults;  ///< by joint
  };
  void add(const Change& change, const Scenario& scenario, const RobotInfo& robot);
  [[nodiscard]] Out held() const { return numbers_.subspan(1, stuck_ ? joints_ : 0); }
  [[nodiscard]] Out jammed() const { return numbers_.subspan(1 + (stuck_ ? joints_ : 0), stuck_ ? joints_ : 0); }
  [[nodiscard]] Out ring() const { return numbers_.subspan(1 + (stuck_ ? 2 * joints_ : 0)); }

  std::size_t joints_;
  double period_;  ///< control period, s
  std::vector<Segment> segments_;
  bool stuck_ = false, change_joints_ = false;
  std::int64_t longest_ = 0;                 ///< longest delay of set points, in control ticks; 0 without a ring
  std::vector<math::PhiloxStream> streams_;  ///< by joint; empty if no set points are lost
  Out numbers_;
};

/// Joints that are stuck at some time of a scenario, ascending.
std::vector<std::size_t> stuck_joints(const Scenario& scenario);

}  // namespace gaitlab
