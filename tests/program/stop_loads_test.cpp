// Loads of docks at the moment when a hinge meets its stop.
#include "tests/program/dense_bending.h"
#include "tests/program/engines.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

class StopLoads : public EveryEngine {};
INSTANTIATE_TEST_SUITE_P(Of, StopLoads, engines(), engine_name);

/// A rod on a hinge without a motor falls into the stop. The stop acts immediately with its damping, 0.5 N m s/rad, and the
/// light rod is at rest after half a millisecond. The largest loads of the dock between its two halves agree with rows every
/// 0.05 ms.
TEST_P(StopLoads, AreThoseOfItsBegin) {
  for (const auto& [range, mass] : {std::pair(0.1, 0.02), std::pair(0.3, 0.06)}) {
    const Scenario s = scenario(fmt::format(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 1]
  docks: [[0, 1, 1, 0, 0]]
  modules: {{0: flail, 1: rod}}
  types:
    flail:
      gaitlab_module: 1
      name: flail
      bodies:
        post: {{mass: 0.1, inertia: [0.0001, 0.0001, 0.0001, 0, 0, 0]}}
        arm: {{mass: 0.02, com: [0.03, 0, 0], inertia: [1e-5, 1e-5, 1e-5, 0, 0, 0]}}
      hinges: [{{name: free, parent: post, child: arm, axis: [0, 1, 0], range: [-0.2, {}], drive: none}}]
      faces: [{{id: 1, body: arm, gender: passive, origin: [0.05, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}}]
    rod:
      gaitlab_module: 1
      name: rod
      bodies: {{rod: {{mass: {}, com: [0.02, 0, 0], inertia: [2e-5, 2e-5, 2e-5, 0, 0, 0]}}}}
      faces: [{{id: 0, body: rod, gender: active, origin: [0, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]}}]
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: none}}
physics: {{engine: {}}}
duration: 0.12
trace: {{period: 5e-5, columns: [reaction.m1/dock.*]}}
)",
                                            range, mass, GetParam()));
    Simulation simulation({&s, 1}, Loads::recorded);
    simulation.run();
    const Recording record = simulation.take_recording(0);
    const DenseBending bending(record, 300);
    EXPECT_LT(bending.at_ticks, 0.8 * bending.dense) << "control ticks alone miss it";
    EXPECT_GT(bending.watched, 0.99 * bending.dense) << range;
    EXPECT_LT(bending.watched, 1.25 * bending.dense) << range;  // the load falls by up to a fifth between two rows
  }
}

}  // namespace
}  // namespace gaitlab::test
