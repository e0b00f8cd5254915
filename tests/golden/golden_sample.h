// Shared by the tests of goldens: a run, and what a refusal says.
#pragma once
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "core/errors.h"
#include "core/recording/trace.h"

namespace gaitlab::test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

inline constexpr double kSpacing = 0.02;  // s

/// A torque, a smaller one, an angle, a height that stands still.
inline Trace walk(std::size_t rows = 101, double amplitude = 1.3) {
  Trace trace;
  trace.columns = {{"t", "s", {}},
                   {"joint.0.torque", "N m", {}},
                   {"joint.1.torque", "N m", {}},
                   {"joint.0.angle", "rad", {}},
                   {"base.z", "m", {}}};
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = static_cast<double>(k) * kSpacing;
    const double phase = 2 * std::numbers::pi * t;
    for (const double x : {t, amplitude * std::sin(phase), 1e-7 * std::cos(9 * phase), 0.6 * std::cos(phase), -0.0325})
      trace.values.push_back(x);
  }
  return trace;
}

/// The message of an InputError, or "".
inline std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace gaitlab::test
