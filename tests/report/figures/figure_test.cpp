// Tests of the figure of a run: a wave through eight modules, whose torques are invented.
#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "report/analysis/motors.h"
#include "report/figures/paper/run_figure.h"
#include "tests/program/fixture.h"
#include "tests/report/sample.h"

namespace gaitlab::test {
namespace {

using namespace report;
using sample::count;

constexpr std::size_t kJoint = 7;  // m3/passive

// True if all tags are closed in the correct order and all attributes are quoted. The writer cannot make other errors.
bool well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    at = end;
    if (tag.empty() || tag.find('<') != std::string::npos || count(tag, "\"") % 2 != 0) return false;
    if (tag.front() == '?' || tag.back() == '/') continue;
    const std::string name = tag.substr(0, tag.find(' '));
    if (name.front() != '/') {
      open.push_back(name);
    } else {
      if (open.empty() || "/" + open.back() != name) return false;
      open.pop_back();
    }
  }
  return open.empty();
}

/// A wave of period 4 s through the caterpillar, which drifts.
class Wave {
 public:
  explicit Wave(double duration = 20, double period = 0.005) {
    const Robot& robot = *scenario.robot;
    scenario.figure.joints = {robot.joints[kJoint].name};
    scenario.trace.period = period;
    add("t", "s", [](double t) { return t; });
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const auto angle = [j](double t) { return 0.594 * math::sin(2 * sample::kPi * t / 4 + 1.2 * static_cast<double>(j)); };
      add(column(j, "angle"), "rad", angle);
    }
    const auto phase = [](double t) { return 2 * sample::kPi * t / 4; };
    add(column(kJoint, "setpoint"), "rad", [=](double t) { return 0.6 * math::sin(phase(t)); });
    add(column(kJoint, "torque"), "N m",
        [=](double t) { return -0.05 + 0.45 * math::sin(phase(t) + 1) + 0.02 * math::sin(41 * phase(t)); });
    add(column(kJoint, "saturation"), "", [](double t) { return t > 17 && t < 18 ? 1.0 : 0.0; });
    for (const char* pose : {"base.y", "base.qx", "base.qy", "base.qz"}) add(pose, "", [](double) { return 0.0; });
    add("base.x", "m", [](double t) { return -0.0272 * t; });
    add("base.z", "m", [](double) { return 0.05; });
    add("base.qw", "", [](double) { return 1.0; });
    for (int row = 0; row * period <= duration + 1e-9; ++row) {
      for (const auto& value : values_) record.trace.values.push_back(value(row * period));
    }
    record.simulated = summary.simulated = duration;
  }
  [[nodiscard]] static std::string column(std::size_t joint, const char* quantity) {
    return fmt::format("joint.{}.{}", joint, quantity);
  }
  double& last(const std::string& name) {
    const auto found = std::ranges::find(record.trace.columns, name, &Column::name);
    return *(record.trace.values.end() - (record.trace.columns.end() - found));
  }
  [[nodiscard]] std::string svg() const { return run_figure(scenario, record, summary); }

  Scenario scenario = shipped("caterpillar.yaml");
  Recording record;
  Summary summary;

 private:
  void add(const std::string& name, const std::string& unit, std::function<double(double)> value) {
    record.trace.columns.push_back({name, unit, ""});
    values_.push_back(std::move(value));
  }
  std::vector<std::function<double(double)>> values_;
};

TEST(Figure, ShowsCurvesLimitsViewsAndUnits) {
  const std::string svg = Wave().svg();
  EXPECT_TRUE(well_formed(svg));
  for (const std::string text :
       {"caterpillar-8", "joint 7 (m3/passive)", "angle (rad)", "torque (N m)", "time (s)", "set point", "voltage limit",
        ">16 s<", ">20 s<", "x (m)", "active block", "passive block", "link", "side view (arrow: m3/passive)"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  EXPECT_EQ(count(svg, "paint-order"), 5U * 24U);
  EXPECT_EQ(svg.find("current limit"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_LT(svg.size(), 200000U);
  EXPECT_EQ(svg, Wave().svg());
}

TEST(Figure, ShowsTheLastEightSecondsOrAll) {
  EXPECT_NE(Wave().svg().find(">12</text>"), std::string::npos);
  EXPECT_EQ(Wave().svg().find(">11</text>"), std::string::npos);
  EXPECT_NE(Wave(4).svg().find(">0.5</text>"), std::string::npos);
  Wave whole;
  whole.summary.limit_cycle = {true, 0, 3, 0.001};  // two whole periods
  EXPECT_NE(whole.svg().find(">14</text>"), std::string::npos);
  EXPECT_EQ(whole.svg().find(">13</text>"), std::string::npos);
}

TEST(Figure, DrawsTheTorqueAtRestWhereTheCurveComesNear) {
  const double rest = rest_torques(Wave().scenario)[kJoint];
  const auto with = [&](double torque) {
    Wave wave;
    wave.last(Wave::column(kJoint, "torque")) = torque;
    return wave.svg();
  };
  const std::string text = fmt::format("torque at rest, {:.3g} N m", rest);
  EXPECT_NE(with(0.9 * rest).find(text), std::string::npos);
  EXPECT_NE(with(-0.9 * rest).find(text), std::string::npos);
  EXPECT_EQ(with(0.7 * rest).find("at rest"), std::string::npos);
}

TEST(Figure, NamesThePeakOfTheJudgedTimeAndMarksChanges) {
  Wave wave;
  const std::string without = wave.svg();
  wave.summary.judged.joints.resize(wave.scenario.robot->joints.size());
  wave.summary.judged.joints[kJoint].torque_peak = 1.234;
  wave.summary.judged.joints[kJoint].torque_peak_time = 9.5;
  wave.scenario.changes.resize(2);
  wave.scenario.changes[0].t = 3;  // before the drawn time
  wave.scenario.changes[1].t = 15;
  const std::string svg = wave.svg();
  EXPECT_NE(svg.find(", peak 1.23 N m at 9.50 s"), std::string::npos);
  EXPECT_EQ(count(svg, "stroke-dasharray=\"1 3\""), 1U);
  EXPECT_EQ(count(without, "stroke-dasharray=\"1 3\""), 0U);
}

// At most two points per 0.25 px: three curves of 850 px and 13 bytes per point are 270 kB, and the views 60 kB.
TEST(Figure, LongTracesStaySmall) { EXPECT_LT(Wave(20, 0.0002).svg().size(), 400000U); }

TEST(Figure, DoesWithoutMotorColumnsGroundOrRows) {
  Wave wave;
  wave.scenario.actuator.entry = nullptr;
  EXPECT_EQ(wave.svg().find("torque"), std::string::npos);
  EXPECT_EQ(wave.svg().find("set point"), std::string::npos);
  EXPECT_NE(wave.svg().find("angle"), std::string::npos);
  Trace times;
  times.columns.push_back({"t", "s", ""});
  for (std::size_t row = 0; row < wave.record.rows(); ++row) times.values.push_back(wave.record.trace.at(row, 0));
  wave.record.trace = times;
  EXPECT_EQ(wave.svg().find("time (s)"), std::string::npos);
  EXPECT_TRUE(well_formed(wave.svg()));
  wave.record = {};
  wave.summary.simulated = 0;
  EXPECT_TRUE(well_formed(wave.svg()));
}

TEST(Figure, SurvivesAFailedRun) {
  Wave wave;
  wave.last(Wave::column(kJoint, "angle")) = std::numeric_limits<double>::quiet_NaN();
  wave.last(Wave::column(kJoint, "torque")) = -std::numeric_limits<double>::infinity();
  wave.last(Wave::column(kJoint, "setpoint")) = 1e300;
  wave.last("base.x") = std::numeric_limits<double>::quiet_NaN();
  const std::string svg = wave.svg();
  EXPECT_TRUE(well_formed(svg));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("\"inf"), std::string::npos);
}

TEST(Figure, TitlesAreText) {
  Wave wave;
  wave.scenario.name = "<script>alert(\"&\")</script>";
  const std::string svg = wave.svg();
  EXPECT_TRUE(well_formed(svg));
  EXPECT_EQ(svg.find("<script"), std::string::npos);
}

}  // namespace
}  // namespace gaitlab::test
