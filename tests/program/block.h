// Robot for tests of contacts, grounds and loads: one block of 1 kg on four contact points.
#pragma once
#include "tests/program/fixture.h"

namespace gaitlab::test {

/// The setting `robot:` of the block. Its centre of mass is in the plane of the points, so that friction does not tip it.
/// `keys` are further lines of the setting; each line begins with two spaces and ends with a newline.
inline std::string block_robot(const std::string& keys) {
  return "robot:\n" + keys + R"(  modules:
    name: block
    bodies: {block: {mass: 1, inertia: [0.01, 0.01, 0.01, 0, 0, 0]}}
    contacts:
      feet:
        - {body: block, point: [0.1, 0.1, 0]}
        - {body: block, point: [0.1, -0.1, 0]}
        - {body: block, point: [-0.1, 0.1, 0]}
        - {body: block, point: [-0.1, -0.1, 0]}
)";
}

}  // namespace gaitlab::test
