// Implausible numbers: each is reported once, at its place, with the range and the unit that explains it, and nothing is
// reported for the library.
#include "report/verdict/plausible/plausibility.h"

#include <algorithm>

#include "report/verdict/warnings.h"
#include "tests/folders.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;

/// A snake of four modules, with every number at a separate place.
const std::string kSnakeOfBoxes = R"(gaitlab: 1
robot:
  modules:
    gaitlab_module: 1
    name: emerge
    bodies:
      body:
        mass: 0.12
        com: [-0.015, 0, 0]
        inertia: [5.408e-05, 3.604e-05, 3.604e-05, 0, 0, 0]
        shape: [{box: [0.03, 0.052, 0.052], origin: [-0.015, 0, 0]}]
      head:
        mass: 0.08
        com: [0.0235, 0, 0]
        inertia: [3.605e-05, 3.275e-05, 3.275e-05, 0, 0, 0]
        shape: [{box: [0.047, 0.052, 0.052], origin: [0.0235, 0, 0]}]
    hinges:
      - {name: hinge, parent: body, child: head, axis: [0, 1, 0], range: [-1.57, 1.57]}
    faces:
      - {id: 0, body: body, gender: none, origin: [-0.03, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]}
      - {id: 1, body: head, gender: none, origin: [0.047, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}
      - {id: 2, body: head, gender: none, origin: [0.0235, 0.026, 0], normal: [0, 1, 0], reference: [1, 0, 0]}
    contacts: {all: shapes}
    actuator:
      type: servo
      voltage: 12
      stall_torque: 1.8
      no_load_speed: 10.2
    controller: {type: pid, Kp: 50}
    may_overlap: [[body, head]]
  docks: [[0, 1, 1, 0, 0], [0, 2, 1, 1, 0], [0, 3, 1, 2, 0]]
contact: {on: all}
physics: {engine: articulated}
cpg: {type: sine, frequency: 0.5, amplitude: 0.5, phase_lag: 1.2}
duration: 8
)";

std::string replaced_in(std::string text, const std::vector<std::pair<std::string, std::string>>& changes) {
  for (const auto& [from, to] : changes) {
    EXPECT_TRUE(contains(text, from)) << from;
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  }
  return text;
}

using Replacements = std::vector<std::pair<std::string, std::string>>;

/// Warnings as `LINE:COLUMN: TEXT`, or `--set ...: TEXT`.
std::vector<std::string> odd_numbers(const Replacements& changes, const std::vector<std::string>& sets = {}) {
  const Scenario s = scenario(replaced_in(kSnakeOfBoxes, changes), sets);
  std::vector<std::string> texts;
  for (const Warning& one : setup_warnings(s)) {
    EXPECT_TRUE(one.severe) << one.text;
    texts.push_back((one.place.line > 0 ? fmt::format("{}:{}", one.place.line, one.place.column) : one.place.file) + ": " +
                    one.text);
  }
  return texts;
}

using OddTexts = std::vector<std::string>;

TEST(Plausibility, TheLibraryIsPlausible) {
  for (const Scenario& s : shipped_library()) {
    for (const Warning& one : setup_warnings(s)) ADD_FAILURE() << s.name << ": " << one.text;
  }
  EXPECT_EQ(odd_numbers({}), OddTexts());
}

TEST(Plausibility, Masses) {
  EXPECT_EQ(
      odd_numbers({{"mass: 0.08", "mass: 80"}}),
      OddTexts(
          {"13:15: body 'head' of emerge has 80 kg in 127 cm^3, which is a density of 6.29e+05 kg/m^3; expected 5 to 20000 "
           "kg/m^3, from a hollow shell to tungsten: is the mass in g (0.08 kg)?"}));
  const OddTexts both = odd_numbers({{"mass: 0.08", "mass: 80"}, {"mass: 0.12", "mass: 120"}});
  ASSERT_EQ(both.size(), 1U) << "one mistake in two bodies";
  EXPECT_TRUE(both[0].ends_with("is the mass in g (0.12 kg)? (and 1 more)")) << both[0];
  EXPECT_EQ(
      odd_numbers({{"mass: 0.08", "mass: 0.00064"}, {"[3.605e-05, 3.275e-05, 3.275e-05", "[3.605e-07, 3.275e-07, 3.275e-07"}}),
      OddTexts())
      << "5.04 kg/m^3";
  EXPECT_EQ(
      odd_numbers({{"mass: 0.08", "mass: 2.5"}, {"[3.605e-05, 3.275e-05, 3.275e-05", "[3.605e-03, 3.275e-03, 3.275e-03"}}),
      OddTexts())
      << "19672 kg/m^3";
}

TEST(Plausibility, Lengths) {
  const OddTexts found =
      odd_numbers({{"0.0235", "23.5"}, {"-0.015", "-15"}, {"0.03,", "30,"}, {"0.052", "52"}, {"0.047", "47"}, {"0.026", "26"}});
  ASSERT_EQ(found.size(), 1U) << "all lengths in mm are one mistake";
  EXPECT_TRUE(found[0].ends_with("are the lengths in mm? (and 1 more)")) << found[0];
  const OddTexts shape = odd_numbers({{"box: [0.047, 0.052, 0.052], origin: [0.0235", "box: [47, 52, 52], origin: [23.5"}});
  ASSERT_EQ(shape.size(), 1U) << "neither its com nor its inertia nor its faces are wrong";
  EXPECT_TRUE(contains(shape[0], "are the lengths in mm?")) << shape[0];
}

TEST(Plausibility, CentresOfMass) {
  const std::string outside =
      " of body 'head' of emerge is 0.0235 m outside its shapes, whose largest edge is 0.052 m; expected a point in their "
      "convex "
      "hull: ";
  EXPECT_EQ(odd_numbers({{"com: [0.0235", "com: [-0.0235"}}),
            OddTexts({"14:14: com [-0.0235, 0, 0]" + outside + "has it the wrong sign?"}));
  const OddTexts mm = odd_numbers({{"com: [0.0235", "com: [23.5"}});
  ASSERT_EQ(mm.size(), 1U);
  EXPECT_TRUE(mm[0].ends_with("is it in mm?")) << mm[0];
  EXPECT_EQ(odd_numbers({{"com: [0.0235", "com: [0.0474"}}), OddTexts()) << "0.4 mm outside, a hundredth of the largest edge";
  EXPECT_EQ(odd_numbers({{"com: [0.0235", "com: [-0.0235"}, {"mass: 0.08", "mass: 80"}}).size(), 2U) << "two mistakes";
}

TEST(Plausibility, Moments) {
  const auto with = [](const std::string& power) {
    return odd_numbers({{"[3.605e-05, 3.275e-05, 3.275e-05", "[3.605e" + power + ", 3.275e" + power + ", 3.275e" + power}});
  };
  EXPECT_EQ(with("-04"),
            OddTexts({"15:18: body 'head' of emerge has principal moments up to 0.00036 kg m^2, but at uniform density its "
                      "shapes would have up to 3.61e-05 kg m^2; expected 0.05 to 5 times the moments at uniform density"}));
  for (const auto& [power, unit] :
       {std::pair{"+04", "g mm^2"}, {"+02", "g cm^2"}, {"+01", "kg mm^2"}, {"-01", "kg cm^2"}, {"-02", "g m^2"}}) {
    const OddTexts found = with(power);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(found[0].ends_with(std::string("is it in ") + unit + "?")) << found[0];
  }
  EXPECT_EQ(with("-07").size(), 1U) << "a hundredth";
}

TEST(Plausibility, Faces) {
  EXPECT_EQ(
      odd_numbers({{"origin: [0.047, 0, 0]", "origin: [47, 0, 0]"},
                   {"docks: [[0, 1, 1, 0, 0], [0, 2, 1, 1, 0], [0, 3, 1, 2, 0]]", "docks: []"}}),
      OddTexts(
          {"21:51: face 1 of emerge is 47 m from the surface of body 'head', whose largest edge is 0.052 m; expected at most a "
           "quarter of that edge: is origin in mm?"}));
}

TEST(Plausibility, Motors) {
  EXPECT_EQ(
      odd_numbers({{"stall_torque: 1.8", "stall_torque: 18.3"}}),
      OddTexts(
          {"27:21: the stall torque of m0/hinge, 18.3 N m, holds 121 times the weight of its module (0.2 kg) at a distance of "
           "its length (0.077 m); expected at most 60 times: is it in kgf cm (1.795 N m)? (and 3 more)"}));
  const auto end = [](const std::string& from, const std::string& to) {
    const OddTexts found = odd_numbers({{from, to}});
    return found.size() == 1 ? found[0].substr(std::min(found[0].size(), found[0].rfind(": ")))
                             : fmt::format("{}", found.size());
  };
  EXPECT_EQ(end("stall_torque: 1.8", "stall_torque: 180"), ": is it in N cm (1.8 N m)? (and 3 more)");
  EXPECT_EQ(end("stall_torque: 1.8", "stall_torque: 1800"), ": is it in mN m (1.8 N m)? (and 3 more)");
  EXPECT_EQ(end("no_load_speed: 10.2", "no_load_speed: 97"), ": is it in rev/min (10.16 rad/s)? (and 3 more)") << "and not Kp";
  EXPECT_EQ(end("no_load_speed: 10.2", "no_load_speed: 600"), ": is it in degrees/s (10.47 rad/s)? (and 3 more)");
  EXPECT_EQ(end("no_load_speed: 10.2", "no_load_speed: 0.103"), ": is it in s per 60 degrees (10.17 rad/s)? (and 3 more)")
      << "and not the speed of the set points";
  EXPECT_EQ(end("stall_torque: 1.8", "stall_torque: 8.5"), ": is the torque in kgf cm (0.8336 N m)? (and 3 more)")
      << "108 W/kg, at 56 times m g L";
  EXPECT_EQ(end("stall_torque: 1.8", "stall_torque: 3.8"), "0")
      << "48 W/kg, as a servo of 82 g, 4.1 N m and 4.8 rad/s with its horn";
  EXPECT_EQ(end("voltage: 12", "voltage: 12000"), ": is it in mV? (and 3 more)");
  EXPECT_EQ(end("range: [-1.57, 1.57]", "range: free, actuator: {no_load_speed: 70, stall_torque: 0.2}, controller: {Kp: 5}"),
            "0")
      << "a wheel";
  EXPECT_EQ(end("range: [-1.57, 1.57]", "range: free, actuator: {no_load_speed: 700, stall_torque: 0.2}, controller: {Kp: 5}"),
            ": is it in rev/min (73.3 rad/s)? (and 3 more)");
}

TEST(Plausibility, SettingsOfMotors) {
  const auto with = [](const std::string& key) {
    const OddTexts found = odd_numbers({{"voltage: 12", "voltage: 12, " + key},
                                        {"actuator:\n", "actuator: {"},
                                        {"      type: servo\n      ", "type: servo, "},
                                        {"\n      stall_torque", ", stall_torque"},
                                        {"\n      no_load_speed: 10.2", ", no_load_speed: 10.2}"}});
    return found.size() == 1 ? found[0] : fmt::format("{}", found.size());
  };
  EXPECT_TRUE(contains(with("u_max: 111"),
                       "the supply of the motor of m0/hinge is 111 V, but its data are for 12 V; expected 0.3 to 3"));
  EXPECT_EQ(with("u_max: 7.4"), "0");
  // The start takes 5 kg m^2 * 10.2 rad/s / 1.8 N m = 28.3 s; with 0.0005 kg m^2 it takes 2.8 ms.
  EXPECT_TRUE(contains(with("rotor_inertia: 5"),
                       "takes 28.3 s to reach its speed; expected at most 1 s: is it in kg cm^2? (and 3 more)"));
  EXPECT_EQ(with("rotor_inertia: 0.002"), "0");
  const OddTexts gain = odd_numbers({{"Kp: 50", "Kp: -50"}});
  ASSERT_EQ(gain.size(), 1U);
  EXPECT_TRUE(gain[0].ends_with("turns away from its set point; expected 0 or more: has it the wrong sign? (and 3 more)"))
      << gain[0];
}

/// A module of 0.2 kg has two motors of 60 W/kg each.
TEST(Plausibility, PowerIsThatOfAllMotorsOfAModule) {
  const OddTexts found = odd_numbers({{"docks: [[0, 1, 1, 0, 0], [0, 2, 1, 1, 0], [0, 3, 1, 2, 0]]", "docks: []"},
                                      {"stall_torque: 1.8", "stall_torque: 4.7"},
                                      {"axis: [0, 1, 0], range: [-1.57, 1.57]}",
                                       "axis: [0, 1, 0], range: [-1.57, 1.57]}\n      - {name: tip, parent: head, child: end, "
                                       "origin: [0.047, 0, 0], axis: [0, 0, 1], "
                                       "range: [-1, 1]}"},
                                      {"    hinges:", "      end: {mass: 1e-4, shape: [{sphere: 0.005}]}\n    hinges:"}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(contains(found[0], "the 2 motors of module m0 give up to 24 W (the strongest: stall torque 4.7 N m")) << found[0];
}

TEST(Plausibility, Hinges) {
  const OddTexts found = odd_numbers({{"child: head, axis", "child: head, origin: [35, 0, 0], axis"}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0],
            "18:58: hinge 'hinge' of emerge is 35 m from the shapes of body 'body', whose largest edge is 0.052 m; expected at "
            "most four times that edge: is origin in mm?");
  const OddTexts shape = odd_numbers({{"0.052], origin: [0.0235,", "0.052], origin: [23.5,"},
                                      {"        com: [0.0235, 0, 0]\n", ""},
                                      {"        inertia: [3.605e-05, 3.275e-05, 3.275e-05, 0, 0, 0]\n", ""}});
  ASSERT_EQ(shape.size(), 1U) << "and not its faces";
  EXPECT_TRUE(
      shape[0].ends_with("from the shapes of body 'head', whose largest edge is 0.052 m; expected at most four times that "
                         "edge: are the origins of its shapes in mm?"))
      << shape[0];
  EXPECT_EQ(odd_numbers({{"child: head, axis", "child: head, origin: [0.2, 0, 0], axis"}}), OddTexts())
      << "0.2 m from a box of 0.052 m";
}

/// Bodies without shapes have the size of the box about their contact elements, faces and hinges.
TEST(Plausibility, BodiesWithoutShapes) {
  const std::vector<std::pair<std::string, std::string>> bare = {
      {"        shape: [{box: [0.03, 0.052, 0.052], origin: [-0.015, 0, 0]}]\n", ""},
      {"        shape: [{box: [0.047, 0.052, 0.052], origin: [0.0235, 0, 0]}]\n", ""},
      {"contacts: {all: shapes}", "contacts: {all: [{body: head, point: [0.047, 0.026, 0.026]}]}"}};
  const auto with = [&](const std::string& from, const std::string& to) {
    std::vector<std::pair<std::string, std::string>> changes = bare;
    changes.emplace_back(from, to);
    return odd_numbers(changes);
  };
  EXPECT_EQ(odd_numbers(bare), OddTexts());
  const OddTexts mass = with("mass: 0.08", "mass: 80");
  ASSERT_EQ(mass.size(), 1U);
  EXPECT_TRUE(contains(mass[0], "(the box about its contact elements, faces and hinges)")) << mass[0];
  EXPECT_TRUE(mass[0].ends_with("is the mass in g (0.08 kg)?")) << mass[0];
  const OddTexts com = with("com: [0.0235", "com: [23.5");
  ASSERT_EQ(com.size(), 1U);
  EXPECT_TRUE(com[0].ends_with("is it in mm?")) << com[0];
  const OddTexts inertia = with("[3.605e-05, 3.275e-05, 3.275e-05", "[3.605e+04, 3.275e+04, 3.275e+04");
  ASSERT_EQ(inertia.size(), 1U);
  EXPECT_TRUE(inertia[0].ends_with("is it in g mm^2?")) << inertia[0];
  EXPECT_EQ(with("com: [0.0235", "com: [0.09"), OddTexts()) << "a body may be larger than the box about its points";
}

/// A message does not suggest a correction that would give another implausible number.
TEST(Plausibility, QuestionsMakeSense) {
  const auto end = [](const OddTexts& found) { return found.size() == 1 ? found[0].substr(found[0].rfind("; ")) : "none"; };
  EXPECT_EQ(end(odd_numbers({}, {"robot.position=[0, 0, 0.4]"})), "; expected at most the length of that edge")
      << "0.4 mm is in the ground";
  EXPECT_EQ(odd_numbers({}, {"robot.position=[0, 0, 0.4]", "physics.gravity=[0, 0, 0]"}), OddTexts());
  EXPECT_EQ(end(odd_numbers({}, {"trace.period=0.3"})), "; expected at most a tenth of that time")
      << "0.3 ms are 7000 rows a period";
  EXPECT_EQ(end(odd_numbers({{"com: [0.0235", "com: [0.09"}})), "; expected a point in their convex hull") << "0.09 mm is 0";
}

/// Parts with the same fault and no known mistake share a warning.
TEST(Plausibility, UnexplainedPartsShareAWarning) {
  const OddTexts found = odd_numbers({{"[3.605e-05, 3.275e-05, 3.275e-05", "[3.605e-04, 3.275e-04, 3.275e-04"},
                                      {"[5.408e-05, 3.604e-05, 3.604e-05", "[5.408e-04, 3.604e-04, 3.604e-04"}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].ends_with("expected 0.05 to 5 times the moments at uniform density (and 1 more)")) << found[0];
}

TEST(Plausibility, PlaceOfAMotor) {
  const OddTexts found = odd_numbers({}, {"actuator.stall_torque=18.3"});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].starts_with("--set actuator.stall_torque=18.3: the stall torque")) << found[0];
  const OddTexts hinge = odd_numbers({{"range: [-1.57, 1.57]}", "range: [-1.57, 1.57], actuator: {stall_torque: 18.3}}"}});
  ASSERT_EQ(hinge.size(), 1U);
  EXPECT_TRUE(hinge[0].starts_with("18:")) << hinge[0];
}

TEST(Plausibility, Contacts) {
  const OddTexts found = odd_numbers({{"contacts: {all: shapes}", "contacts: {all: []}"}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(
      found[0].starts_with("32:15: contact.on is all, but no body has a contact element, so that the robot falls through the "
                           "ground; expected at least one: take contacts: {all: shapes} in "))
      << found[0];
  const OddTexts feet =
      odd_numbers({{"contacts: {all: shapes}", "contacts: {all: shapes, feet: []}"}, {"on: all", "on: feet"}});
  ASSERT_EQ(feet.size(), 1U);
  EXPECT_TRUE(feet[0].ends_with("take contact: {on: all}")) << feet[0];
  for (const char* const set : {"contact.on=none", "ground.type=none", "robot.base=fixed"})
    EXPECT_EQ(odd_numbers({{"contacts: {all: shapes}", "contacts: {all: []}"}}, {set}), OddTexts()) << set;
}

TEST(Plausibility, Sections) {
  EXPECT_EQ(odd_numbers({}, {"robot.position=[0, 0, 50]"}),
            OddTexts({"--set robot.position=[0, 0, 50]: the lowest point of the robot starts 49.97 m above the ground; the "
                      "robot's largest "
                      "edge is 0.308 m; expected at most the length of that edge: is position in mm (0.05 m)?"}));
  EXPECT_EQ(odd_numbers({}, {"robot.position=[0, 0, 0.3]"}), OddTexts());
  EXPECT_EQ(odd_numbers({}, {"ground.friction=80"}),
            OddTexts({"--set ground.friction=80: ground.friction is 80; expected at most 3 (rubber on "
                      "concrete: about 1): is it in percent (0.8)?"}));
  EXPECT_EQ(odd_numbers({}, {"trace.period=5"}),
            OddTexts({"--set trace.period=5: trace.period is 5 s, but the set points repeat every 2 s; "
                      "expected at most a tenth of that time: is it in ms (0.005 s)?"}));
  EXPECT_EQ(odd_numbers({}, {"trace.period=0.2"}), OddTexts());
  EXPECT_EQ(odd_numbers({}, {"controller.period=15", "duration=60"}),
            OddTexts({"--set controller.period=15: controller.period is 15 s; expected at most 0.5 s: is it in ms (0.015 s)?"}))
      << "and not Kp";
}

TEST(Plausibility, Angles) {
  EXPECT_EQ(odd_numbers({}, {"cpg.phase_lag=60"}),
            OddTexts({"--set cpg.phase_lag=60: cpg.phase_lag is 60 rad, 9.55 turns; expected at most two "
                      "turns: is it in degrees (1.047 rad)?"}));
  EXPECT_EQ(
      odd_numbers({{"range: [-1.57, 1.57]", "range: [-90, 90]"}}),
      OddTexts({"18:74: the range of hinge m0/hinge is 90 rad, 14.3 turns; expected at most two turns: is it in degrees (1.571 "
                "rad)? (and 3 more)"}));
}

TEST(Plausibility, SetPoints) {
  EXPECT_EQ(
      odd_numbers({}, {"cpg.amplitude=2"}),
      OddTexts({"--set cpg.amplitude=2: the set points of m0/hinge go from -2 to 2 rad, but its range from -1.57 to 1.57 rad; "
                "expected set points in the range (and 3 more)"}));
  EXPECT_EQ(odd_numbers({}, {"cpg.offset=3"}).size(), 1U);
  const OddTexts fast = odd_numbers({}, {"cpg.frequency=8"});
  ASSERT_EQ(fast.size(), 1U);
  // An amplitude of 0.5 rad at 8 Hz is 0.5 * 2 pi * 8 = 25.1 rad/s. Over 15 ms, the mean is sin(0.377) / 0.377 of this, 24.5
  // rad/s.
  EXPECT_TRUE(contains(fast[0], "move at up to 24.5 rad/s, but its motor reaches only 8.62 rad/s without load")) << fast[0];
  EXPECT_EQ(odd_numbers({{"range: [-1.57, 1.57]", "range: free"}}, {"cpg.amplitude=2"}), OddTexts()) << "without stops";
}

TEST(Plausibility, BodiesInOnePlace) {
  // Four corners to the left would put the fifth module onto the first.
  const OddTexts found = odd_numbers({{"[[0, 1, 1, 0, 0], [0, 2, 1, 1, 0], [0, 3, 1, 2, 0]]",
                                       "[[0, 1, 2, 0, 2], [0, 2, 2, 1, 2], [0, 3, 2, 2, 2], [0, 4, 2, 3, 2]]"}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0],
            "31:62: m0/head and m4/head overlap by 47 mm at the start; 2 pairs of bodies overlap; expected bodies that do not "
            "overlap: look at the docks and at initial.angles");
}

/// The texts of docs/modules.md name the rows of the list.
TEST(Plausibility, EveryRowIsInTheManual) {
  const std::string manual = read(std::string(gaitlab::test::source_folder()) + "/docs/modules.md");
  for (const PlausibleNumber& row : plausible_numbers())
    EXPECT_TRUE(contains(manual, fmt::format("| {} |", row.name))) << row.name;
}

}  // namespace
}  // namespace gaitlab::test
