// Limit that a motor has reached, with its name and its number in traces.
#pragma once
#include "core/names.h"

namespace gaitlab {

enum class MotorLimit { none, voltage, current };

template <>
struct EnumNames<MotorLimit> {
  using enum MotorLimit;
  static constexpr EnumName<MotorLimit> kTable[] = {{none, "none"}, {voltage, "voltage"}, {current, "current"}};
};

/// Number of a limit in the columns `saturation` of traces, in Recording::ticks and in Actuator::Electrical.
constexpr double saturation_of(MotorLimit limit) { return static_cast<double>(limit); }
constexpr MotorLimit motor_limit(double saturation) {
  return saturation == saturation_of(MotorLimit::current)   ? MotorLimit::current
         : saturation == saturation_of(MotorLimit::voltage) ? MotorLimit::voltage
                                                            : MotorLimit::none;
}

}  // namespace gaitlab
