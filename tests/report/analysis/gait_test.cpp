// Tests of the look-ahead for the period of the set points: once per CPG, stopped by a flag, never with another language's
// code.
#include "report/analysis/gait.h"

#include <cmath>

#include "report/analysis/cpg_alone.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;

/// A CPG that counts its outputs. Its gait has a period of 4 s.
class Counted final : public Cpg {
 public:
  struct Settings {
    double amplitude = 0.3;
    void fields(Fields& f) { f.number("amplitude", amplitude, {"rad", 0, 2, "Amplitude."}); }
  };
  Counted(const RobotInfo&, const Settings& s) : amplitude_(s.amplitude) {}
  void output(double t, In, Out setpoint) const override {
    ++calls;
    for (double& one : setpoint) one = amplitude_ * std::sin(0.5 * 3.141592653589793 * t);
  }
  static inline int calls = 0;

 private:
  double amplitude_;
};

class LookAhead : public ::testing::Test {
 protected:
  LookAhead() : catalog_(app::standard_catalog()) { add_cpg<Counted>(catalog_, "counted", ""); }
  Scenario read(const std::vector<std::string>& sets) {
    return read_scenario(folder_.write("two.yaml",
                                       "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncpg: {type: counted}\n"
                                       "physics: {engine: articulated}\nduration: 1\n"),
                         sets, catalog_);
  }
  /// Number of calls of the CPG alone, apart from the period.
  static int calls(const Scenario& s, const Recording& r, double period) {
    Counted::calls = 0;
    EXPECT_NEAR(gait(s, r).period, period, 1e-3);  // the tick is 15 ms; the vertex of a parabola is much more accurate
    return Counted::calls;
  }

  Folder folder_;
  Catalog catalog_;
};

/// 9 s, two periods and an eighth, are 600 ticks. The search doubles from twice the length of the run and ends after 1072
/// ticks, each with one call of the CPG. 120 s would be 8000 ticks.
TEST_F(LookAhead, IsAsShortAsThePeriodAllowsAndIsDoneOnce) {
  const Scenario s = read({"cpg.amplitude=0.31"});
  const Recording r = run(s);
  const int first = calls(s, r, 4);
  EXPECT_GT(first, 500);
  EXPECT_LT(first, 1100);
  EXPECT_EQ(calls(s, r, 4), 0);
  Scenario other = s;
  other.ground.friction = 0.4;
  EXPECT_EQ(calls(other, run(other), 4), 0);
  const Scenario amplitude = read({"cpg.amplitude=0.32"});
  EXPECT_EQ(calls(amplitude, run(amplitude), 4), first);
}

/// The warnings before a run need the set points at its ticks (67 in 1 s). The look-ahead continues after these ticks.
TEST_F(LookAhead, ContinuesFromTheWarnings) {
  for (const char* type : {"counted", "phase_oscillator"}) {
    const Scenario s = read({std::string("cpg.type=") + type});
    const std::vector<double> whole = CpgAlone(s).rows(200);
    EXPECT_FALSE(set_point_ranges(s).empty());
    Counted::calls = 0;
    CpgAlone alone = CpgAlone::found(s);
    EXPECT_EQ(alone.rows(200), whole) << type;
    EXPECT_EQ(Counted::calls, *type == 'c' ? 200 - 67 : 0);
    EXPECT_EQ(CpgAlone::found(s).rows(200), whole) << type;
    const Scenario other = read({std::string("cpg.type=") + type, "initial.angles=0.1"});
    (void)set_point_ranges(s);
    EXPECT_EQ(CpgAlone::found(other).rows(200), CpgAlone(other).rows(200)) << type;
  }
}

TEST_F(LookAhead, AsksItsFlag) {
  const Scenario s = read({"cpg.amplitude=0.33"});
  const Recording r = run(s);
  {
    const std::atomic<bool> stop = true;
    const StopsCpgAlone stops(stop);
    EXPECT_EQ(calls(s, r, 0), 0);
  }
  EXPECT_GT(calls(s, r, 4), 0) << "what was stopped is not kept";
}

TEST_F(LookAhead, CallsNoCodeOfAnotherLanguage) {
  const Scenario s = read({"cpg.amplitude=0.34"});
  const Recording r = run(s);
  Entry foreign = *s.cpg.entry;
  foreign.context = std::make_shared<int>(0);
  Scenario of_it = s;
  of_it.cpg.entry = &foreign;
  EXPECT_EQ(calls(of_it, r, 0), 0);
  EXPECT_GT(calls(s, r, 4), 0);
}

}  // namespace
}  // namespace gaitlab::test
