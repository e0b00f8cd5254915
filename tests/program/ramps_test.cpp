// Ramps of gaits scale the motion about the pose in which it begins, and the robot starts in this pose.
#include <cmath>

#include "core/plugin/plugin_instance.h"
#include "core/scenario/resolved.h"
#include "core/simulation/start.h"
#include "report/analysis/summary.h"
#include "report/verdict/verdict.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

const std::string kTwoBlocks =
    "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\ncontact: {on: all}\nphysics: {engine: articulated}\n"
    "duration: 0.05\n";

constexpr double kFirstStep = 1e-3;  // rad; a joint moves less in the first step, which the jump includes

/// A gait whose first pose is `first` in every joint, without and with a ramp of 2 s.
struct RampedGait {
  const char* name;
  const char* cpg;  ///< `@` stands for further keys of `model`
  double first = 0;
};
const RampedGait kRamped[] = {
    {"sine", "cpg: {type: sine, frequency: 0.7, amplitude: 0.3, offset: 0.6, phase_lag: 1.1, model: {@}}\n", 0.6},
    {"keyframes",
     "cpg: {type: keyframes, model: {frames: [{time: 0, angles: -0.4}, {time: 0.5, angles: [0.2, 0.3, -1, 0]}, "
     "{time: 1.5, angles: -0.4}], @}}\n",
     -0.4},
    {"keyframes, once",
     "cpg: {type: keyframes, model: {repeat: false, interpolation: linear, frames: [{time: 0, angles: 0.5}, "
     "{time: 3, angles: 1}], @}}\n",
     0.5},
    {"table",
     "cpg: {type: table, model: {@, file: \"time, m0/active, m0/passive, m1/active, m1/passive\\n0, 0.2, 0.2, 0.2, 0.2\\n"
     "0.4, 1, 0, -1, 0.3\\n1, 0.2, 0.2, 0.2, 0.2\\n\"}}\n",
     0.2},
};

std::string with_keys(const RampedGait& gait, const std::string& keys) {
  std::string text = gait.cpg;
  return kTwoBlocks + text.replace(text.find('@'), 1, keys);
}

std::vector<double> set_points_at(const Scenario& s, double t) {
  std::vector<double> found(s.robot->joints.size());
  make_cpg(s.cpg, info(*s.robot))->output(t, {}, found);
  return found;
}

/// A ramp scales the distance from the first pose. After the ramp, the set points have the bits of the gait without a ramp.
TEST(Ramps, ScaleTheMotionAboutItsFirstPose) {
  for (const RampedGait& gait : kRamped) {
    const Scenario plain = scenario(with_keys(gait, "ramp: 0"));
    const Scenario ramped = scenario(with_keys(gait, "ramp: 2"));
    for (const double t : {0.0, 0.3, 1.7, 2.0, 5.3}) {
      const std::vector<double> full = set_points_at(plain, t);
      const std::vector<double> found = set_points_at(ramped, t);
      for (std::size_t j = 0; j < full.size(); ++j) {
        const double expected = t < 2 ? gait.first + t / 2 * (full[j] - gait.first) : full[j];
        // The rounding error of sums of numbers near 1 is at most 1e-15.
        EXPECT_NEAR(found[j], expected, t < 2 ? 1e-15 : 0) << gait.name << ", " << t;
      }
    }
  }
}

/// Without initial.angles, a robot whose gait has a ramp starts in the first pose, and its resolved scenario states it.
TEST(Ramps, StartTheRobotInTheFirstPose) {
  const Folder folder;
  for (const RampedGait& gait : kRamped) {
    const std::vector<double> pose(4, gait.first);
    const Scenario s = scenario(with_keys(gait, "ramp: 2"));
    EXPECT_EQ(start_state(s).q, pose) << gait.name;
    EXPECT_LT(run(s).joints[2].start_jump, kFirstStep) << gait.name;
    EXPECT_EQ(start_state(read_scenario(folder.write("again.yaml", resolved(s)), {}, catalog())).q, pose) << gait.name;
    EXPECT_EQ(start_state(scenario(with_keys(gait, "ramp: 0"))).q, std::vector<double>(4, 0.0)) << gait.name;
    const Scenario stated = scenario(with_keys(gait, "ramp: 2") + "initial: {angles: {m1/active: 0.1}}\n");
    EXPECT_EQ(start_state(stated).q, (std::vector<double>{0, 0, 0.1, 0})) << gait.name;
  }
}

/// The pose follows settings of rollouts. Ranges of hinges bound it, and hinges without a motor keep 0.
TEST(Ramps, StartFollowsSettings) {
  const Folder folder;
  const std::string file = folder.write("s.yaml", with_keys(kRamped[0], "ramp: 2"));
  const ScenarioTemplate from(file, {"initial.speeds=0"}, catalog());
  const auto first = [&](const std::vector<std::string>& sets) { return start_state(from.with(sets)).q[1]; };
  EXPECT_EQ(first({}), 0.6);
  EXPECT_EQ(first({"cpg.offset=0.2"}), 0.2);
  EXPECT_EQ(first({"initial.speeds=0.1"}), 0.6);
  EXPECT_EQ(first({"initial.angles=0.3"}), 0.3);
  EXPECT_EQ(first({"initial.angles=0.3", "cpg.offset=0.2"}), 0.3);
  EXPECT_EQ(first({"cpg.model.ramp=0"}), 0);
  EXPECT_EQ(first({"cpg.offset=2"}), from.with({}).robot->joints[1].hi);
  for (const char* shipped_file : {"hexapod.yaml", "library/y1-snake.yaml"})
    EXPECT_EQ(shipped(shipped_file).initial.angles, PerJoint{}) << shipped_file;
}

/// A robot that stands on straight legs turned by 0.6 rad stays in place. This requires a start at the offsets.
TEST(Ramps, AStandingRobotStaysUp) {
  const std::string leg = "mass: 0.1, shape: [{box: [0.02, 0.02, 0.1], origin: [0, 0, -0.05]}]";
  std::string bodies, hinges;
  for (const auto& [name, x, y] : {std::tuple("a", 0.09, 0.09), std::tuple("b", 0.09, -0.09), std::tuple("c", -0.09, 0.0)}) {
    bodies += fmt::format("      {}: {{{}}}\n", name, leg);
    hinges +=
        fmt::format("      - {{name: h{0}, parent: top, child: {0}, origin: [{1}, {2}, 0], axis: [0, 1, 0], range: [-1, 1]}}\n",
                    name, x, y);
  }
  const Scenario s = scenario(
      "gaitlab: 1\nrobot:\n  modules:\n    gaitlab_module: 1\n    name: stool\n    bodies:\n"
      "      top: {mass: 1, shape: [{box: [0.2, 0.2, 0.04]}]}\n" +
      bodies + "    hinges:\n" + hinges +
      "    contacts: {all: shapes}\n"
      "    actuator: {type: servo, voltage: 6, stall_torque: 1, no_load_speed: 6, source: chosen}\n"
      "    controller: {type: pid, Kp: 40, Kd: 0}\n"
      "physics: {engine: articulated}\ncontact: {on: all, stiffness: 20000, damping: 200000}\ninitial: {angles: 0.6}\n"
      "cpg: {type: sine, frequency: 0.5, amplitude: 0.05, offset: 0.6, phase_lag: 0, model: {ramp: 0.5}}\nduration: 1\n");
  const Recording r = run(s);
  for (const JointStatistics& joint : r.joints) EXPECT_LT(joint.start_jump, kFirstStep);
  const Table rows(r.trace);
  // The gait itself lifts and lowers the hips by at most 0.1 m (cos 0.55 - cos 0.65) = 6 mm.
  EXPECT_NEAR(rows.at(60, "base.z"), rows.at(0, "base.z"), 0.01);
}

std::string advice_on_jump(const std::string& gait, const std::vector<std::string>& sets = {}) {
  const Scenario s = scenario(kTwoBlocks + gait, sets);
  const Recording r = run(s);
  const report::Verdict v = report::verdict(s, r, report::summarise(s, r, 1), report::overlaps(s, r));
  for (const report::Check& check : v.checks) {
    if (check.id == std::string("start")) return check.remedy;
  }
  return "no check";
}

/// The advice states the first set points, limited to the ranges of the hinges, so that a robot can start there.
TEST(Ramps, AdviceOnAJumpIsAListToCopy) {
  const std::string sine = "cpg: {type: sine, frequency: 1, amplitude: 0.1, phase_lag: 1.2, offset: 0.8}\n";
  const std::string list = "set initial.angles: [0.8, 0.8932, 0.8675, 0.7557]";
  EXPECT_EQ(advice_on_jump(sine), list + ", or cpg.model.ramp");
  EXPECT_EQ(advice_on_jump(sine, {"initial.angles=0.2"}), list);
  EXPECT_EQ(advice_on_jump(sine, {"initial.angles=0.2", "cpg.model.ramp=1"}), "set initial.angles: 0.8");
  EXPECT_EQ(advice_on_jump(sine, {"cpg.type=hopf"}), "set initial.angles: [0.8, 0.8009, 0.8007, 0.7996]");
  EXPECT_EQ(advice_on_jump(sine, {"initial.angles=[0.8, 0.8932, 0.8675, 0.7557]"}), "");
  EXPECT_EQ(advice_on_jump(sine, {"cpg.offset=2"}), "set initial.angles: 1.5707963267948966, or cpg.model.ramp");
}

}  // namespace
}  // namespace gaitlab::test
