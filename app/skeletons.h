// The texts that `gaitlab new plugin` writes: @NAME@ is the plugin's name, @CLASS@ its class. tests/gates/install.sh builds and
// tests them.
#pragma once
#include <array>

#include "core/plugin/registry.h"

namespace gaitlab::app {

struct Skeleton {
  Kind kind;
  const char* code;      ///< @NAME@.cpp
  const char* scenario;  ///< scenario.yaml
  const char* test;      ///< what test.cmake asks of the summary; @NAME@ as above
};

extern const std::array<Skeleton, 3> kSkeletons;
extern const char* const kSkeletonBuild;  ///< CMakeLists.txt
extern const char* const kSkeletonTest;   ///< test.cmake; @TEST@: Skeleton::test

}  // namespace gaitlab::app
