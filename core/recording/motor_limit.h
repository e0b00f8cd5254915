// The limit at which a motor is, with its name and its number in traces.
#pragma once
#include "core/names.h"

namespace gaitlab {

enum class MotorLimit { none, voltage, current };

template <>
struct EnumNames<MotorLimit> {
  using enum MotorLimit;
  static constexpr EnumName<MotorLimit> kTable[] = {{none, "none"}, {voltage, "voltage"}, {current, "current"}};
};

/// Number of a limit in `saturation`: of traces, of Recording::ticks and of Actuator::Electrical.
constexpr double saturation_of(MotorLimit limit) { return static_cast<double>(limit); }
constexpr MotorLimit motor_limit(double saturation) {
  return saturation == saturation_of(MotorLimit::current)   ? MotorLimit::current
         : saturation == saturation_of(MotorLimit::voltage) ? MotorLimit::voltage
                                                            : MotorLimit::none;
}

}  // namespace gaitlab
