// Tests of the data of motors, feet and docks in a page.
#include "actuators/dc_motor.h"
#include "report/analysis/envelope.h"
#include "tests/report/page/opened_page.h"

namespace gaitlab::test {
namespace {

using nlohmann::json;

TEST(PageMotors, AreThoseOfEq1And2) {
  const Scenario s = shipped("caterpillar.yaml", {"actuator.i_max={default: 1.2, m0/active: 0.3}"});
  const report::Motors motors = report::motors(s, 1);
  ASSERT_EQ(motors.of_joint.size(), s.robot->joints.size());
  ASSERT_EQ(motors.kinds.size(), 2U);
  EXPECT_EQ(motors.of_joint[0], 0U);
  EXPECT_EQ(motors.of_joint[1], 1U);
  EXPECT_EQ(motors.of_joint[5], 1U);
  const actuators::DcMotorActuator::Settings shipped_motor;
  const double R = shipped_motor.R[0];
  const double Kt = shipped_motor.Kt[0];
  const double Ks = shipped_motor.Ks[0];
  const double n = shipped_motor.gear[0];
  const double eta = shipped_motor.efficiency[0];
  const double u = shipped_motor.u_max[0];
  for (const auto& [kind, largest] : {std::pair(0, 0.3), {1, 1.2}}) {
    const report::Envelope& motor = motors.kinds[static_cast<std::size_t>(kind)];
    EXPECT_EQ(motor.unit, "V");
    EXPECT_EQ(motor.command, u);
    EXPECT_NEAR(motor.current.value(), largest, 1e-12) << "rounding";
    EXPECT_NEAR(motor.no_load.value(), u / (Ks * n), 1e-9) << "what sixty halvings leave, and rounding";
    EXPECT_NEAR(motor.rest.value(), eta * Kt * n * std::min(largest, u / R), 1e-12);
    ASSERT_EQ(motor.speed.size(), motor.most.size());
    EXPECT_GE(motor.speed.back(), motor.no_load.value());
    for (std::size_t i = 0; i < motor.speed.size(); ++i) {
      const double w = motor.speed[i];
      EXPECT_NEAR(motor.most[i], eta * Kt * n * std::clamp((u - Ks * n * w) / R, -largest, largest), 1e-12);
      EXPECT_NEAR(motor.least[i], eta * Kt * n * std::clamp((-u - Ks * n * w) / R, -largest, largest), 1e-12);
    }
  }
}

TEST(PageMotors, OfATorqueSource) {
  const std::vector<std::string> torque{"actuator={type: torque, limit: 1.5}", "controller={type: pid, unit: N m, Kp: 5}"};
  const report::Motors bounded = report::motors(shipped("caterpillar.yaml", torque), 4);
  ASSERT_EQ(bounded.kinds.size(), 1U);
  EXPECT_EQ(bounded.kinds[0].unit, "N m");
  EXPECT_EQ(bounded.kinds[0].command, 1.5);
  EXPECT_EQ(bounded.kinds[0].rest, 1.5);
  EXPECT_FALSE(bounded.kinds[0].no_load);
  EXPECT_FALSE(bounded.kinds[0].current);
  EXPECT_EQ(bounded.kinds[0].speed.back(), 4);
  for (const double least : bounded.kinds[0].least) EXPECT_EQ(least, -1.5);
  const report::Motors free =
      report::motors(shipped("caterpillar.yaml", {"actuator={type: torque}", "controller={type: pid, unit: N m, Kp: 5}"}), 4);
  ASSERT_EQ(free.kinds.size(), 1U);
  EXPECT_FALSE(free.kinds[0].command);
  EXPECT_FALSE(free.kinds[0].rest);
  EXPECT_TRUE(free.kinds[0].most.empty());
}

/// The forces on the feet of a standing robot carry its weight, and their resultant is below the centre of mass.
TEST(PageFeet, CarryTheWeightBelowTheCentreOfMass) {
  const std::vector<std::string> stands{"duration=1.5", "physics.engine=articulated", "cpg={type: sine, amplitude: 0}",
                                        "trace.columns=[joint.*, base.*, com.*, contact.*]"};
  const Scenario s = shipped("hexapod.yaml", stands);
  const Recording r = run(s);
  const Opened page(data_of(s, r));
  const std::size_t feet = page.meta["feet"].size();
  ASSERT_EQ(feet, 6U);
  double weight = 0;
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < feet; ++i) {
    const auto end = [&](const char* what) { return page.channels.at(fmt::format("foot.{}.{}", i, what)).back(); };
    weight += end("fz");
    moment += end("fz") * Vec3(end("x"), end("y"), end("z"));
  }
  EXPECT_NEAR(weight, page.meta["weight"].get<double>(), 0.1) << "six feet to 0.01 N, and what still sways";
  const Vec3 below = moment / weight;
  EXPECT_NEAR(below.x(), r.com(r.rows() - 1).x(), 1e-3) << "places to 0.25 mm, forces to 0.01 N, and what still sways";
  EXPECT_NEAR(below.y(), r.com(r.rows() - 1).y(), 1e-3);
  EXPECT_NEAR(below.z(), 0, 1e-3) << "the plane, into which feet sink by less";
}

TEST(PageFeet, WithoutContactColumnsHaveTheirLoad) {
  const Scenario s = shipped("hexapod.yaml", {"duration=0.1", "physics.engine=articulated", "trace.columns=[joint.*]"});
  const Recording r = run(s);
  const Opened page(data_of(s, r));
  ASSERT_EQ(page.meta["feet"].size(), 6U);
  EXPECT_EQ(page.meta["feet"][0]["name"], "m5/passive");
  EXPECT_EQ(page.channels.count("foot.0.fx") + page.channels.count("foot.0.x"), 0U);
  EXPECT_NEAR(page.channels.at("foot.0.fz").back(), r.series("load.5").back(), 0.01);
  EXPECT_EQ(page.meta["missing"].size(), 2U) << page.meta["missing"];
}

TEST(PageLoads, AreThoseAtControlTicks) {
  const Scenario s = shipped("hexapod.yaml", {"duration=0.3", "physics.engine=articulated", "trace.columns=[joint.*]"});
  Simulation simulation({&s, 1}, Loads::recorded);
  simulation.run();
  const Recording r = simulation.take_recording(0);
  const Opened page(data_of(s, r));
  EXPECT_EQ(page.meta["missing"], json::array());
  ASSERT_EQ(page.meta["feet"].size(), 6U);
  ASSERT_EQ(page.meta["docks"].size(), 10U);
  // At 0.15 s a control tick and a trace tick coincide, so that no interpolation is necessary.
  const std::size_t tick = 10;
  const std::size_t row = 30;
  ASSERT_NEAR(r.loads.at(tick, 0), 0.15, 1e-9);
  std::size_t compared = 0;
  const auto compare = [&](const std::string& channel, const std::string& column, double half) {
    const std::size_t at = r.loads.find(column);
    ASSERT_LT(at, r.loads.columns.size()) << column;
    EXPECT_NEAR(page.channels.at(channel)[row], r.loads.at(tick, at), half) << channel << ": half of the largest quantum";
    ++compared;
  };
  for (std::size_t m = 1; m <= 10; ++m) {
    const std::string dock = fmt::format("dock.{}.", m - 1);
    EXPECT_EQ(page.meta["docks"][m - 1]["module"], m);
    for (const char* force : {"tension", "shear"}) compare(dock + force, fmt::format("dock.{}.{}", m, force), 5e-3);
    for (const char* moment : {"bending", "torsion"}) compare(dock + moment, fmt::format("dock.{}.{}", m, moment), 5e-4);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string name = "foot." + page.meta["feet"][i]["name"].get<std::string>() + ".";
    for (const char* axis : {"fx", "fy", "fz"}) compare(fmt::format("foot.{}.{}", i, axis), name + axis, 0.01);
    for (const char* axis : {"x", "y", "z"}) compare(fmt::format("foot.{}.{}", i, axis), name + axis, 2.5e-4);
  }
  compare("stability", "stability", 2.5e-4);
  EXPECT_EQ(compared, 77U);
}

}  // namespace
}  // namespace gaitlab::test
