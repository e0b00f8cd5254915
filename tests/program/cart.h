// A cart of two hinges: a castor without a motor, which is joint 0, and an arm with one.
#pragma once
#include "tests/program/fixture.h"

namespace gaitlab::test {

inline const std::string kCastorFirst = R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 1]
  modules:
    gaitlab_module: 2
    name: cart
    bodies:
      support: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}
      tail: {mass: 0.1, com: [0, 0, -0.05], inertia: [1e-4, 1e-4, 1e-4, 0, 0, 0]}
      upper: {mass: 0.2, com: [0, 0, -0.05], inertia: [1e-3, 1e-3, 1e-3, 0, 0, 0]}
    hinges:
      - {name: castor, parent: support, child: tail, axis: [0, 1, 0], range: free, drive: none, damping: 0.01}
      - {name: arm, parent: support, child: upper, origin: [0.3, 0, 0], axis: [0, 1, 0], range: [-1, 1]}
ground: {type: none}
contact: {on: none}
physics: {engine: articulated}
cpg: {type: phase_oscillator, frequency: 1, amplitude: 0.3, phase_lag: 1}
duration: 2
trace: {columns: ["joint.*"]}
)";

}  // namespace gaitlab::test
