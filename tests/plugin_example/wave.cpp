// Example of a CPG plugin: a chain of phase oscillators with its own coupling strength. The plugin includes one header and
// links against no library.
#include <cmath>
#include <numbers>

#include "core/plugin/plugin.h"

namespace {
using namespace gaitlab;

struct Wave final : Cpg {
  struct Settings {
    PerJoint frequency{0.25}, amplitude{0.6};
    double phase_lag = 1.2, coupling = 4;
    void fields(Fields& f) {
      f.per_joint("frequency", frequency, {"Hz", 0, 20, "Own frequency."});
      f.per_joint("amplitude", amplitude, {"rad", 0, 1.6, "Peak set point."});
      f.number("phase_lag", phase_lag, {"rad", -6.3, 6.3, "Lead of each joint over its predecessor."});
      f.number("coupling", coupling, {"1/s", 0, 100, "Pull towards the lag."});
    }
  };
  Wave(const RobotInfo& robot, const Settings& s) : n(robot.joints.size()), s(s) {}
  std::size_t states() const override { return n; }
  void start(Out phi) const override {
    for (std::size_t i = 0; i < n; ++i) phi[i] = s.phase_lag * static_cast<double>(i);
  }
  void derivative(const Measured&, In phi, Out rate) const override {
    for (std::size_t i = 0; i < n; ++i) {
      rate[i] = 2 * std::numbers::pi * s.frequency[i];
      if (i > 0) rate[i] += s.coupling * std::sin(phi[i - 1] - phi[i] + s.phase_lag);
    }
  }
  void output(double, In phi, Out setpoint) const override {
    for (std::size_t i = 0; i < n; ++i) setpoint[i] = s.amplitude[i] * std::sin(phi[i]);
  }
  std::size_t n;
  Settings s;
};
}  // namespace

GAITLAB_PLUGIN(registry) { add_cpg<Wave>(registry, "wave", "phi_i' = 2 pi f + w sin(phi_{i-1} - phi_i + lag)"); }
