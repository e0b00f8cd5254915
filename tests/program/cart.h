// A cart of two hinges: a castor without a motor, which is joint 0, and an arm with one.
#pragma once
#include "tests/program/fixture.h"

namespace gaitlab::test {

/// The scenario, which the page's gate runs, too.
inline const std::string kCastorFirst = read(GAITLAB_SOURCE_DIR "/tests/data/castor-first.yaml");

}  // namespace gaitlab::test
