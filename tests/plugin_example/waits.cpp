// CPG plugin whose runs wait while the folder GAITLAB_HOLD exists. Each run writes a file with the number of its process into
// this folder, so that a gate can kill a program during a run on machines of any speed. A run is recognised by the motion of
// the first joint, whose measured angle is constant while set points are computed before the run.
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <thread>

#include "core/plugin/plugin.h"

namespace {
using namespace gaitlab;

void wait_while_held() {
  const char* name = std::getenv("GAITLAB_HOLD");
  if (name == nullptr) return;
  const std::filesystem::path folder = name;
  std::error_code gone;
  if (std::filesystem::exists(folder, gone)) std::ofstream(folder / std::to_string(::getpid()));
  while (std::filesystem::exists(folder, gone)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

struct Waits final : Cpg {
  struct Settings {
    double frequency = 1, amplitude = 0.6, wait = 1;
    void fields(Fields& f) {
      f.number("frequency", frequency, {"Hz", 0, 20, "Of all joints."});
      f.number("amplitude", amplitude, {"rad", 0, 1.6, "Peak set point."});
      f.number("wait", wait, {"1", 0, 1, "A run waits where it is above 0.9."});
    }
  };
  Waits(const RobotInfo&, const Settings& settings) : s(settings) {}
  // Phase, and the first joint's angle at the last control tick.
  std::size_t states() const override { return 2; }
  void start(Out state) const override { state[0] = state[1] = 0; }
  void derivative(const Measured&, In, Out rate) const override {
    rate[0] = 2 * std::numbers::pi * s.frequency;
    rate[1] = 0;
  }
  void event(const Measured& measured, Out state) const override {
    if (s.wait > 0.9 && measured.t > 0.1 && measured.angle[0] != state[1]) wait_while_held();
    state[1] = measured.angle[0];
  }
  void output(double, In state, Out setpoint) const override {
    for (double& each : setpoint) each = s.amplitude * std::sin(state[0]);
  }
  Settings s;
};
}  // namespace

GAITLAB_PLUGIN(registry) { add_cpg<Waits>(registry, "waits", "phi' = 2 pi f, set points A sin(phi)"); }
