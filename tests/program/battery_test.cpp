// Tests of batteries of modules: each is a bus of its own, and modules without one share the scenario's supply.
#include <cmath>

#include "report/analysis/collisions.h"
#include "report/verdict/verdict.h"
#include "tests/folder.h"
#include "tests/program/as_alone.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

/// A module type: a post with two faces, and a rod on a hinge.
std::string type(const std::string& name, const std::string& battery) {
  return "    " + name + ":\n        gaitlab_module: 1\n        name: " + name + R"(
        bodies:
          post: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}
          rod: {mass: 0.5, com: [0, 0, -0.2], inertia: [0.01, 0.01, 0.001, 0, 0, 0]}
        hinges: [{name: swing, parent: post, child: rod, axis: [0, 1, 0], range: free}]
        faces:
          - {id: 0, body: post, gender: none, origin: [0, -0.1, 0], normal: [0, -1, 0], reference: [0, 0, 1]}
          - {id: 1, body: post, gender: none, origin: [0, 0.1, 0], normal: [0, 1, 0], reference: [0, 0, 1]}
)" + (battery.empty() ? "" : "        battery: " + battery + "\n");
}

/// Two posts side by side on a fixed base, so that no rod feels the other. The second module has the type `b`.
std::string two(const std::string& a, const std::string& b, const std::string& supply, const std::string& more = {}) {
  return "gaitlab: 1\nrobot:\n  base: fixed\n  position: [0, 0, 2]\n  types:\n" + type("a", a) + type("b", b) +
         "  modules: {0: a, 1: b}\n  docks: [[0, 1, 1, 0, 0]]\n" + (supply.empty() ? "" : "supply: " + supply + "\n") + R"(
ground: {type: none}
contact: {on: none}
physics: {engine: articulated, estimate: off}
actuator: {type: servo, voltage: 6, stall_torque: 2, no_load_speed: 8, i_max: 100}
controller: {type: rc_servo, period: 0.01, gain: 4}
cpg: {type: keyframes, model: {frames: [{time: 0, angles: 0}, {time: 0.3, angles: [0.6, 1.2]}, {time: 0.6, angles: 0}]}}
duration: 2.5
)" + (more.empty() ? "trace: {period: 0.01}\n" : more);
}

const std::string kBig = "{voltage: 7.4, resistance: 0.1}", kSmall = "{voltage: 7.2, resistance: 0.8}";

Series column(const Recording& r, const std::string& name) { return r.series(name); }

void expect_equal(const Series& a, const Series& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  ASSERT_GT(a.size(), 100U) << what;
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9) << what << " " << i;
}

/// Motors with batteries of their own move as if each had the scenario's supply alone.
TEST(Battery, IsABusOfItsModule) {
  const std::string columns = "trace: {period: 0.01, columns: [t, joint.*, battery.*]}\n";
  const Recording own = run(scenario(two(kBig, kSmall, "", columns)));
  const Recording shared =
      run(scenario(two("", kSmall, kBig, "trace: {period: 0.01, columns: [t, joint.*, battery.*, supply.*]}\n")));
  expect_equal(column(own, "battery.m0.voltage"), column(shared, "supply.voltage"), "the supply feeds the other module alone");
  for (const char* const name : {"battery.m1.voltage", "battery.m1.current", "joint.0.angle", "joint.1.angle"})
    expect_equal(column(own, name), column(shared, name), name);
  EXPECT_TRUE(column(shared, "battery.m0.voltage").empty());
  EXPECT_TRUE(column(own, "supply.voltage").empty());
  double least = 7.2;
  for (const double v : own.series("battery.m1.voltage").values()) least = std::min(least, v);
  EXPECT_LT(least, 6.8) << "the small battery sags";
}

/// One battery for both motors sags more than one for each.
TEST(Battery, DoesNotFeedItsNeighbours) {
  const Recording one = run(scenario(two("", "", kSmall, "trace: {period: 0.01, columns: [t, supply.*]}\n")));
  const Recording own = run(scenario(two(kSmall, kSmall, "", "trace: {period: 0.01, columns: [t, battery.*]}\n")));
  EXPECT_EQ(one.buses(), 1U);
  EXPECT_EQ(own.buses(), 2U);
  double least = 8;
  double least_own = 8;
  for (std::size_t k = 1; k < own.supply.rows(); ++k) {
    least = std::min(least, one.bus(k, 0, kLeastVoltage));
    least_own = std::min({least_own, own.bus(k, 0, kLeastVoltage), own.bus(k, 1, kLeastVoltage)});
  }
  EXPECT_LT(least, least_own - 0.1);
}

/// A servo without u_max has the voltage of its battery.
TEST(Battery, IsTheLimitOfItsMotors) {
  const Recording r = run(scenario(two("{voltage: 5}", "{voltage: 9}", ""), {"controller.gain=100"}));
  for (const auto& [joint, volts] : {std::pair(0, 5.0), std::pair(1, 9.0)}) {
    double most = 0;
    for (const double u : r.joint(static_cast<std::size_t>(joint), "voltage").values()) most = std::max(most, std::abs(u));
    EXPECT_DOUBLE_EQ(most, volts);
  }
}

TEST(Battery, IsJudgedByItsModule) {
  const auto judged = [](const std::string& a, const std::string& b, const char* id) {
    const Scenario s = scenario(two(a, b, ""));
    const Recording r = run(s);
    const report::Verdict v = report::verdict(s, r, report::summarise(s, r, 0), report::overlaps(s, r));
    return *std::ranges::find(v.checks, id, &report::Check::id);
  };
  const report::Check fails =
      judged("{voltage: 7.2, resistance: 0.1, least: 6}", "{voltage: 7.2, resistance: 0.8, least: 7}", "brownout");
  EXPECT_EQ(fails.status, report::CheckStatus::fail) << fails.text;
  EXPECT_TRUE(contains(fails.text, "the bus of m1 sags to ")) << fails.text;
  EXPECT_TRUE(contains(fails.text, "below the 7 V that the electronics need")) << fails.text;
  EXPECT_TRUE(contains(fails.text, "m1/swing draws the most then")) << fails.text;
  EXPECT_EQ(fails.source, "battery.least");
  const report::Check draws = judged("{voltage: 7.2, current: 0.01}", "{voltage: 7.2, current: 50}", "battery");
  EXPECT_EQ(draws.status, report::CheckStatus::fail) << draws.text;
  EXPECT_TRUE(contains(draws.text, "the motors of m0 take ")) << draws.text;
  const report::Check without = judged("{voltage: 7.2}", "{voltage: 7.2}", "brownout");
  EXPECT_EQ(without.status, report::CheckStatus::not_judged);
  EXPECT_TRUE(contains(without.text, "the battery of m0 states no least voltage (battery.least)")) << without.text;
}

TEST(Battery, IsReadBackFromTheRun) {
  const Folder folder;
  folder.write("s.yaml", two("{voltage: 7.2, resistance: 0.8, least: 7}", "", kBig));
  EXPECT_EQ(gaitlab("run s.yaml --out r --no-report --quiet", folder.path().string()).code, 0);
  const Result again = gaitlab("report r", folder.path().string());
  EXPECT_TRUE(contains(again.out, "the bus of m0 sags to")) << again.out << again.err;
  EXPECT_FALSE(contains(again.err, "belongs to another")) << again.err;
}

TEST(Battery, LanesAreRunsAlone) {
  std::vector<Scenario> lanes;
  for (const auto& [a, b, supply] :
       {std::array<std::string, 3>{kBig, kSmall, ""}, {"", kSmall, kBig}, {"", "", kSmall}, {"", "", ""}})
    lanes.push_back(scenario(two(a, b, supply, "trace: {period: 0.01, columns: [t, joint.*]}\n")));
  expect_as_alone(lanes, 1);
}

TEST(Battery, IsRefusedWithoutVoltageAndWithoutDcMotors) {
  expect_refusal(two("{resistance: 0.1}", "", ""),
                 "battery has no voltage; expected battery.voltage, the open-circuit voltage in V");
  expect_refusal(two("{voltage: 7, least: 7}", "", ""), "battery.least 7 V is not below battery.voltage 7 V");
  expect_refusal(two("{voltage: -7}", "", ""), "test.yaml:16:28: error: voltage is -7 V");
  expect_refusal(two("{voltage: 7, volts: 3}", "", ""), "volts");
  std::string ideal = two(kBig, "", "");
  const std::string servo = "{type: servo, voltage: 6, stall_torque: 2, no_load_speed: 8, i_max: 100}";
  ideal.replace(ideal.find(servo), servo.size(), "{type: torque}");
  const std::string firmware = "{type: rc_servo, period: 0.01, gain: 4}";
  ideal.replace(ideal.find(firmware), firmware.size(), "{type: pid, unit: N m, Kp: 1}");
  expect_refusal(ideal, "battery needs motors that take V, but actuator 'torque' takes N m");
}

}  // namespace
}  // namespace gaitlab::test
