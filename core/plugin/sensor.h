// Interface for sensors, which compute measured values from true quantities of the robot. Standard library only.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/plugin/registry.h"

namespace gaitlab {

/// A point of a body whose motion a sensor measures.
struct BodyPoint {
  std::size_t body = 0;                 ///< index in RobotInfo::bodies
  std::array<double, 3> position = {};  ///< m, body axes, from the origin of the body's frame
};

/// Motion of a BodyPoint.
struct BodyMotion {
  std::array<double, 9> rotation = {};          ///< body axes -> world axes, row by row
  std::array<double, 3> angular_velocity = {};  ///< rad/s, world axes
  std::array<double, 3> velocity = {};          ///< velocity of the point, m/s, world axes
  std::array<double, 3> gravity = {};           ///< m/s^2, world axes
};

/// True quantities of the robot at a control tick, before the commands that begin at the tick.
struct Truth {
  std::int64_t tick = 0;               ///< number of the control tick, from 0
  In angle, speed, torque, current;    ///< by joint: rad, rad/s, N m, A; `current` only if a sensor needs it
  In module_load, body_load;           ///< by module and by body: sum of the normal forces of the contact elements, N
  In load;                             ///< by joint: the same for the link that the joint moves
  std::span<const BodyMotion> motion;  ///< one per entry of Sensor::points()
};

/// Value in Measured that a reading replaces. A reading that replaces nothing is an entry of Measured::channels.
enum class Replaces { nothing, angle, speed, torque, touching, load };

/// Description of a number that a sensor measures.
struct SensorReading {
  std::string name;                      ///< SENSOR.PART, such as `imu.gyro_x`
  std::string column, unit, definition;  ///< its column in the trace
  Replaces replaces = Replaces::nothing;
  std::size_t part = 0;  ///< joint or module whose value it replaces
};

/// A stream of random numbers of a sensor. Streams with the same hash are equal.
struct SensorStream {
  std::string name;
  std::uint32_t hash = 0;
};

/// A sensor. It has no memory: the caller owns its state. No member allocates after construction.
class Sensor {
 public:
  virtual ~Sensor() = default;
  [[nodiscard]] virtual const std::vector<SensorReading>& readings() const = 0;
  [[nodiscard]] virtual std::vector<SensorStream> streams() const = 0;
  /// Points whose motion is needed.
  [[nodiscard]] virtual std::span<const BodyPoint> points() const { return {}; }
  [[nodiscard]] virtual bool needs_current() const { return false; }
  /// True if values are multiples of a resolution. Such steps in a control loop amplify differences in the last bit of a
  /// number.
  [[nodiscard]] virtual bool quantises() const { return false; }
  /// True if values depend on the seed.
  [[nodiscard]] virtual bool draws() const { return false; }
  /// True if the values come from an operator, so that a caller that steps the simulation may give others.
  [[nodiscard]] virtual bool is_steering() const { return false; }
  /// Number of values that the sensor keeps from tick to tick.
  [[nodiscard]] virtual std::size_t states() const = 0;
  /// Computes the values, one per reading. Called at every control tick in order. The state is still meaningless at tick 0.
  virtual void sense(const Truth& truth, Out state, Out values) const = 0;
};

/// Robot, name, seed and control period of a new sensor.
struct SensorSite {
  const RobotInfo& robot;
  std::string name;        ///< name of the sensor in the scenario
  std::uint64_t seed = 0;  ///< seed of the scenario
  double period = 0;       ///< control period, s
};

/// Registers T, which has `struct Settings` and a constructor T(const SensorSite&, const Settings&).
template <class T>
void add_sensor(Registry& registry, std::string_view name, std::string_view manual) {
  using S = typename T::Settings;
  Entry entry{Kind::sensor,
              name,
              manual,
              [](const Entry&) { return std::shared_ptr<void>(std::make_shared<S>()); },
              [](void* settings, Fields& f) { static_cast<S*>(settings)->fields(f); },
              nullptr};
  entry.make_sensor = [](const SensorSite& site, const void* settings) -> Sensor* {
    return new T(site, *static_cast<const S*>(settings));
  };
  registry.add(entry);
}

}  // namespace gaitlab
