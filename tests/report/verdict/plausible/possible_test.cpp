// Numbers that no robot can have, limits that a scenario changes, and units of currents, docks and contacts.
#include "report/verdict/plausible/plausibility.h"
#include "report/verdict/warnings.h"
#include "tests/report/verdict/verdict_case.h"

namespace gaitlab::test {
namespace {

using Sets = std::vector<std::string>;

Verdict word_of(const Scenario& s) {
  const Recording record = run(s);
  return verdict(s, record, summarise(s, record, 0), overlaps(s, record));
}

/// A pair of links that crawls on the ground. Its masses, inertias and motor are parameters.
struct Links {
  std::string mass = "0.1", inertia = {}, motor = "stall_torque: 1, no_load_speed: 10", more = {};
  [[nodiscard]] std::string text() const {
    const std::string body =
        "mass: " + mass + (inertia.empty() ? "" : fmt::format(", inertia: [{0}, {0}, {0}, 0, 0, 0]", inertia));
    return fmt::format(
        "gaitlab: 1\nrobot:\n  modules:\n    gaitlab_module: 1\n    name: link\n    bodies:\n"
        "      a: {{{0}, com: [-0.05, 0, 0], shape: [{{box: [0.1, 0.05, 0.05], origin: [-0.05, 0, 0]}}]}}\n"
        "      b: {{{0}, com: [0.05, 0, 0], shape: [{{box: [0.1, 0.05, 0.05], origin: [0.05, 0, 0]}}]}}\n"
        "    hinges: [{{name: h, parent: a, child: b, axis: [0, 0, 1], range: [-1.5, 1.5]}}]\n"
        "    contacts: {{all: shapes}}\n"
        "    actuator: {{type: servo, voltage: 12, {1}, source: sheet}}\n"
        "    controller: {{type: pid, Kp: 60, Kd: 0}}\n"
        "    may_overlap: [[a, b]]\n"
        "physics: {{engine: articulated}}\ncontact: {{on: all}}\n"
        "cpg: {{type: sine, frequency: 1, amplitude: 0.2, model: {{ramp: 1}}}}\nduration: 5\n{2}",
        body, motor, more);
  }
  [[nodiscard]] Verdict judged(const Sets& sets = {}) const { return word_of(scenario(text(), sets)); }
  [[nodiscard]] Doubts doubts(const Sets& sets = {}) const { return report::doubts(scenario(text(), sets)); }
};

void expect_refused(const Verdict& made, const std::string& reason, const std::string& row) {
  EXPECT_EQ(made.word, Word::not_judged) << made.why();
  EXPECT_TRUE(made.why().starts_with(reason)) << made.why();
  EXPECT_TRUE(made.why().ends_with("; give values that are physically possible, or accept: [" + row + "]")) << made.why();
}

/// A run has no verdict until the number is corrected or accepted. An accepted number is part of `rests_on`.
TEST(Possible, ImpossibleMomentsAreNotJudged) {
  const Links heavy{.inertia = "1", .motor = "stall_torque: 10, no_load_speed: 10"};
  expect_refused(
      heavy.judged(),
      "body 'a' of link (0.1 kg) has a moment of inertia of 1 kg m^2, as much as a ring of radius 3.2 m, but the body's "
      "extent is 0.12 m (and 1 more)",
      "moments");
  const Verdict accepted = heavy.judged({"accept=[moments]"});
  EXPECT_EQ(accepted.word, Word::feasible) << accepted.why();
  EXPECT_TRUE(accepted.rests_on.ends_with(
      "; accepted: moments (body 'a' of link (0.1 kg) has a moment of inertia of 1 kg m^2, as much as a ring of radius 3.2 m, "
      "but the body's extent is 0.12 m (and 1 more))"))
      << accepted.rests_on;
  EXPECT_EQ(Links{}.judged().word, Word::feasible);
}

TEST(Possible, LimitsOfTheRanges) {
  // The extent of 0.1 x 0.05 x 0.05 m is 0.1225 m. A mass of 0.1 kg at twice this distance has 0.1 x 0.06 = 0.006 kg m^2.
  EXPECT_EQ((Links{.inertia = "0.0059"}.doubts().refused), "");
  EXPECT_TRUE(Links{.inertia = "0.0061"}.doubts().refused.ends_with("accept: [moments]"));
  // The largest mass is 0.00025 m^3 x 23 000 kg/m^3 = 5.75 kg.
  EXPECT_EQ((Links{.mass = "5.7"}.doubts().refused), "");
  EXPECT_EQ(
      (Links{.mass = "5.8"}.doubts().refused),
      "body 'a' of link has 5.8 kg in 250 cm^3: 2.32e+04 kg/m^3, but no metal has more than 23000 kg/m^3 (and 1 more); give "
      "values that are physically possible, or accept: [density]");
  // The weight of 0.2 kg has the moment 0.416 N m over the diagonal of (0.2, 0.05, 0.05) m.
  EXPECT_EQ((Links{.motor = "stall_torque: 41.5, no_load_speed: 1"}.doubts().refused), "");
  EXPECT_EQ(
      (Links{.motor = "stall_torque: 41.8, no_load_speed: 1"}.doubts({"physics.gravity=[0, 0, -1]"}).refused),
      "the motor of m0/h has 41.8 N m at rest: 100 times the weight of the whole robot (0.2 kg) at a distance of its extent "
      "(0.212 m), but at most 100 times is possible; give values that are physically possible, or accept: [stall torque]");
  // The largest power is 0.2 kg x 1500 W/kg = 300 W = 30 N m x 40 rad/s / 4.
  EXPECT_EQ((Links{.motor = "stall_torque: 30, no_load_speed: 39.9"}.doubts().refused), "");
  EXPECT_EQ(
      (Links{.motor = "stall_torque: 30, no_load_speed: 40.1"}.doubts().refused),
      "the motors of module m0 (0.2 kg) have 301 W: 1.5e+03 W/kg, but no motor has more than 1500 W/kg; give values that are "
      "physically possible, or accept: [power]");
}

/// Shapes may be a part of a body only, and a body without shapes has the extent of its points.
TEST(Possible, BodiesThatAreLargerThanTheirShapes) {
  std::string text = Links{.mass = "5.8"}.text();
  for (std::size_t at = text.find("box: [0.1,"); at != std::string::npos; at = text.find("box: [0.1,"))
    text.replace(at, 10, "box: [0.08,");
  EXPECT_EQ(doubts(scenario(text)).refused, "") << "the hinge is 1 cm off both boxes";
  const auto bare = [](const std::string& inertia) {
    std::string bodies = Links{.inertia = inertia, .more = "accept: []\n"}.text();
    for (const char* const shape : {", shape: [{box: [0.1, 0.05, 0.05], origin: [-0.05, 0, 0]}]",
                                    ", shape: [{box: [0.1, 0.05, 0.05], origin: [0.05, 0, 0]}]"})
      bodies.replace(bodies.find(shape), std::string(shape).size(), "");
    const std::string all = "contacts: {all: shapes}";
    bodies.replace(bodies.find(all), all.size(), "contacts: {all: []}");
    return doubts(scenario(bodies)).refused;
  };
  EXPECT_EQ(bare("0.0009"), "") << "0.1 kg at 0.1 m, twice the distance of the com from the hinge: 0.001 kg m^2";
  EXPECT_TRUE(contains(bare("0.0011"), "but the body's extent is 0.05 m"));
}

/// Several rows report impossible numbers, and one is accepted. A failing check does not precede them.
TEST(Possible, ImpossibleComesBeforeInfeasible) {
  const Links wild{.inertia = "1", .motor = "stall_torque: 60, no_load_speed: 30"};
  const Sets falls{"limits.height=1", "robot.position=[0, 0, 0.3]"};
  Sets sets = falls;
  sets.emplace_back("accept=power");
  expect_refused(wild.judged(sets), "body 'a' of link (0.1 kg) has a moment of inertia of 1 kg m^2",
                 "power, moments, stall torque");
  sets.back() = "accept=[power, moments, stall torque]";
  EXPECT_EQ(wild.judged(sets).word, Word::infeasible);
}

TEST(Possible, AcceptedRowsDoNotWarn) {
  const auto warnings = [](const Links& of, const Sets& sets) { return setup_warnings(scenario(of.text(), sets)).size(); };
  const Links unusual{.inertia = "0.005"};
  EXPECT_EQ(warnings(unusual, {}), 1U);
  EXPECT_EQ(warnings(unusual, {"accept=[moments]"}), 0U);
  EXPECT_TRUE(
      contains(unusual.doubts({"accept=[moments]"}).accepted, "accepted: moments (body 'a' of link has principal moments"));
  const auto refused = [&](const Links& of, const std::string& rows) -> std::string {
    try {
      warnings(of, {"accept=" + rows});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refused(Links{}, "[density]"),
            "--set accept=[density]: error: accept names density, but no number of this row is unusual; remove it");
  EXPECT_EQ(refused(unusual, "[density, power]"),
            "--set accept=[density, power]: error: accept names density and power, but no number of these rows is unusual; the "
            "unusual numbers are those of moments");
}

/// The words of the key are the rows that have a second range.
TEST(Possible, WordsOfTheKey) {
  Sets rows;
  for (const PlausibleNumber& row : plausible_numbers()) {
    if (row.impossible != nullptr) rows.emplace_back(row.name);
  }
  EXPECT_EQ(rows, Sets(std::begin(kAcceptable), std::end(kAcceptable)));
}

TEST(Possible, ShippedScenariosAre) {
  for (const char* const name : {"caterpillar", "caterpillar-equations", "hexapod", "octopod", "pendulum", "rubble"})
    EXPECT_EQ(doubts(shipped(std::string(name) + ".yaml")).refused, "") << name;
  for (const Scenario& s : shipped_library()) EXPECT_EQ(doubts(s).refused, "") << s.name;
}

TEST(ChangedLimits, AreNamedBesideTheWord) {
  EXPECT_FALSE(contains(walk().judged().rests_on, "limits"));
  const Verdict made = Links{}.judged({"limits={torque_error: 1, tracking_error: 1000, saturated_share: 1}"});
  EXPECT_EQ(made.word, Word::feasible) << made.why();
  EXPECT_TRUE(
      made.rests_on.ends_with("; limits: tracking_error 1000 rad in the scenario, 0.1 by default; saturated_share 1 in the "
                              "scenario, 0.01 by default; torque_error 1 in the scenario, 0.05 by default"))
      << made.rests_on;
  EXPECT_FALSE(contains(Links{}.judged({"limits.tilt=1.0471975511965976"}).rests_on, "limits")) << "the default";
}

/// No limit can make a run feasible whose torques are not known.
TEST(ChangedLimits, NoRunIsFeasibleAboveTenPercent) {
  Case made = gait();
  made.scenario.limits.torque_error = 1;
  const auto with = [&](double share) {
    for (double& error : made.record.tally.torque_error) error = 0;
    made.record.tally.torque_error[2] = share * made.record.tally.torque_peak[2];
    return made.judged();
  };
  EXPECT_EQ(with(0.099).word, Word::feasible);
  const Verdict beyond = with(0.101);
  EXPECT_EQ(beyond.word, Word::not_judged);
  EXPECT_TRUE(contains(beyond.why(), "is off by about 10.1 % of its peak, more than 10 %; take physics.accuracy"))
      << beyond.why();
}

TEST(Units, ZeroStiffnessIsAnError) {
  try {
    const Scenario s = scenario(Links{.more = ""}.text(), {"contact.stiffness=0"});
    ADD_FAILURE() << s.name;
  } catch (const InputError& error) {
    EXPECT_TRUE(contains(error.what(), "stiffness is 0 N/m^k; expected more than 0")) << error.what();
  }
}

/// Tests each likely wrong unit, and similar numbers that are plausible.
TEST(Units, CurrentsDocksAndContacts) {
  const auto warned = [](const Links& of, const Sets& sets = {}) {
    std::string all;
    for (const Warning& one : setup_warnings(scenario(of.text(), sets))) all += one.text + "\n";
    return all;
  };
  EXPECT_EQ(warned({}), "");
  // The motor has k = 1.2 V s/rad and I0 = 1 / (0.7 x 1.2) = 1.19 A.
  const std::string motor = "stall_torque: 1, no_load_speed: 10, ";
  EXPECT_EQ(
      warned({.motor = motor + "i_continuous: 200"}),
      "i_continuous of m0/h is 200 A, 168 times the current that its motor draws at rest under 12 V, 1.19 A; expected less "
      "than the current at rest: is it in mA (0.2 A)?\n");
  EXPECT_EQ(warned({.motor = motor + "i_continuous: 0.5, i_max: 20"}), "");
  EXPECT_TRUE(contains(warned({.motor = motor + "i_max: 300"}),
                       "expected at most 30 times the current at rest: is it in mA "
                       "(0.3 A)?"));
  EXPECT_TRUE(
      contains(warned({}, {"contact.stiffness=10"}), "expected at most a tenth of that size: is it in N/mm (10000 N/m)?"));
  EXPECT_EQ(warned({}, {"contact.stiffness=1000"}), "");
  EXPECT_TRUE(contains(warned({}, {"contact.slip_speed=10"}),
                       "expected less than the speed of the parts: is it in mm/s (0.01 "
                       "m/s)?"));
  EXPECT_EQ(warned({}, {"contact.slip_speed=0.1"}), "");
}

TEST(Units, LoadsOfDocksAndContactElements) {
  const auto warned = [](const std::string& from, const std::string& to) {
    std::string text = Links{}.text();
    const std::string faces =
        "    faces: [{id: 0, body: b, connector: latch, gender: none, origin: [0.1, 0, 0], normal: [1, 0, 0], reference: [0, "
        "1, "
        "0]}]\n    connectors: {latch: {tension: 50, shear: 50, bending: 5, torsion: 5, source: sheet}}\n";
    text.insert(text.find("    contacts:"), faces);
    text.replace(text.find(from), from.size(), to);
    std::string all;
    for (const Warning& one : setup_warnings(scenario(text)))
      all += to_string(one.place).substr(to_string(one.place).find(':')) + one.text + "\n";
    return all;
  };
  EXPECT_EQ(warned("tension: 50", "tension: 60"), "");
  // The weight is 0.2 kg x 9.81 m/s^2 = 1.96 N, and its moment at 0.212 m is 0.416 N m.
  EXPECT_TRUE(
      contains(warned("tension: 50", "tension: 50000"),
               "tension of connector 'latch' of link is 50000 N, 2.55e+04 times the weight of the robot (0.2 kg); expected "
               "at most 1000 times that: is it in mN (50 N)?"));
  EXPECT_TRUE(contains(warned("bending: 5", "bending: 5000"),
                       "at a distance of its extent (0.212 m); expected at most 1000 times "
                       "that: is it in mN m (5 N m)?"));
  EXPECT_TRUE(
      contains(warned("all: shapes", "all: [{body: b, sphere: [0.1, 0, 0], radius: 0.06}]"),
               "the contact element m0/b/s0 of radius 0.06 m is 0.035 m below the lowest shape of the robot at the start; "
               "the largest edge of its body is 0.1 m; expected at most a quarter of that edge: is it the diameter (0.03 m)?"));
  EXPECT_EQ(warned("all: shapes", "all: [{body: b, sphere: [0.1, 0, 0], radius: 0.04}]"), "");
}

/// Numbers that a row of the list finds in a scenario.
std::vector<Finding> findings(std::string_view row, const Scenario& s) {
  return std::ranges::find(plausible_numbers(), row, &PlausibleNumber::name)->measure(Subject(s));
}

Scenario bar(const std::string& inertia, const std::string& contacts) {
  return scenario(
      fmt::format("gaitlab: 1\nrobot:\n  modules:\n    gaitlab_module: 1\n    name: bar\n    bodies:\n"
                  "      a: {{mass: 30, com: [0.6, 0, 0], inertia: [{}, 0, 0, 0]}}\n"
                  "    contacts: {{all: [{}]}}\ncontact: {{on: all}}\nduration: 1\n",
                  inertia, contacts));
}

/// A body without shapes, whose contact points are 0.3 m apart, is compared with a box of 0.3 x 0.1 x 0.1 m. Its 30 kg are 10
/// times the density of water, its centre of mass is 0.3 m outside, and its moments are 6 and 10 times those of the box. The
/// rows judge a fifth of such a rough ratio, and a hundredth of the distance over the edge.
TEST(Possible, ABodyOfPointsIsComparedWithTheirBox) {
  constexpr double kOfBox = 30.0 / 12 * (0.09 + 0.01);  // kg m^2
  const Scenario s = bar(fmt::format("{}, {}, {}", 5 * kOfBox, 6 * kOfBox, 10 * kOfBox),
                         "{body: a, point: [0, 0, 0]}, {body: a, point: [0.3, 0, 0]}");
  EXPECT_NEAR(findings("density", s).at(0).value, 2000, 1e-9);
  EXPECT_NEAR(findings("com", s).at(0).value, 0.01, 1e-12);
  EXPECT_NEAR(findings("moments", s).at(0).value, 2, 1e-12);
}

/// The penetration under a quarter of the weight is compared with the diameter of a sphere.
TEST(Possible, StiffnessIsComparedWithTheDiameterOfASphere) {
  const Scenario s = bar("1, 1, 1", "{body: a, sphere: [0, 0, 0], radius: 0.06}, {body: a, sphere: [0.3, 0, 0], radius: 0.05}");
  const double sink = std::pow(30 * 9.81 / 4 / s.contact.penalty.kn, 1 / s.contact.penalty.k);
  EXPECT_NEAR(findings("stiffness", s).at(0).value, sink / 0.12, 1e-9 * sink);
}

TEST(Possible, TheTorqueOfAMotorWithTwoConstantsIsNotKnown) {
  EXPECT_FALSE(findings("stall torque", shipped("caterpillar.yaml")).empty());
  EXPECT_TRUE(findings("stall torque", shipped("caterpillar.yaml", {"actuator.Ks=0.01"})).empty());
}

/// Tests numbers just within and just beyond the limits of rows: a tenth of a period between two rows; a range of 360 rad,
/// above which no stop is meant; and for a setting per joint, the joint with the largest angle.
TEST(Possible, LimitsOfRowsAndAngles) {
  const auto rows = [](const Sets& sets) { return implausible(scenario(Links{}.text(), sets)).rows; };
  EXPECT_EQ(std::ranges::count(rows({"trace.period=0.09"}), "trace period"), 0);
  EXPECT_EQ(std::ranges::count(rows({"trace.period=0.12"}), "trace period"), 1);
  const auto ranges = [](const char* range) {
    std::string text = Links{}.text();
    text.replace(text.find("[-1.5, 1.5]"), 11, range);
    const std::vector<Finding> all = findings("angle", scenario(text));
    return std::ranges::count_if(all, [](const Finding& one) { return one.text.starts_with("the range of hinge"); });
  };
  EXPECT_EQ(ranges("[-355, 355]"), 1);
  EXPECT_EQ(ranges("[-365, 365]"), 0);
  const std::vector<Finding> all =
      findings("angle", shipped("caterpillar.yaml", {"cpg.amplitude={m3/active: 0.9, m3/passive: 1.1, '*': 0.2}"}));
  EXPECT_EQ(std::ranges::count(all, 1.1, &Finding::value), 1);
}

/// If a key of the scenario replaces that of the module type, the warning is at the key of the scenario.
TEST(Possible, AKeyHasThePlaceWhereItIsSet) {
  const Scenario s =
      scenario(Links{.more = "actuator: {type: servo, voltage: 12, stall_torque: 5000, no_load_speed: 10}\n"}.text());
  EXPECT_EQ(findings("stall torque", s).at(0).place.line, s.place("actuator.stall_torque").line);
  EXPECT_EQ(findings("stall torque", scenario(Links{}.text())).at(0).place.line, 11);
}

}  // namespace
}  // namespace gaitlab::test
