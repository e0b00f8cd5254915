// Helpers of the tests of goldens: a trace, and the message of a refused file.
#pragma once
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/recording/trace.h"
#include "golden/compare.h"
#include "golden/golden.h"

namespace gaitlab::test {

using namespace golden;

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

inline constexpr double kSpacing = 0.02;  // time between rows, s

/// Trace with a large and a small torque, an angle, and a constant height.
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

using Sentences = std::vector<std::string>;

inline Golden sample_golden(const Trace& trace) {
  Golden golden;
  golden.origin = {"walk", "bullet", "semi_implicit", 2.5e-5, "0.1.0+abc (GNU 12.2.0)", "GNU 12.2.0", "00000000000000aa"};
  golden.history = {{1, "first \"golden\"", "0.1.0+abc"}, {2, "stiffer feet", "0.1.0+abd"}};
  golden.run = {trace, unpack(pack(trace), "x").precision};
  golden.rounding.assign(trace.columns.size(), 0.0);
  golden.bands.assign(trace.columns.size(), Band{1e-5, 3e-4, 1e-6});
  golden.bands[0] = {};
  golden.numbers = {{"distance", "m", 0.5}, {"m0/active.torque.peak", "N m", 1.3}};
  golden.number_bands = {{1e-6, 2e-6, 1e-3}, {1e-3, 0, 1e-6}};
  golden.verdict = Word::feasible;
  return golden;
}

inline GoldenRun run_of(const Golden& golden) { return {golden.run.trace, golden.numbers}; }

}  // namespace gaitlab::test
