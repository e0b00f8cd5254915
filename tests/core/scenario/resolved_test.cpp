// Tests of resolved scenarios and of the manuals.
#include "core/scenario/resolved.h"

#include <gtest/gtest.h>

#include "core/scenario/manual.h"
#include "tests/core/scenario/fixture.h"

namespace gaitlab {
namespace {

using fakes::kTwo;

struct ResolvedTest : fakes::ScenarioTest {};

TEST_F(ResolvedTest, SaysEverythingAndIsItself) {
  const Scenario s = read("name: full\n" + kTwo +
                          "cpg:\n  type: hopf\n  amplitude: {default: 0.5, m1/h: 0.25}\n  couplings: [{from: 0, to: m1/h}]\n"
                          "initial: {angles: [0.1, -0.1]}\nactuator: {R: [4, 5]}\n");
  expect_stable(s);
  EXPECT_EQ(resolved(s),
            "gaitlab: 1\n"
            "name: full\n"
            "plugins: []\n"
            "robot:\n"
            "  types:\n"
            "    duo:\n"
            "      gaitlab_module: 1\n"
            "      name: duo\n"
            "      bodies:\n"
            "        a: {mass: 1, inertia: [1, 1, 1, 0, 0, 0], source: \"chosen: a, b\"}\n"
            "        b:\n"
            "          mass: 0.5\n"
            "          com: [0.1, 0, 0]\n"
            "          inertia: [1, 2, 2, 0, 0, 0]\n"
            "          shape:\n"
            "            - {box: [0.1, 0.1, 0.1]}\n"
            "      hinges:\n"
            "        - {name: h, parent: a, child: b, origin: [0.05, 0, 0], axis: [0, 2, 0], range: [-1.5, 1.5]}\n"
            "      faces:\n"
            "        - {id: 1, body: a, gender: active, origin: [0, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]}\n"
            "        - {id: 4, body: b, gender: passive, origin: [0.1, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}\n"
            "      contacts:\n"
            "        feet: [{body: b, point: [0.1, 0, -0.1]}]\n"
            "        all: [{body: a, sphere: [0, 0, 0], radius: 0.1}]\n"
            "  modules: duo\n"
            "  docks:\n"
            "    - [1, 1, 4, 0, 0]\n"
            "  base: floating\n"
            "  on_ground: true\n"
            "  orientation: [0, 0, 0]\n"
            "initial:\n"
            "  angles: [0.1, -0.1]\n"
            "  speeds: 0\n"
            "  base_velocity: [0, 0, 0]\n"
            "  base_angular_velocity: [0, 0, 0]\n"
            "physics:\n"
            "  engine: bullet\n"
            "  step: 2.5e-05\n"
            "  integrator: semi_implicit\n"
            "  gravity: [0, 0, -9.81]\n"
            "ground:\n"
            "  type: plane\n"
            "  friction: 0.8\n"
            "contact:\n"
            "  law: penalty\n"
            "  on: feet\n"
            "  stiffness: 10000\n"
            "  exponent: 1\n"
            "  damping: 100000\n"
            "  damping_exponent: 1\n"
            "  slip_speed: 0.01\n"
            "actuator:\n"
            "  type: dc_motor\n"
            "  R: [4, 5]\n"
            "  i_max: 1.2\n"
            "controller:\n"
            "  type: pid\n"
            "  period: 0.015\n"
            "  Kp: 100\n"
            "  anti_windup: true\n"
            "cpg:\n"
            "  type: hopf\n"
            "  step: 0.015\n"
            "  frequency: 0.25\n"
            "  amplitude: [0.5, 0.25]\n"
            "  couplings:\n"
            "    - {from: m0/h, to: m1/h, weight: 1}\n"
            "  model:\n"
            "    mu: 1\n"
            "  table: []\n"
            "  labels: [\"a b\", \"5\"]\n"
            "  expression: \"x + 1\"\n"
            "duration: 1\n"
            "trace:\n"
            "  period: 0.005\n"
            "  columns: [joint.*, base.*, com.*]\n"
            "seed: 1\n"
            "sensors: []\n");
}

/// A reader of YAML 1.1, as PyYAML, takes more texts for numbers, dates and flags than this one.
TEST_F(ResolvedTest, TextsThatOtherReadersTakeForSomethingElseAreQuoted) {
  for (const std::string name : {"0x10", "0o7", "0b1", "010", "1_000", "1e400", "5", "1.5", "2026-01-02", "1.2.3", "inf", "NaN",
                                 "yes", "No", "ON", "off", "True", "null", "y"}) {
    const Scenario s = read(fakes::kShort + "name: '" + name + "'\n");
    EXPECT_NE(resolved(s).find("\nname: \"" + name + "\"\n"), std::string::npos) << name;
    expect_stable(s);
  }
  for (const std::string name : {"walk", "x10", "m0", "a-1", "e5", "none", "yesterday", "2-steps"})
    EXPECT_NE(resolved(read(fakes::kShort + "name: '" + name + "'\n")).find("\nname: " + name + "\n"), std::string::npos)
        << name;
}

TEST_F(ResolvedTest, ExplainNamesEveryKey) {
  const std::string text = explain_scenario(catalog_);
  for (const char* key : {"gaitlab:", "\nrobot:\n", "\n    modules:", "\n    on_ground:", "\n    gravity (m/s^2):",
                          "\n    slip_speed (m/s):", "\ncontroller:\n", "\nduration (s):", "\n    columns:"}) {
    EXPECT_NE(text.find(key), std::string::npos) << key;
  }
  const Entry& pid = *catalog_.find(Kind::controller, "pid");
  EXPECT_EQ(explain_plugin(pid),
            "A controller.\n\n"
            "Kp (V/rad): default 100; 0 to 1000000\n    Gain.\n"
            "anti_windup: default true; true | false\n    Hold the integral at the limit.\n");
  EXPECT_EQ(explain_plugin(*catalog_.find(Kind::controller, "hold")), "Holds.\n");
}

}  // namespace
}  // namespace gaitlab
