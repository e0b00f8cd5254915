// A free chain without external forces conserves momenta and energy to the order of the integrator. The tests also detect the
// damping and other options of btMultiBody that violate this.
#include <array>
#include <cmath>
#include <random>

#include "tests/program/engines.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

/// Chain of eight modules with random joint speeds, without gravity, motors and ground.
Scenario chain(const std::string& engine, const std::string& integrator, double step) {
  std::mt19937 random(7);  // the C++ standard defines the numbers of mt19937, but not those of distributions
  std::string speeds;
  for (int j = 0; j < 16; ++j)
    speeds += fmt::format("{}{:.3f}", j == 0 ? "" : ", ", static_cast<double>(random() % 4001) / 1000 - 2);
  return scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, build: robots/caterpillar-8.dat, position: [0, 0, 1], orientation: [0.3, 0.2, 0.1]}}
initial: {{speeds: [{}], base_velocity: [0.1, -0.2, 0.3], base_angular_velocity: [0.5, -0.4, 0.3]}}
physics: {{engine: {}, step: {}, integrator: {}, gravity: [0, 0, 0]}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
duration: 0.2
trace: {{period: 0.01, columns: [energy.*, momentum.*, angular_momentum.*]}}
)",
                              speeds, engine, step, integrator));
}

/// Largest relative changes of kinetic energy, momentum and angular momentum during the run.
std::array<double, 3> drift(const Scenario& scenario) {
  const Recording record = run(scenario);
  const Table table(record.trace);
  const auto vec = [&](std::size_t row, const std::string& name) {
    return Vec3(table.at(row, name + ".x"), table.at(row, name + ".y"), table.at(row, name + ".z"));
  };
  std::array<double, 3> worst{};
  const double energy = table.at(0, "energy.kinetic");
  const Vec3 p = vec(0, "momentum");
  const Vec3 l = vec(0, "angular_momentum");
  for (std::size_t row = 1; row < record.trace.rows(); ++row) {
    worst[0] = std::max(worst[0], std::abs(table.at(row, "energy.kinetic") - energy) / energy);
    worst[1] = std::max(worst[1], (vec(row, "momentum") - p).norm() / p.norm());
    worst[2] = std::max(worst[2], (vec(row, "angular_momentum") - l).norm() / l.norm());
  }
  return worst;
}

constexpr std::array<const char*, 3> kName{"energy", "momentum", "angular momentum"};

class FreeChain : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Of, FreeChain, engines(), engine_name);

TEST_P(FreeChain, FirstOrderIsOfFirstOrder) {
  const auto coarse = drift(chain(GetParam(), first_order(), 1e-3));
  const auto middle = drift(chain(GetParam(), first_order(), 5e-4));
  const auto fine = drift(chain(GetParam(), first_order(), 2.5e-4));
  for (std::size_t i = 0; i < 3; ++i) {
    std::printf("first order   %-18s 1 ms %.3e  0.5 ms %.3e  0.25 ms %.3e\n", kName[i], coarse[i], middle[i], fine[i]);
    // The error of this ratio is of the next order and proportional to h, so that the coarse pair has twice the tolerance.
    EXPECT_NEAR(coarse[i] / middle[i], 2, 0.3) << kName[i];
    validate({"order.free_chain." + first_order(),
              "eight modules thrown, 0.5 and 0.25 ms: log2 of the drifts' ratio (energy, momenta)", "docs/equations.md, 7", ""},
             std::log2(middle[i] / fine[i]), 1, 0.1, "the next order is smaller by the step times the rates, 0.5 ms * 100/s");
    // Bullet's default damping dissipates 2 % of the energy in 0.2 s. This bound detects a quarter of that damping.
    EXPECT_LT(fine[i], 5e-3) << kName[i];
  }
}

TEST_P(FreeChain, RungeKuttaIsOfFourthOrder) {
  const auto coarse = drift(chain(GetParam(), "rk4", 5e-3));
  const auto middle = drift(chain(GetParam(), "rk4", 2.5e-3));
  const auto fine = drift(chain(GetParam(), "rk4", 1.25e-3));
  for (std::size_t i = 0; i < 3; ++i) {
    std::printf("rk4           %-18s 5 ms %.3e  2.5 ms %.3e  1.25 ms %.3e\n", kName[i], coarse[i], middle[i], fine[i]);
    // Order 4 gives a ratio of 16 and order 3 a ratio of 8; 11 is their geometric mean.
    EXPECT_GT(coarse[i] / middle[i], 11) << kName[i];
    validate({"order.free_chain.rk4", "eight modules thrown, 2.5 and 1.25 ms: log2 of the drifts' ratio (energy, momenta)",
              "docs/equations.md, 7", ""},
             std::log2(middle[i] / fine[i]), 4, 0.4, "the next order is smaller by the step times the rates, 2.5 ms * 100/s");
    validate_below({fmt::format("property.free_chain.{}", i == 2 ? "angular_momentum" : kName[i]),
                    fmt::format("eight modules thrown, rk4 at 1.25 ms: worst relative change of {} in 0.2 s", kName[i]),
                    "conservation", ""},
                   fine[i], 1e-10, "order 4: (1.25 ms * 8 rad/s)^5 / 120 per step, 160 steps");
  }
}

}  // namespace
}  // namespace gaitlab::test
