// Messages on a CPG whose output or state is not finite.
#include "core/simulation/cpg_check.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/simulation/simulation_error.h"

namespace gaitlab {
namespace {

struct NamedStates final : Cpg {
  explicit NamedStates(std::vector<std::string> with) : names(std::move(with)) {}
  [[nodiscard]] std::size_t states() const override { return names.size(); }
  [[nodiscard]] std::string state_name(std::size_t index) const override { return names[index]; }
  void output(double, In, Out) const override {}
  std::vector<std::string> names;
};

/// `where | what` of the error at step 40, t = 0.6 s, or "finite".
std::string checked(const std::vector<std::string>& names, const std::vector<double>& state,
                    const std::vector<double>& setpoint) {
  Robot robot;
  robot.joints = {{.name = "m0/active"}, {.name = "m0/passive"}};
  try {
    check_cpg(NamedStates(names), robot, setpoint, state, 40, 0.6);
  } catch (const SimulationError& error) {
    EXPECT_EQ(error.ended, Ended::diverged);
    EXPECT_EQ(error.step, 40);
    EXPECT_EQ(error.time, 0.6);
    return error.where + " | " + error.what();
  }
  return "finite";
}

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(CpgCheck, TakesWhatIsFinite) {
  EXPECT_EQ(checked({"phi.0", "phi.1"}, {1e300, -1e300}, {0, -0.0}), "finite");
  EXPECT_EQ(checked({}, {}, {}), "finite");
}

TEST(CpgCheck, NamesTheJointOfASetPoint) {
  EXPECT_EQ(checked({}, {}, {0, std::nan("")}),
            "m0/passive | diverged at step 40, t = 0.6 s: joint m0/passive: the CPG's set point is nan");
  EXPECT_EQ(checked({}, {}, {-kInfinite, 0}),
            "m0/active | diverged at step 40, t = 0.6 s: joint m0/active: the CPG's set point is -inf");
}

TEST(CpgCheck, NamesTheStateAndItsJoint) {
  EXPECT_EQ(checked({"phi.0", "phi.1"}, {0, kInfinite}, {std::nan(""), 0}),
            "m0/passive | diverged at step 40, t = 0.6 s: joint m0/passive: the CPG's state phi is inf")
      << "the cause before its effect";
  EXPECT_EQ(checked({"a.b.1"}, {kInfinite}, {}),
            "m0/passive | diverged at step 40, t = 0.6 s: joint m0/passive: the CPG's state a.b is inf");
}

TEST(CpgCheck, NamesAStateThatIsOfNoJointInFull) {
  for (const std::string name : {"clock", "phi.2", "phi.", "phi.1x", ".x", "phi.-1", "99999999999999999999.", "1"}) {
    EXPECT_EQ(checked({name}, {kInfinite}, {}),
              fmt::format("{0} | diverged at step 40, t = 0.6 s: the CPG's state {0} is inf", name));
  }
}

}  // namespace
}  // namespace gaitlab
