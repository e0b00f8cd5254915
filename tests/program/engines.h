// Fixture for tests that run with every engine. Such a test derives its fixture from EveryEngine and instantiates it with
// engines() and engine_name.
#pragma once
#include "tests/program/fixture.h"

namespace gaitlab::test {

class EveryEngine : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static std::string set() { return "physics.engine=" + GetParam(); }
  /// Name of the engine's first-order integrator.
  [[nodiscard]] static std::string first_order() { return catalog().engine(GetParam())->fixed().name; }
};

inline auto engines() { return testing::ValuesIn(catalog().engines()); }
inline std::string engine_name(const testing::TestParamInfo<std::string>& info) { return info.param; }

}  // namespace gaitlab::test
