// Cart with two hinges: joint 0 is a castor without a motor, joint 1 an arm with a motor.
#pragma once
#include "tests/folders.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {

/// Text of the scenario of the cart. The gate of the page (tests/gates/page.sh) also runs this scenario.
inline const std::string kCastorFirst = read(std::string(gaitlab::test::source_folder()) + "/tests/data/castor-first.yaml");

}  // namespace gaitlab::test
