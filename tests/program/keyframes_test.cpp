// Tests of the CPG `keyframes`: defining properties of the splines, approximation of a sine, error messages.
#include "cpg/keyframes.h"

#include <cmath>
#include <numbers>

#include "core/scenario/read_scenario.h"
#include "core/scenario/resolved.h"
#include "tests/messages.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace cpg;

RobotInfo joints(std::size_t count) {
  RobotInfo robot;
  for (std::size_t j = 0; j < count; ++j) {
    JointInfo joint;
    joint.name = "m" + std::to_string(j) + "/passive";
    robot.joints.push_back(joint);
  }
  return robot;
}

Keyframes::Settings settings(std::vector<Keyframes::Frame> frames, bool repeat) {
  Keyframes::Settings s;
  s.model.frames = std::move(frames);
  s.model.repeat = repeat;
  return s;
}

double at(const Keyframes& gait, double t, std::size_t joint = 0, std::size_t count = 1) {
  std::vector<double> setpoint(count, 7.0);
  gait.output(t, {}, setpoint);
  return setpoint[joint];
}

// Frames at uneven times for two joints.
std::vector<Keyframes::Frame> uneven(bool closed) {
  return {{0, {0, {0.1, -0.2}}},
          {0.3, {0, {0.5, 0.4}}},
          {1.0, {0, {-0.6, 0.1}}},
          {1.4, {0, {0.2, 0.9}}},
          {2.5, {0, {closed ? 0.1 : 0.7, closed ? -0.2 : -1.0}}}};
}

TEST(Keyframes, BothCurvesPassThroughTheFrames) {
  for (const bool repeat : {true, false}) {
    for (const auto interpolation : {Keyframes::Interpolation::spline, Keyframes::Interpolation::linear}) {
      Keyframes::Settings s = settings(uneven(repeat), repeat);
      s.model.interpolation = interpolation;
      const Keyframes gait(joints(2), s);
      for (const Keyframes::Frame& frame : s.model.frames) {
        for (std::size_t j = 0; j < 2; ++j) {
          EXPECT_NEAR(at(gait, frame.time, j, 2), frame.angles[j], 1e-14) << frame.time;
          if (repeat) {
            EXPECT_NEAR(at(gait, frame.time + 7.5, j, 2), frame.angles[j], 1e-12) << frame.time;
          }
        }
      }
    }
  }
}

// One-sided first and second derivatives of a cubic, computed from four of its points. Their only errors are rounding errors.
struct Ends {
  double speed, curvature;
};
Ends derivatives(const Keyframes& gait, double t, double h, std::size_t joint) {
  const double y[4] = {at(gait, t, joint, 2), at(gait, t + h, joint, 2), at(gait, t + 2 * h, joint, 2),
                       at(gait, t + 3 * h, joint, 2)};
  return {(-11 * y[0] + 18 * y[1] - 9 * y[2] + 2 * y[3]) / (6 * h), (2 * y[0] - 5 * y[1] + 4 * y[2] - y[3]) / (h * h)};
}

TEST(Keyframes, SplineIsSmoothAtEveryFrameAndAcrossThePeriod) {
  const Keyframes gait(joints(2), settings(uneven(true), true));
  for (const double t : {2.8, 3.5, 3.9, 5.0}) {  // the frames of the second period
    for (std::size_t j = 0; j < 2; ++j) {
      const Ends before = derivatives(gait, t - 1e-9, -0.05, j);
      const Ends after = derivatives(gait, t + 1e-9, 0.05, j);
      EXPECT_NEAR(before.speed, after.speed, 1e-6) << t;
      EXPECT_NEAR(before.curvature, after.curvature, 1e-4) << t;
    }
  }
}

TEST(Keyframes, WithoutRepeatItStartsAndEndsAtRestAndHolds) {
  const Keyframes gait(joints(2), settings(uneven(false), false));
  for (const double t : {0.3, 1.0, 1.4}) {
    EXPECT_NEAR(derivatives(gait, t - 1e-9, -0.05, 1).curvature, derivatives(gait, t + 1e-9, 0.05, 1).curvature, 1e-4) << t;
  }
  EXPECT_NEAR(derivatives(gait, 0, 0.05, 0).speed, 0, 1e-10);
  EXPECT_NEAR(derivatives(gait, 2.5, -0.05, 0).speed, 0, 1e-10);
  EXPECT_EQ(at(gait, 2.5, 1, 2), -1.0);
  EXPECT_EQ(at(gait, 400, 1, 2), -1.0);
}

TEST(Keyframes, ClampedSplineOfTwoFramesIsTheKnownCubic) {
  const Keyframes gait(joints(1), settings({{0, {0}}, {2, {0.8}}}, false));
  for (int tenth = 0; tenth <= 20; ++tenth) {
    const double t = 0.1 * tenth;
    const double s = t / 2;
    EXPECT_NEAR(at(gait, t), 0.8 * (3 * s * s - 2 * s * s * s), 1e-15) << t;
  }
}

// Largest difference between a sine and the periodic spline through n of its samples.
double sine_error(int n) {
  constexpr double kTurn = 2 * std::numbers::pi;
  std::vector<Keyframes::Frame> frames;
  for (int k = 0; k <= n; ++k) frames.push_back({3.0 * k / n, {k == n ? 0 : std::sin(kTurn * k / n)}});
  const Keyframes gait(joints(1), settings(frames, true));
  double worst = 0;
  for (int i = 0; i < 3000; ++i) worst = std::max(worst, std::abs(at(gait, i * 1e-3) - std::sin(kTurn * i / 3000)));
  return worst;
}

TEST(Keyframes, SplineThroughASineIsOfFourthOrder) {
  // The error of a cubic spline with equidistant frames converges to h^4 / 384 times the fourth derivative.
  const double h = 2 * std::numbers::pi / 16;
  EXPECT_NEAR(sine_error(16), std::pow(h, 4) / 384, 0.1 * std::pow(h, 4) / 384);
  EXPECT_NEAR(sine_error(16) / sine_error(32), 16, 0.5);
  EXPECT_NEAR(sine_error(32) / sine_error(64), 16, 0.2);
}

TEST(Keyframes, TwoAndThreeFramesRepeat) {
  const Keyframes still(joints(1), settings({{0, {0.3}}, {2, {0.3}}}, true));
  EXPECT_DOUBLE_EQ(at(still, 1.234), 0.3);
  // The joint moves up and back. By symmetry its speed is zero at both frames, so that each half is a known cubic.
  const Keyframes swing(joints(1), settings({{0, {0}}, {1, {1}}, {2, {0}}}, true));
  for (int tenth = 0; tenth <= 10; ++tenth) {
    const double t = 0.1 * tenth;
    EXPECT_NEAR(at(swing, t), t * t * (3 - 2 * t), 1e-14) << t;
    EXPECT_NEAR(at(swing, 2 - t), t * t * (3 - 2 * t), 1e-14) << t;
  }
}

TEST(Keyframes, LinearAndRamp) {
  Keyframes::Settings s = settings(uneven(true), true);
  s.model.interpolation = Keyframes::Interpolation::linear;
  s.model.ramp = 4;
  const Keyframes gait(joints(2), s);
  EXPECT_NEAR(at(gait, 0.15, 0, 2), 0.1 + (0.3 - 0.1) * 0.15 / 4, 1e-15);
  EXPECT_NEAR(at(gait, 2.5 + 1.2, 1, 2), -0.2 + (0.5 + 0.2) * 3.7 / 4, 1e-14);
  EXPECT_NEAR(at(gait, 5 + 1.2, 1, 2), 0.5, 1e-14);
}

TEST(Keyframes, DefaultsHoldZero) {
  const Keyframes gait(joints(3), {});
  for (const double t : {0.0, 0.5, 1.0, 17.3}) EXPECT_EQ(at(gait, t, 2, 3), 0);
}

const char* const kGaitScenario = R"(gaitlab: 1
name: keys
robot:
  modules: mtran
  docks: [[1, 1, 4, 0, 0]]
cpg:
  type: keyframes
  model:
    frames:
      - {time: 0, angles: {default: 0.1, m1/passive: 0.3}}
      - {time: 0.6, angles: [0, 0.1, 0.2, -0.3]}
      - {time: 1.5, angles: {m1/passive: 0.3, default: 0.1}}
duration: 3
)";

std::string with(std::string text, const std::string& old, const std::string& now) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), now);
}

TEST(Keyframes, ReadFromAScenarioMovesEveryJointThroughItsFrames) {
  const Scenario s = scenario(kGaitScenario);
  const Recording r = run(s);
  const Table table(r.trace);
  // A row contains the set point of the last control tick before it. The tick at 0.6 s is valid until the next at 0.615 s.
  const double expected[4] = {0, 0.1, 0.2, -0.3};
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_NEAR(table(0.61, fmt::format("joint.{}.setpoint", j)), expected[j], 1e-12) << j;
    EXPECT_NEAR(table(2.11, fmt::format("joint.{}.setpoint", j)), expected[j], 1e-12) << j;
    EXPECT_NEAR(table(1.51, fmt::format("joint.{}.setpoint", j)), j == 3 ? 0.3 : 0.1, 1e-12) << j;
  }
  // The resolved scenario does not change if it is written, read and resolved again.
  const Folder folder;
  EXPECT_EQ(resolved(read_scenario(folder.write("again.yaml", resolved(s)), {}, catalog())), resolved(s));
}

std::string complaint(const std::string& text) {
  return message_of([&] { scenario(text); });
}

TEST(Keyframes, ErrorsNameTheFrameOrTheJoint) {
  const auto expect = [](const std::string& old, const std::string& now, const std::string& what) {
    const std::string found = complaint(with(kGaitScenario, old, now));
    EXPECT_NE(found.find(what), std::string::npos) << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  };
  expect("time: 0,", "time: 0.2,", "10:7: error: the first frame's time must be 0");
  expect("time: 1.5", "time: 0.6", "10:7: error: times must rise: frames[2] is not later than the one before it");
  expect("{m1/passive: 0.3, default: 0.1}", "{m1/passive: 0.2, default: 0.1}",
         "cpg 'keyframes': the last frame differs from the first at joint m1/passive; make them equal or set repeat: false");
  expect("m1/passive: 0.3}", "m2/passive: 0.3}", "no joint 'm2/passive'");
  expect("-0.3]", "-4]", "is -4 rad; expected -3.2 to 3.2 rad for a hinge with a range");
  const std::string open = with(kGaitScenario, "{m1/passive: 0.3, default: 0.1}", "0");
  EXPECT_EQ(complaint(with(open, "  model:\n", "  model:\n    repeat: false\n")), kNoError);
  EXPECT_NE(
      complaint("gaitlab: 1\nrobot: {modules: mtran}\ncpg: {type: keyframes, model: {frames: [{time: 0}]}}\nduration: 1\n")
          .find("at least two frames are needed; found 1"),
      std::string::npos);
}

TEST(Keyframes, TheConstructorChecksToo) {
  EXPECT_THROW(Keyframes(joints(1), settings({{0, {}}}, true)), std::invalid_argument);
  EXPECT_THROW(Keyframes(joints(1), settings({{0, {}}, {0, {}}}, true)), std::invalid_argument);
  EXPECT_THROW(Keyframes(joints(1), settings({{0, {}}, {1, {0.1}}}, true)), std::invalid_argument);
}

}  // namespace
}  // namespace gaitlab::test
