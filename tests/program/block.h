// One block, 1 kg, on four points: what tests of contacts, grounds and loads put on the ground.
#pragma once
#include "tests/program/fixture.h"

namespace gaitlab::test {

/// `robot: ` of it, with a COM in the plane of the points, so that friction does not tip it; `keys`: more keys of the robot,
/// each a line of its own that begins with two spaces and ends with a newline.
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
