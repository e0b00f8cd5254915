// Rod of 1 kg and 1 m on a hinge of a fixed support, and other bodies in its place.
#pragma once
#include <fmt/format.h>

#include <string>

namespace gaitlab::test {

inline constexpr double kRodInertia = 1.0 / 3;  ///< about its hinge, kg m^2
inline constexpr double kRodWeight = 9.81 / 2;  ///< moment of the weight of the horizontal rod, N m

/// Header and robot of a scenario, with a body on a hinge about y. The YAML texts BODY, the keys of the body, and KEYS, further
/// keys of the hinge, such as ", drive: none", are in its maps.
inline std::string on_hinge(const std::string& body, const std::string& keys = {}) {
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
      rod: {{{}}}
    hinges:
      - {{name: swing, parent: support, child: rod, axis: [0, 1, 0], range: free{}}}
)",
                     body, keys);
}

/// At angle 0 the rod hangs down; its inertia about the hinge is 1/3 kg m^2.
inline std::string rod(const std::string& keys = {}) {
  return on_hinge("mass: 1, com: [0, 0, -0.5], inertia: [0.083333333333333333, 0.083333333333333333, 1e-3, 0, 0, 0]", keys);
}

/// A balanced rotor of this inertia, kg m^2.
inline std::string rotor(double inertia) {
  return on_hinge(fmt::format("mass: 0.1, com: [0, 0, 0], inertia: [{0}, {0}, {0}, 0, 0, 0]", inertia));
}

}  // namespace gaitlab::test
