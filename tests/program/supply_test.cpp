// Tests of a supply that motors share: the bus voltage of every tick from the trace, brown-outs, lanes, and runs without
// limits.
#include <atomic>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "report/analysis/collisions.h"
#include "report/remedy/remedy.h"
#include "report/remedy/remedy_text.h"
#include "report/verdict/demand.h"
#include "report/verdict/verdict.h"
#include "tests/program/as_alone.h"
#include "tests/program/fixture.h"
#include "tests/program/rod.h"

namespace gaitlab::test {
namespace {

constexpr double kOpenCircuit = 7.4;
constexpr double kInside = 0.8;
const std::string kBusServo =
    "actuator: {type: servo, voltage: 6, stall_torque: 2, no_load_speed: 8, stall_current: 2.6666666666666665, i_max: 100, "
    "load_friction: 0, "
    "dry_friction: 0, viscous_friction: 0}\n";
const std::string kNoGround = "ground: {type: none}\ncontact: {on: none}\nphysics: {engine: articulated, estimate: off}\n";

std::string swinging(const std::string& controller, double resistance = kInside) {
  const std::string supply =
      resistance > 0 ? fmt::format("supply: {{voltage: {}, resistance: {}}}\n", kOpenCircuit, resistance) : "";
  return rod() + kNoGround + kBusServo + supply + controller +
         "cpg: {type: keyframes, model: {frames: [{time: 0, angles: 0}, {time: 0.3, angles: 1.2}, {time: 0.6, angles: 0}]}}\n"
         "duration: 1.5\ntrace: {period: 0.01, columns: [t, joint.*" +
         std::string(resistance > 0 ? ", supply.*" : "") + "]}\n";
}

/// Voltage of a bus with one motor of 2.25 ohm and 0.75 V s/rad, without losses, whose command is u, V.
double bus_of_one(double u, double speed) {
  constexpr double kR = 2.25;
  constexpr double kEmf = 0.75;
  if (u < 0) return bus_of_one(-u, -speed);
  const double power = u * (u - kEmf * speed) / kR;
  if (power <= 0) return kOpenCircuit;
  const double root = kOpenCircuit * kOpenCircuit - 4 * kInside * power;
  const double volts = root > 0 ? (kOpenCircuit + std::sqrt(root)) / 2 : 0;
  return volts >= u ? volts : (kOpenCircuit + kInside * kEmf * speed / kR) / (1 + kInside / kR);  // else the bus cuts u
}

TEST(Supply, BusVoltageOfEveryTickIsThatOfTheClosedForm) {
  for (const std::string controller :
       {"controller: {type: pid, period: 0.01, Kp: 12, Kd: 0}\n", "controller: {type: pid, period: 0.01, Kp: 300, Kd: 0}\n"}) {
    const Recording r = run(scenario(swinging(controller)));
    const Table row(r.trace);
    double least = kOpenCircuit;
    std::size_t cut = 0;
    for (std::size_t k = 1; k < r.trace.rows(); ++k) {
      const double u = row.at(k, "joint.0.voltage_command");
      const double voltage = row.at(k, "supply.voltage");
      EXPECT_NEAR(voltage, bus_of_one(u, row.at(k - 1, "joint.0.speed")), 1e-9) << controller << k;
      EXPECT_LE(std::abs(row.at(k, "joint.0.voltage")), voltage + 1e-9);
      if (std::abs(u) > voltage) {
        ++cut;
        EXPECT_EQ(row.at(k, "joint.0.saturation"), 1) << k;
      }
      least = std::min(least, voltage);
    }
    EXPECT_LT(least, kOpenCircuit - 0.1);
    EXPECT_GT(cut, contains(controller, "300") ? 40U : 0U);
  }
}

TEST(Supply, DutiesScaleWithTheBus) {
  const Recording r = run(scenario(swinging("controller: {type: rc_servo, period: 0.01, gain: 4}\n")));
  const Table row(r.trace);
  for (std::size_t k = 1; k < r.trace.rows(); ++k) {
    const double error = row.at(k, "joint.0.setpoint") - row.at(k - 1, "joint.0.angle");
    EXPECT_NEAR(row.at(k, "joint.0.voltage_command"), 4 * error * row.at(k, "supply.voltage"), 1e-9) << k;
  }
}

/// Six rods on one body that leave their rest one after another, `apart` s from each other.
std::string rods(double apart) {
  std::string bodies;
  std::string hinges;
  std::string frames;
  for (int j = 0; j < 6; ++j) {
    bodies += fmt::format("      rod{}: {{mass: 0.2, com: [0, 0, -0.1], inertia: [1e-3, 1e-3, 1e-4, 0, 0, 0]}}\n", j);
    hinges += fmt::format("      - {{name: h{0}, parent: body, child: rod{0}, axis: [0, 1, 0], range: free}}\n", j);
  }
  for (int k = 0; k <= 6; ++k) {
    std::string angles;
    for (int j = 0; j < 6; ++j)
      angles += fmt::format("{}{}", j > 0 ? ", " : "", apart == 0 ? (k > 0 ? 1 : 0) : (j < k ? 1 : 0));
    const double step = apart == 0 ? 0.1 : apart;
    frames += fmt::format("{}{{time: {}, angles: [{}]}}, {{time: {}, angles: [{}]}}", k > 0 ? ", " : "", step * k, angles,
                          step * (k + 1) - 0.005, angles);
  }
  return "gaitlab: 1\nrobot:\n  base: fixed\n  position: [0, 0, 2]\n  modules:\n    gaitlab_module: 1\n    name: star\n    "
         "bodies:\n"
         "      body: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}\n" +
         bodies + "    hinges:\n" + hinges + kNoGround + kBusServo +
         "supply: {voltage: 7.4, resistance: 0.2, least: 6, current: 8, capacity: 1}\n"
         "controller: {type: rc_servo, period: 0.005, gain: 6}\n"
         "cpg: {type: keyframes, model: {interpolation: linear, repeat: false, frames: [" +
         frames + "]}}\nduration: 2.5\n";
}

TEST(Supply, JointsThatStartTogetherBrownOutAndStaggeredOnesDoNot) {
  const auto judged = [](const std::string& text) {
    const Scenario s = scenario(text);
    const Recording r = run(s);
    return report::verdict(s, r, report::summarise(s, r, 0), report::overlaps(s, r));
  };
  const auto check = [](const report::Verdict& v, const char* id) {
    return *std::ranges::find(v.checks, id, &report::Check::id);
  };
  const report::Verdict together = judged(rods(0));
  const report::Check down = check(together, "brownout");
  EXPECT_EQ(down.status, report::CheckStatus::fail) << down.text;
  EXPECT_GT(down.value, 7.4 - 6);
  EXPECT_EQ(down.first_part, "m0/h0");
  EXPECT_TRUE(contains(down.text, "below the 6 V that the electronics need for 0.")) << down.text;
  EXPECT_TRUE(contains(together.why(), "so far: the bus sags to")) << together.why();
  const report::Verdict staggered = judged(rods(0.3));
  EXPECT_EQ(check(staggered, "brownout").status, report::CheckStatus::pass) << check(staggered, "brownout").text;
}

TEST(Supply, IsReadBackFromTheRun) {
  const Folder folder;
  folder.write("s.yaml", rods(0));
  EXPECT_EQ(gaitlab("run s.yaml --out r --no-report --quiet", folder.path().string()).code, 0);
  const Result again = gaitlab("report r", folder.path().string());
  EXPECT_TRUE(contains(again.out, "infeasible: the bus sags to")) << again.out << again.err;
  EXPECT_FALSE(contains(again.err, "belongs to another")) << again.err;
}

/// A rod that starts at 25 rad/s against its command charges the battery: V = V0 - r I.
TEST(Supply, AChargedBatteryRaisesTheBoundOfAStatedUMaxAlone) {
  const auto largest = [](const std::string& u_max) {
    const Scenario s = scenario(
        rod() + kNoGround + kBusServo + "supply: {voltage: 7.4, resistance: 0.8, regenerates: true}\ninitial: {speeds: 25}\n" +
            "controller: {type: rc_servo, period: 0.01, gain: 100}\ncpg: {type: keyframes, model: {frames: [{time: 0, angles: "
            "9}, {time: 1, angles: 9}]}}\nduration: 0.1\ntrace: {period: 0.01, columns: [t, joint.*, supply.*]}\n",
        u_max.empty() ? std::vector<std::string>{} : std::vector<std::string>{"actuator.u_max=" + u_max});
    const Recording r = run(s);
    const Table row(r.trace);
    double most = 0;
    for (std::size_t k = 1; k < r.trace.rows(); ++k) {
      if (row.at(k, "supply.current") < 0) {
        EXPECT_GT(row.at(k, "supply.voltage"), 7.4);
      }
      most = std::max(most, std::abs(row.at(k, "joint.0.voltage")));
    }
    EXPECT_LT(row.at(1, "supply.current"), 0);
    return most;
  };
  EXPECT_EQ(largest(""), 7.4);
  EXPECT_GT(largest("12"), 7.5);
}

/// Six rods that turn against their commands: V = (V0 + r sum of d k w / R) / (1 + r sum of d^2 / R), also where the sum is a
/// charge; the battery counts what comes back. Without `regenerates` the bus then stays at V0, and its current is 0.
TEST(Supply, ARobotThatBrakesRaisesTheBusByTheClosedForm) {
  std::string text = rods(0.3);
  text.replace(text.find("least: 6"), 8, "regenerates: true");
  const std::vector<std::string> sets{"initial.speeds=20", "actuator.u_max=18", "duration=0.5",
                                      "trace.columns=[t, joint.*, supply.*]"};
  const Recording r = run(scenario(text, sets));
  std::vector<std::string> burnt = sets;
  burnt.emplace_back("supply.regenerates=false");
  const Recording none = run(scenario(text, burnt));
  const auto bus = [](const Recording& run, std::size_t k) {
    const Table row(run.trace);
    double conductance = 0;
    double back = 0;
    for (int j = 0; j < 6; ++j) {
      const auto at = [&](std::size_t i, const char* what) { return row.at(i, fmt::format("joint.{}.{}", j, what)); };
      const double d = std::clamp(6 * (at(k, "setpoint") - at(k - 1, "angle")), -1.0, 1.0);
      conductance += d * d / 2.25;
      back += d * 0.75 * at(k - 1, "speed") / 2.25;
    }
    return (7.4 + 0.2 * back) / (1 + 0.2 * conductance);
  };
  const Table row(r.trace);
  const Table other(none.trace);
  double charge = 0;
  double most = 0;
  std::size_t held = 0;
  for (std::size_t k = 1; k < r.trace.rows(); ++k) {
    const double volts = row.at(k, "supply.voltage");
    EXPECT_NEAR(volts, bus(r, k), 1e-9) << k;
    EXPECT_NEAR(row.at(k, "supply.current"), (7.4 - volts) / 0.2, 1e-9) << k;
    charge += row.at(k, "supply.current") * 0.005;
    EXPECT_NEAR(r.supply.at(k, kCharge), charge, 1e-9) << k;
    most = std::max(most, volts);
    EXPECT_NEAR(other.at(k, "supply.voltage"), std::min(7.4, bus(none, k)), 1e-9) << k;
    if (bus(none, k) <= 7.4) continue;
    ++held;
    EXPECT_EQ(other.at(k, "supply.current"), 0) << k;
  }
  EXPECT_GT(most, 7.9);
  EXPECT_GT(held, 5U);
}

TEST(Supply, HasALineOfItsEnduranceWhereACapacityIsStated) {
  const Folder folder;
  folder.write("s.yaml", rods(0.3));
  const Result run = gaitlab("run s.yaml --out r --no-report", folder.path().string());
  const auto summary = nlohmann::json::parse(read(folder / "r/summary.json"));
  const double minutes = summary["supply"]["endurance"];
  // A battery of 1 A h; the mean current of the window is not far from the RMS, which is larger.
  EXPECT_GT(minutes, 60 / summary["supply"]["current_rms"].get<double>());
  EXPECT_TRUE(contains(run.out, fmt::format("  endurance {:.3g} min: 1 A h at a mean current of ", minutes))) << run.out;
  const Result without = gaitlab("run s.yaml --out w --no-report --set supply.capacity=0", folder.path().string());
  EXPECT_FALSE(contains(without.out, "endurance")) << without.out;
}

TEST(Supply, NumbersThatAreNotFiniteAreNoEvidence) {
  const Scenario s = scenario(rods(0.3));
  Recording r = run(s);
  r.supply.values[r.supply.columns.size() * 3 + kLeastVoltage] = NAN;
  const report::Verdict v = report::verdict(s, r, report::summarise(s, r, 0), report::overlaps(s, r));
  for (const char* id : {"brownout", "battery"}) {
    const report::Check& check = *std::ranges::find(v.checks, id, &report::Check::id);
    EXPECT_EQ(check.status, report::CheckStatus::not_judged) << id;
    EXPECT_EQ(check.text, "the run has no finite numbers of the supply");
  }
}

TEST(Supply, IsFoundAtItsTick) {
  // At rest all duties are the same step: I = 6 d^2 V / R, so that V = V0 / (1 + 6 r d^2 / R), with d = 1 from 6 (e) > 1 on.
  const Scenario s = scenario(rods(0));
  const Recording r = run(s);
  std::size_t first = 0;
  while (first < r.supply.rows() && r.supply.at(first, kLeastVoltage) >= 6) ++first;
  ASSERT_LT(first, r.supply.rows());
  const Table row(r.trace);
  double expected = 0;
  for (std::size_t k = 1; k < r.trace.rows() && expected == 0; ++k) {
    double conductance = 0;
    double back = 0;
    for (int j = 0; j < 6; ++j) {
      const double d = std::clamp(
          6 * (row.at(k, fmt::format("joint.{}.setpoint", j)) - row.at(k - 1, fmt::format("joint.{}.angle", j))), -1.0, 1.0);
      conductance += d * d / 2;
      back += d * 0.75 * row.at(k - 1, fmt::format("joint.{}.speed", j)) / 2;
    }
    if ((7.4 + 0.2 * back) / (1 + 0.2 * conductance) < 6) expected = row.at(k, "t");
  }
  EXPECT_NEAR(r.supply.at(first, 0), expected, 1e-12);
}

TEST(SupplyLanes, AreRunsAlone) {
  std::vector<Scenario> lanes;
  for (const double resistance : {0.0, 0.1, 0.8, 2.5}) {
    for (const char* const controller : {"gain: 4, latency: 0.02", "gain: 4, limit: 0.3"}) {
      lanes.push_back(
          scenario(swinging(fmt::format("controller: {{type: rc_servo, period: 0.01, {}}}\n", controller), resistance)));
      lanes.back().trace.columns = {"t", "joint.*"};
    }
  }
  expect_as_alone(lanes, 2);
}

/// A rod that swings slowly; its supply has the keys `supply` besides voltage and resistance.
std::string slow_rod(const std::string& supply) {
  return rod() + "ground: {type: none}\ncontact: {on: none}\nphysics: {engine: articulated}\n" + kBusServo +
         "supply: {voltage: 7.4, resistance: 0.4, " + supply +
         "}\ncontroller: {type: pid, period: 0.01, Kp: 30, Kd: 0}\n"
         "cpg: {type: sine, frequency: 0.5, amplitude: 0.3}\nduration: 8\n";
}

/// Run of a scenario with its verdict.
struct JudgedText {
  explicit JudgedText(const std::string& text, const std::vector<std::string>& sets = {})
      : scenario(test::scenario(text, sets)),
        record(run(scenario)),
        summary(report::summarise(scenario, record, 0)),
        verdict(report::verdict(scenario, record, summary, report::overlaps(scenario, record))) {}
  [[nodiscard]] const report::Check& check(const char* id) const {
    return *std::ranges::find(verdict.checks, id, &report::Check::id);
  }
  Scenario scenario;
  Recording record;
  report::Summary summary;
  report::Verdict verdict;
};

report::Remedy remedy_of(const std::string& text, const JudgedText& own) {
  std::atomic<bool> stop = false;
  return report::remedy({own.scenario,
                         own.verdict,
                         [&](const std::vector<std::string>& sets) { return scenario(text, sets); },
                         false,
                         {"u_max", "supply.voltage", "supply.resistance"},
                         {},
                         {}},
                        stop);
}

TEST(SupplyRemedy, IsMoreVoltageOrLessResistance) {
  const std::string text = slow_rod("least: 7");
  const JudgedText own(text);
  ASSERT_EQ(own.verdict.word, Word::infeasible) << own.verdict.reason.text;
  ASSERT_EQ(own.check("brownout").status, report::CheckStatus::fail) << own.verdict.why();
  const report::Check& sag = own.check("brownout");
  const report::Remedy made = remedy_of(text, own);
  ASSERT_EQ(made.lacking.size(), 1U);
  EXPECT_EQ(made.lacking.front().reason, "0: the voltage of the supply");
  std::map<std::string, double> helps;
  for (const report::RemedyAnswer& answer : made.answers) {
    if (answer.confirmed) helps[answer.sets.front().substr(0, answer.sets.front().find('='))] = answer.factor;
  }
  // The drop is r P / V with the same power, so that it is proportional to r / V0. The voltage at the motors changes it by less
  // than 5 %, and the search ends within 2 % of the change.
  ASSERT_EQ(helps.size(), 2U);
  EXPECT_NEAR(helps.at("supply.resistance"), sag.limit / sag.value, 0.04);
  EXPECT_NEAR(helps.at("supply.voltage"), 1 + (sag.value - sag.limit) / 7.4, 0.003);
}

TEST(SupplyRemedy, IsABatteryOfMoreCurrent) {
  const std::string text = slow_rod("current: 0.1");
  const JudgedText own(text);
  ASSERT_EQ(own.check("battery").status, report::CheckStatus::fail) << own.check("battery").text;
  const report::Remedy made = remedy_of(text, own);
  EXPECT_TRUE(made.ratings_suffice);
  ASSERT_EQ(made.ratings.size(), 1U);
  EXPECT_EQ(made.ratings.front().setting, "supply.current");
  EXPECT_GE(made.ratings.front().rating, own.check("battery").value);
  EXPECT_EQ(report::remedy_lines(made).front().text,
            fmt::format("feasible with supply.current >= {:.4g} A (now 0.1 A)", made.ratings.front().rating));
}

TEST(SupplyDemand, IsThatOfARunWithTwentyTimesTheLimitsAtASupplyThatHolds) {
  const std::string text = slow_rod("current: 0.1");
  const auto demand_of = [&](const std::vector<std::string>& sets) {
    JudgedText own(text, sets);
    Scenario twin = scenario(text, sets);
    EXPECT_TRUE(report::raise_limits(twin));
    report::add_demand(own.verdict, own.scenario, own.summary, report::demand(twin, own.record, own.summary));
    return own.verdict;
  };
  // Commands are volts: motors with 20 times the limits, behind no resistance, draw the same power.
  const JudgedText free(text, {"supply.resistance=0", "supply.voltage=148", "actuator.u_max=148"});
  double power = 0;
  double largest = 0;
  const Recording& r = free.record;
  for (std::size_t k = free.summary.judged.first_row + 1; k < r.supply.rows(); ++k)
    power = std::max(power, 148 * r.supply.at(k, kLargestCurrent));
  for (const JudgedJoint& joint : free.summary.judged.joints) largest = std::max(largest, joint.voltage_peak);
  const report::Verdict starved = demand_of({"supply.resistance=2.5"});
  ASSERT_TRUE(starved.supply_demand) << starved.demand_doubt;
  EXPECT_NEAR(starved.supply_demand->current_peak, power / 7.4, 1e-9 * power);
  EXPECT_NEAR(starved.supply_demand->voltage, largest, 1e-9 * largest);
  EXPECT_NEAR(starved.supply_demand->energy,
              r.supply.at(r.supply.rows() - 1, kCharge) * 148 - r.supply.at(free.summary.judged.first_row, kCharge) * 148,
              1e-9 * starved.supply_demand->energy);
  report::Verdict again = starved;
  again.supply_demand.reset();
  ASSERT_TRUE(report::take_demand(again, report::to_json(starved)));
  EXPECT_EQ(again.supply_demand->energy, starved.supply_demand->energy);
}

TEST(SupplyDemand, IsPrinted) {
  const Folder folder;
  folder.write("s.yaml", slow_rod("current: 0.1"));
  for (const char* const set : {"supply.resistance=0.1", "supply.resistance=2.5"}) {
    const std::string text =
        gaitlab(fmt::format("run s.yaml --demand --out {0} --no-report --set {0}", set), folder.path().string()).out;
    EXPECT_TRUE(contains(text, " from the supply")) << text;
    EXPECT_EQ(gaitlab(fmt::format("report {}", set), folder.path().string()).out, text.substr(0, text.find("  files")));
  }
}

TEST(Supply, ARunWithoutLimitsKeepsTheVoltageOfADuty) {
  for (const double resistance : {kInside, 0.0}) {
    const std::string text = swinging("controller: {type: rc_servo, period: 0.01, gain: 4, limit: 0.1}\n", resistance);
    Scenario twin = scenario(text);
    ASSERT_TRUE(report::raise_limits(twin));
    twin.trace.columns = {"t", "joint.*"};
    const Recording limited = run(scenario(text));
    const Recording free = run(twin);
    const Table row(free.trace);
    for (std::size_t k = 1; k < free.trace.rows(); ++k) {
      const double error = row.at(k, "joint.0.setpoint") - row.at(k - 1, "joint.0.angle");
      EXPECT_NEAR(row.at(k, "joint.0.voltage_command"), 4 * error * (resistance > 0 ? kOpenCircuit : 6), 1e-9) << k;
    }
    EXPECT_GT(limited.joints.at(0).saturated_voltage, 0.3);
    EXPECT_EQ(free.joints.at(0).saturated_voltage, 0);
  }
}

}  // namespace
}  // namespace gaitlab::test
