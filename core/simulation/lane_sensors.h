// Sensors of one lane, with the true quantities that they need.
#pragma once
#include <memory>
#include <vector>

#include "core/model/kinematics.h"
#include "core/plugin/sensor.h"
#include "core/scenario/scenario.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// Values for plugins that sensors replace, in the order of Measured.
struct MeasuredValues {
  Out angle, speed, torque, touching, channels, load;
};

/// The sensors of a scenario. Their states and values are in the array of the simulation. Only the constructor allocates.
class LaneSensors {
 public:
  explicit LaneSensors(const Scenario& scenario);

  [[nodiscard]] bool empty() const { return sensors_.empty(); }
  [[nodiscard]] bool need_current() const { return need_current_; }
  [[nodiscard]] bool need_motion() const { return !points_.empty(); }
  /// Number of values that change: first states, then readings.
  [[nodiscard]] std::size_t states() const { return states_ + readings_.size(); }
  void bind(Out numbers);
  /// Number of readings that are entries of Measured::channels.
  [[nodiscard]] std::size_t channels() const { return channels_; }
  [[nodiscard]] std::size_t readings() const { return readings_.size(); }
  /// Channels whose values come from an operator.
  [[nodiscard]] const std::vector<std::size_t>& steering() const { return steering_; }
  [[nodiscard]] In values() const { return values_; }

  /// True numbers that the caller fills before sense(): currents of the joints, A, and the state of the robot if need_motion().
  Out current() { return current_; }
  RobotState& robot_state() { return state_; }

  /// Computes the readings at a control tick, and replaces values. On entry `measured` has the true values.
  void sense(std::int64_t tick, const std::vector<ContactElement>& elements, std::span<const ContactSample> contacts,
             const MeasuredValues& measured);

 private:
  void sum_loads(const std::vector<ContactElement>& elements, std::span<const ContactSample> contacts);
  void compute_motion();

  const Robot& robot_;
  Vec3 gravity_;
  std::vector<std::unique_ptr<Sensor>> sensors_;
  std::vector<SensorReading> readings_;
  std::vector<BodyPoint> points_;
  std::vector<std::size_t> steering_;
  std::size_t states_ = 0, channels_ = 0;
  bool need_current_ = false;
  Out state_numbers_, values_;  ///< parts of the state of the simulation
  std::vector<double> current_, module_load_, body_load_;
  RobotState state_;
  Kinematics kinematics_;
  std::vector<BodyMotion> motion_;  ///< index as in points_
};

}  // namespace gaitlab
