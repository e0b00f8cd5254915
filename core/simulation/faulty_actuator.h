// Actuator whose motors may be weak or without a closed circuit, for all code that uses motor laws.
#pragma once
#include <memory>
#include <vector>

#include "core/laws/dc_motor.h"
#include "core/plugin/actuator.h"

namespace gaitlab {

/// Applies faults to the motors of another actuator:
///     weak    torque and slope times a share; current unchanged, and electrical power while the motor drives; the gear loses
///             the remaining power
///     open    no torque, slope, current and power, and voltage 0
/// The friction of the joint remains.
/// The results for a motor without a fault have the same bits as from the other actuator. If that actuator has DC motors, this
/// one has DC motors with other constants (weak: Kt and the slope at rest times the share; open: Kt = Ks = 0), so that engines
/// evaluate one law. Only the constructor allocates.
class FaultyActuator final : public Actuator {
 public:
  struct Fault {
    bool open = false;
    double share = 1;  ///< share of the torque that is left
    bool operator==(const Fault&) const = default;
  };

  /// `size` is the number of joints times the number of lanes.
  FaultyActuator(std::unique_ptr<Actuator> whole, std::size_t size);
  /// Sets the fault of the motor with the index joint * lanes + lane. Returns false if it has that fault already.
  bool set(std::size_t motor, const Fault& fault);

  [[nodiscard]] std::string_view command_unit() const override { return whole_->command_unit(); }
  [[nodiscard]] In command_limit() const override { return whole_->command_limit(); }
  [[nodiscard]] In reflected_inertia() const override { return whole_->reflected_inertia(); }
  void effort(In command, In speed, Out torque, Out slope) const override;
  void unlimited(In command, In speed, Out torque, Out slope) const override;
  void electrical(In command, In speed, Electrical out) const override;
  [[nodiscard]] std::span<const JointFriction> friction() const override { return whole_->friction(); }
  [[nodiscard]] std::span<const DriveRatings> ratings() const override { return whole_->ratings(); }
  [[nodiscard]] const DcMotor* dc_motors() const override { return motors_.empty() ? nullptr : motors_.data(); }

 private:
  void scale(Out torque, Out slope) const;

  std::unique_ptr<Actuator> whole_;
  std::vector<Fault> faults_;
  std::vector<DcMotor> motors_;  ///< with faults; empty if the actuator has no DC motors
};

}  // namespace gaitlab
