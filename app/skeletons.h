// Templates of the files that `gaitlab new plugin` writes. @NAME@ is replaced by the plugin's name and @CLASS@ by its class.
// tests/gates/install.sh builds and tests the files.
#pragma once
#include <array>

#include "core/plugin/registry.h"

namespace gaitlab::app {

struct Skeleton {
  Kind kind;
  const char* code;      ///< content of @NAME@.cpp
  const char* scenario;  ///< content of scenario.yaml
  const char* test;      ///< condition on the summary that test.cmake checks
};

extern const std::array<Skeleton, 3> kSkeletons;
extern const char* const kSkeletonBuild;  ///< content of CMakeLists.txt
extern const char* const kSkeletonTest;   ///< content of test.cmake; @TEST@ is replaced by Skeleton::test

}  // namespace gaitlab::app
