// Period, start and growth of gaits whose set points are formulas of the time, at the thresholds of their rules. The recordings
// are made up, so that a case takes milliseconds.
#include <cmath>
#include <functional>
#include <numbers>

#include "report/analysis/gait.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;

using Formula = std::function<double(double)>;

constexpr double kTick = 0.015;  // s, the control period
constexpr double kPi = std::numbers::pi;

/// A CPG whose set points, equal for all joints, are a formula of the time. It states the times that a test sets.
class OfFormula final : public Cpg {
 public:
  struct Settings {
    void fields(Fields&) {}
  };
  OfFormula(const RobotInfo&, const Settings&) {}
  void output(double t, In, Out setpoint) const override {
    for (double& one : setpoint) one = formula(t);
  }
  [[nodiscard]] SetPointTimes times() const override { return stated; }
  static inline Formula formula;
  static inline SetPointTimes stated;
};

Formula sine(double period, double amplitude = 0.3) {
  return [=](double t) { return amplitude * std::sin(2 * kPi * t / period); };
}
Formula sum(const Formula& a, const Formula& b) {
  return [=](double t) { return a(t) + b(t); };
}
/// A formula times 1 before a time, and times a factor from then on.
Formula times_from(const Formula& f, double from, double factor) {
  return [=](double t) { return f(t) * (t < from - 1e-9 ? 1 : factor); };
}
/// Not periodic, because it grows by 23 % per turn.
double growing(double t) { return 0.3 * std::exp(t / 10) * std::sin(3 * t); }

class GaitRules : public ::testing::Test {
 protected:
  GaitRules() : catalog_(app::standard_catalog()) { add_cpg<OfFormula>(catalog_, "formula", ""); }

  /// A run of `duration` s with these set points. `carried` is the load of the ground as a share of the weight. The set points
  /// of the recording are `recorded`, if feedback changed them.
  struct Run {
    double duration;
    Formula formula;
    SetPointTimes stated = {};
    Formula carried = [](double) { return 1.0; };
    Formula recorded = formula;
  };
  Gait of(const Run& run) {
    OfFormula::formula = run.formula;
    OfFormula::stated = run.stated;
    scenario_ = read_scenario(folder_.write("two.yaml",
                                            "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\n"
                                            "contact: {on: all}\ncpg: {type: formula}\nduration: 1\n"),
                              {}, catalog_);
    const Robot& robot = *scenario_.robot;
    record_ = {};
    record_.simulated = run.duration;
    const std::vector<Column> columns = pose_columns(robot.joints.size());
    record_.poses.columns = columns;
    for (std::int64_t k = 0; static_cast<double>(k) * kTick <= run.duration + 1e-9; ++k) {
      const double t = static_cast<double>(k) * kTick;
      const double set_point = run.recorded(std::max(0.0, t - kTick));  // the set point in force just before the row
      for (const Column& column : columns) {
        const double value = column.name == "t"      ? t
                             : column.name == "load" ? run.carried(t) * robot.mass * scenario_.physics.gravity.norm()
                             : column.name.ends_with("setpoint") ? set_point
                                                                 : 0;
        record_.poses.values.push_back(value);
      }
    }
    return gait(scenario_, record_);
  }
  /// The sentence on growth for a run that is judged from its start to its end.
  std::string growth_of(const Run& run) {
    const Gait found = of(run);
    Judged whole;
    whole.to = run.duration;
    return growth(scenario_, record_, whole, found);
  }

  Folder folder_;
  Catalog catalog_;
  Scenario scenario_;
  Recording record_;
};

TEST_F(GaitRules, ThePeriodOfTheRecordedSetPoints) {
  const Gait found = of({6, sine(1)});
  EXPECT_NEAR(found.period, 1, 1e-3);  // tolerance for the vertex of a parabola through samples every 15 ms
  EXPECT_EQ(found.start, 0);
}

/// The recorded set points of the second case are those of a CPG with feedback, which cannot be simulated alone.
TEST_F(GaitRules, AStatedPeriodOfARunThatIsTooShortForIt) {
  EXPECT_EQ(of({6, growing, {.period = 1000}}).period, 1000);
  EXPECT_EQ(of({6, growing, {.period = 120}}).period, 0) << "the CPG alone was simulated for 306 s, 2.55 such periods";
  EXPECT_EQ(of({.duration = 6, .formula = sine(1), .stated = {.period = 3}, .recorded = growing}).period, 3);
  EXPECT_EQ(of({.duration = 6, .formula = sine(1), .stated = {.period = 1}, .recorded = growing}).period, 0);
}

/// Set points that approach a periodic motion have the period that the CPG states, if they have this period later.
TEST_F(GaitRules, SetPointsThatStillApproachTheirPeriod) {
  const Formula grows = [](double t) { return 0.3 * (1 - std::exp(-t / 2)) * std::sin(2 * kPi * t); };
  EXPECT_EQ(of({3.99, grows, {.period = 1}}).period, 1);
  EXPECT_EQ(of({3.99, grows, {.period = 0.7}}).period, 0);
}

/// A window of one period bears half of the weight if the robot lands in its middle: from 1.0 s on, if it lands at 1.5 s.
TEST_F(GaitRules, StartsAtTheLanding) {
  const auto lands = [](double at) { return [at](double t) { return t < at ? 0.0 : 1.0; }; };
  EXPECT_NEAR(of({6, sine(1), {}, lands(1.5)}).start, 1, 1.5 * kTick);  // one row of tolerance before or after
  EXPECT_EQ(of({6, sine(1), {}, [](double t) { return t < 4 ? 1.0 : 0.0; }}).start, 0) << "not on the ground at the end";
}

TEST_F(GaitRules, StartsAfterAStatedRamp) {
  EXPECT_EQ(of({6, sine(1), {.full_size = 2}}).start, 2);
  EXPECT_EQ(of({6, sine(1), {.full_size = 8}}).start, 0) << "the ramp ends after the run";
}

/// The set points are larger before 1 s. The period of 0.35 s has more than 20 rows (0.3 s), and 9 periods fit into the rest of
/// the run.
TEST_F(GaitRules, StartsWhereTheSetPointsHaveTheirSize) {
  const Formula settles = times_from(sine(0.35, 0.45), 1, 2.0 / 3);
  EXPECT_NEAR(of({4.2, settles}).start, 4.2 - 9 * 0.35, 0.01);  // the tolerance is nine times the error of the period
  EXPECT_EQ(of({4.2, sine(0.35)}).start, 0);
  EXPECT_EQ(of({4.2, settles, {.full_size = 0.3}}).start, 0.3) << "a stated time decides";
}

/// A growth of 2 % of the range is allowed, and 0.06 % for samples that miss the peak, but at least 1 mrad.
TEST_F(GaitRules, GrowthAfterTheRun) {
  const auto grows = [&](double amplitude, double share, double full_size = 0) {
    return contains(growth_of({6, times_from(sine(1, amplitude), 6, 1 + share), {.full_size = full_size}}),
                    "still grow: those");
  };
  EXPECT_FALSE(grows(0.3, 0.0203));
  EXPECT_TRUE(grows(0.3, 0.0208));
  EXPECT_FALSE(grows(0.01, 0.04)) << "by 0.8 mrad";
  EXPECT_TRUE(grows(0.01, 0.06)) << "by 1.2 mrad";
  EXPECT_FALSE(grows(0.3, 0.1, 1)) << "a stated time decides";
  EXPECT_TRUE(contains(growth_of({6, sine(1), {.full_size = 7}}), "at 7 s, but the run ends at 6 s; take duration: 10"));
}

/// The allowed drift over the five periods from the first to the last is 1 % of the range of 0.606 rad and one row of the
/// largest step, 0.42 mrad.
TEST_F(GaitRules, DriftWithinTheRun) {
  const auto drifts = [&](double per_period) { return growth_of({6, sum(sine(1), [=](double t) { return per_period * t; })}); };
  EXPECT_EQ(drifts(0.00126), "");
  EXPECT_TRUE(contains(drifts(0.00134), "the set points drift: the mean of joint")) << drifts(0.00134);
  const Formula shrinks = [](double t) { return 0.3 * (1 - 0.008 * t) * std::sin(2 * kPi * t); };
  EXPECT_TRUE(contains(growth_of({6, shrinks}), "the set points shrink: the RMS of joint")) << growth_of({6, shrinks});
}

}  // namespace
}  // namespace gaitlab::test
