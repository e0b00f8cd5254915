// Tests of the numbers on the posture of a robot (height, tilt, time in the air) with motions that are known in closed form.
#include "report/analysis/posture.h"

#include <nlohmann/json.hpp>

#include "studies/study/scorer.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;

Scenario one_module(const std::vector<std::string>& sets) {
  return scenario(
      "gaitlab: 1\nname: one\nrobot: {modules: mtran}\ncontact: {on: all}\nphysics: {engine: articulated}\n"
      "trace: {period: 0.01}\n",
      sets);
}

Posture posture_of(const Scenario& s) {
  const Recording r = run(s);
  return posture(s, r, summarise(s, r, 0).judged);
}

/// A falling module is airborne all the time. Its height is z0 - g t^2 / 2. The window starts after a fifth of the run, and its
/// first tick is the next tick.
TEST(Posture, AFallIsAirborneAllTheTime) {
  const Scenario s = one_module({"robot.position=[0, 0, 10]", "duration=1"});
  const Recording r = run(s);
  const Judged judged = summarise(s, r, 0).judged;
  const Posture p = posture(s, r, judged);
  EXPECT_EQ(p.airborne_share, 1);
  const double g = s.physics.gravity.norm();
  const double start = r.com(0).z();
  // Integration error of adaptive steps, m. They follow the accuracy of the motor torques, which are 0 in free fall, so that
  // the longest steps are taken.
  constexpr double kIntegration = 1e-4;
  EXPECT_NEAR(p.height_min, start - g / 2, kIntegration);
  const double first = (std::floor(judged.from / s.control_period + 1e-9) + 1) * s.control_period;
  EXPECT_NEAR(p.height_max, start - g * first * first / 2, kIntegration);
}

TEST(Posture, AtRestIsNeverAirborne) {
  const Posture p = posture_of(one_module({"duration=1"}));
  EXPECT_EQ(p.airborne_share, 0);
  EXPECT_LT(p.height_max - p.height_min, 1e-3);  // m; the module settles on its contacts
}

/// Without gravity the time in the air is unknown.
TEST(Posture, IsNotKnownWhereNothingCarries) {
  EXPECT_TRUE(std::isnan(posture_of(one_module({"duration=0.2", "physics.gravity=[0, 0, 0]"})).airborne_share));
}

TEST(Posture, TiltIsOfTheBaseAgainstTheVertical) {
  constexpr double kTilt = 0.3;  // rad
  // The module is in the air, where no moment acts on it.
  const Posture p = posture_of(one_module({"robot.position=[0, 0, 10]", "robot.orientation=[0.3, 0, 1]", "duration=0.5"}));
  EXPECT_NEAR(p.tilt_max, kTilt, 1e-6);  // tolerance for the rounding error of acos
}

/// The speed is the distance between the ends of the window divided by its length, here with ends at ticks.
TEST(Posture, CycleSpeedIsThatOfTheWindow) {
  Recording r;
  r.poses.columns = {{"t", "s", ""}, {"com.x", "m", ""}, {"com.y", "m", ""}};
  for (int k = 0; k <= 100; ++k) {
    const double t = 0.1 * k;
    const double v = t < 4 ? 7 : 0.3;  // speeds of start and gait, m/s
    const double x = t < 4 ? v * t : 28 + v * (t - 4);
    for (const double value : {t, x, -x}) r.poses.values.push_back(value);
  }
  Judged judged;
  judged.from = 5.55;
  judged.to = 9.95;
  EXPECT_TRUE(std::isnan(cycle_speed(r, judged)));  // unknown without a limit cycle
  judged.periods = 2;
  EXPECT_NEAR(cycle_speed(r, judged), 0.3 * std::sqrt(2.0), 1e-12);
  judged.to = 9.92;  // divides the interval between two rows differently from the start
  EXPECT_NEAR(cycle_speed(r, judged), 0.3 * std::sqrt(2.0), 1e-12);
}

/// If the window ends between two rows, the numbers use the last row within the window.
TEST(Posture, EndsWithTheWindow) {
  const Scenario s = one_module({"robot.position=[0, 0, 10]", "duration=1"});
  const Recording r = run(s);
  Judged judged;
  judged.from = 0.2;
  judged.to = 0.5;
  const double last = std::floor(judged.to / s.control_period) * s.control_period;
  constexpr double kIntegration = 1e-4;  // integration error of adaptive steps, m
  EXPECT_NEAR(posture(s, r, judged).height_min, r.com(0).z() - s.physics.gravity.norm() * last * last / 2, kIntegration);
}

/// The shipped walking gaits are never airborne for long, and a hopping gait is.
TEST(Posture, ShippedGaitsKeepToTheGround) {
  const auto share = [](const char* file, const char* duration) {
    return posture_of(shipped(file, {"physics.engine=articulated", duration})).airborne_share;
  };
  EXPECT_EQ(share("caterpillar.yaml", "duration=8"), 0);
  EXPECT_EQ(share("hexapod.yaml", "duration=6"), 0);
}

}  // namespace
}  // namespace gaitlab::test
