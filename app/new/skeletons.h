// Templates of the files that `gaitlab new` writes, with places to fill such as @NAME@. tests/gates/install.sh builds and tests
// those of plugins.
#pragma once
#include <array>
#include <string>

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

extern const char* const kSkeletonModule;    ///< content of a module file
extern const char* const kSkeletonScenario;  ///< content of a scenario of equal modules, or of a robot with legs
extern const char* const kSkeletonWave;      ///< content of its section `cpg`, for a wave of sines
extern const char* const kSkeletonBench;     ///< content of the bench of a servo

/// The text with every occurrence of `mark` replaced by `value`.
std::string filled(std::string text, const std::string& mark, const std::string& value);

}  // namespace gaitlab::app
