// Rod of 1 kg and 1 m on a hinge of a fixed support.
#pragma once
#include <fmt/format.h>

#include <string>

namespace gaitlab::test {

/// Header and robot of a scenario. At angle 0 the rod hangs down; its inertia about the hinge is 1/3 kg m^2. The YAML text
/// KEYS, which may be empty, is appended to the keys of the hinge: ", drive: none".
inline std::string rod(const std::string& keys = {}) {
  return fmt::format(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 2]
  modules:
    gaitlab_module: 1
    name: rod
    bodies:
      support: {{mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}
      rod: {{mass: 1, com: [0, 0, -0.5], inertia: [0.083333333333333333, 0.083333333333333333, 1e-3, 0, 0, 0]}}
    hinges:
      - {{name: swing, parent: support, child: rod, axis: [0, 1, 0], range: free{}}}
)",
                     keys);
}

}  // namespace gaitlab::test
