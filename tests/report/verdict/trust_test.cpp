// Tests of the evidence for the numbers of a run: estimate of the torque error, warnings with their remedies, summary.
#include "report/verdict/trust.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "report/analysis/summary.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/numbers/summary_text.h"
#include "tests/folders.h"
#include "tests/labels.h"
#include "tests/report/verdict/messages.h"

namespace gaitlab::test {
namespace {

// Runs of every shipped scenario.
const Label kShippedRuns("Trust.NothingIsSaidOfShippedScenarios", "long;unsanitized");

const Label kLongTrust("Trust.AnActuatorThatAnImplicitStepCannotSolveIsNeverSilent", "long");

using namespace report;

nlohmann::json summary_of(const Scenario& s) {
  const Recording r = run(s);
  return nlohmann::json::parse(to_json(summarise(s, r, 1), s, r));
}

/// Run of 1 s without defects: two joints with torque peaks of 1 and 0.01 N m, and 10 J of electrical energy.
struct Doubts : testing::Test {
  Doubts() {
    r.joints.resize(s.robot->joints.size());
    r.simulated = 1;
    r.tally.estimated = true;
    r.tally.torque_error.assign(r.joints.size(), 0.0);
    r.tally.torque_peak.assign(r.joints.size(), 0.0);
    r.tally.torque_peak[0] = 1;
    r.tally.torque_peak[1] = 0.01;
    r.tally.chaotic.share = 1e-12;
    r.ledger.electrical = r.ledger.copper = 10;
  }
  [[nodiscard]] static Scenario hexapod(const std::vector<std::string>& sets) { return shipped("hexapod.yaml", sets); }
  [[nodiscard]] std::string only() const {
    const std::vector<std::string> warnings = messages(s, r, About::accuracy);
    return warnings.size() == 1 ? warnings[0] : fmt::format("{} warnings", warnings.size());
  }
  Scenario s = hexapod({"physics.engine=articulated"});
  Recording r;
};

TEST_F(Doubts, AreNoneWhereNothingIsWrong) { EXPECT_EQ(only(), "0 warnings"); }

TEST_F(Doubts, NameTheJointWhoseTorqueIsOff) {
  r.tally.torque_error[0] = 0.0099;
  EXPECT_EQ(only(), "0 warnings");
  r.tally.torque_error[0] = 0.0201;
  EXPECT_EQ(only(),
            "the torque of joint m0/active is off by about 2 % of its peak, estimated by comparison with other step lengths; "
            "take physics.accuracy: 0.002");
  r.tally.torque_error[1] = 0.001;  // the peak of a joint counts as at least 2 % of the largest peak
  EXPECT_EQ(only(),
            "the torque of joint m0/passive is off by about 5 % of its peak, estimated by comparison with other step lengths; "
            "take physics.accuracy: 0.001");
  r.tally.estimated = false;
  EXPECT_EQ(only(), "0 warnings");
}

TEST_F(Doubts, BeginAtTheAccuracyThatTheScenarioRequests) {
  s = hexapod({"physics.engine=articulated", "physics.accuracy=0.001"});
  r.tally.torque_error[0] = 0.00099;
  EXPECT_EQ(only(), "0 warnings");
  r.tally.torque_error[0] = 0.004;
  EXPECT_TRUE(contains(only(),
                       "off by about 0.4 % of its peak, estimated by comparison with other step lengths; take "
                       "physics.accuracy: 0.0001"))
      << only();
  s = hexapod({"physics.engine=articulated", "physics.accuracy=0.1"});
  r.tally.torque_error[0] = 0.04;
  EXPECT_EQ(only(), "0 warnings");
}

TEST_F(Doubts, NameAMotionThatNobodyCanPredict) {
  r.tally.chaotic.share = 0;
  EXPECT_EQ(predictability(s, r), Predictability::unknown) << "gravity changes no torque, which shows nothing";
  EXPECT_EQ(predictability_text(s, r), "not tested: a disturbed gravity changes no torque of this robot");
  r.tally.chaotic.share = 1e-12;
  r.tally.ill.share = 0.01;  // the limit of the torque error
  EXPECT_EQ(predictability(s, r), Predictability::predictable);
  r.tally.ill = {0.5, 1, 0.0101};
  EXPECT_EQ(predictability(s, r), Predictability::ill);
  EXPECT_EQ(
      only(),
      "from t = 0.5 s on (joint m0/passive) the motion is ill-conditioned: gravity times 1 + 1e-6 changes the torques by "
      "about 1 % of their peak (in proportion to 1 + 1e-9); judge several runs with other seeds or starts; a smaller step does "
      "not help");
  r.tally.chaotic = {0.75, 0, 0.01};
  EXPECT_EQ(predictability(s, r), Predictability::ill);
  r.tally.chaotic.share = 0.0101;
  EXPECT_EQ(predictability(s, r), Predictability::chaotic);
  s = hexapod({"physics.engine=articulated", "physics.step=1e-3"});
  EXPECT_EQ(predictability(s, r), Predictability::unknown) << "a given step has a twin alone";
}

TEST_F(Doubts, OfferAStepThatFits) {
  r.tally.torque_error[0] = 0.04;
  s = hexapod({"physics.engine=articulated", "physics.step=1e-3"});
  EXPECT_EQ(s.physics.integrator->name, "implicit");
  // With order 1, an error of half of 1 % requires an eighth of the step of 1 ms. All periods are multiples of 0.125 ms.
  EXPECT_EQ(only(),
            "the torque of joint m0/active is off by about 4 % of its peak, estimated by comparison with other step lengths in "
            "windows of the run; `gaitlab converge` compares whole runs; "
            "take physics.step: "
            "0.000125, or physics.integrator: adaptive without a step");
  s = hexapod({"physics.engine=articulated", "physics.integrator=extrapolated", "physics.step=1e-3"});
  EXPECT_TRUE(contains(only(), "; take physics.step: 0.00025, or")) << only();  // order 2 requires 1 ms / sqrt(8) = 0.35 ms
  s = hexapod({"physics.step=2.5e-5"});
  EXPECT_TRUE(contains(only(), "; take physics.step: 2.5e-06")) << only();  // an eighth of the step is 3.1 us
  EXPECT_TRUE(contains(only(), "or physics.integrator: adaptive without a step")) << only();
}

TEST_F(Doubts, AllowTheAccuracyThatWasAskedFor) {
  s = hexapod({"physics.engine=articulated", "physics.accuracy=0.05"});
  r.tally.torque_error[0] = 0.049;
  EXPECT_EQ(only(), "0 warnings");
  r.tally.torque_error[0] = 0.051;
  EXPECT_TRUE(contains(only(), "take physics.accuracy: 0.004")) << only();
  s = hexapod({"physics.engine=articulated", "physics.accuracy=0.001"});
  r.tally.torque_error[0] = 0.0009;
  EXPECT_EQ(only(), "0 warnings");
  r.tally.torque_error[0] = 0.009;
  EXPECT_TRUE(contains(only(), "take physics.accuracy: 5e-05")) << only();
}

TEST_F(Doubts, SayWhatEnergyIsMissing) {
  r.ledger.electrical = 10.09;
  EXPECT_EQ(only(), "0 warnings");
  for (const double missing : {0.2, -0.2}) {
    r.ledger.electrical = r.ledger.copper + missing;
    EXPECT_EQ(only(), fmt::format("{:.3g} % of the energy is unaccounted for: 0.2 J, of {:.3g} J drawn; take a smaller "
                                  "physics.accuracy",
                                  20 / r.ledger.electrical, r.ledger.electrical));
  }
  s = hexapod({"physics.step=2.5e-5"});
  EXPECT_TRUE(contains(only(), "take a smaller physics.step")) << only();
}

TEST_F(Doubts, NameWhatIsNotFinite) {
  EXPECT_TRUE(not_finite(s, r).empty());
  r.ledger.gear = std::numeric_limits<double>::infinity();
  r.joints[1].torque_rms = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(not_finite(s, r), (std::vector<std::string>{"energy.gear", "torque_rms of m0/passive"}));
  EXPECT_EQ(texts::without_nan("RMS -nan N m; nan, inf and (nan %)\n"), "RMS    - N m;   -,   - and (  - %)\n");
  EXPECT_EQ(texts::without_nan("nancy: inf/x 1"), "nancy: inf/x 1");
}

TEST_F(Doubts, SayWhatIsOffItsLaw) {
  r.tally.off = 3;
  EXPECT_EQ(only(),
            "3 joint-steps do not satisfy the law of their motor or end stop: their torques are wrong; the torque of the "
            "actuator must "
            "fall with the joint's speed");
}

TEST_F(Doubts, SayWhereTheShortestStepsWereTooLong) {
  r.tally.coarse = 0.09;
  EXPECT_EQ(only(), "0 warnings");
  r.tally.coarse = 0.12;
  EXPECT_TRUE(contains(only(), "in 12 % of the time the shortest steps of the integrator did not reach the accuracy 1 %"))
      << only();
}

TEST(Trust, AStepThatIsTooLongIsSaidAndItsRemedyHelps) {
  const std::string gait = "' --quiet --set duration=0.75 --set physics.engine=articulated";
  const Folder folder;
  const auto warnings = [&](const std::string& more, const std::string& out) {
    const Result r = gaitlab("run '" + kScenarios + "hexapod.yaml" + gait + more + " --out " + out, folder / "");
    EXPECT_EQ(r.code, 0) << r.err;
    return r.err;
  };
  const std::string said = warnings(" --set physics.step=5e-3", "long");
  EXPECT_TRUE(contains(said, "--set physics.step=5e-3: warning: the torque of joint m")) << said;
  const std::size_t from = said.find("physics.step: ");
  ASSERT_NE(from, std::string::npos) << said;
  EXPECT_TRUE(contains(said, ", or physics.integrator: adaptive without a step\n")) << said;
  const std::string remedy = said.substr(from + 14, said.find(',', from) - from - 14);
  const auto error = [&](const std::string& run) {
    return nlohmann::json::parse(read(folder / (run + "/summary.json"))).at("torque_error").at("worst").get<double>();
  };
  warnings(" --set physics.step=" + remedy, "short");
  EXPECT_LT(error("short"), error("long") / 2);  // generous, because errors at impacts do not halve with the step
  EXPECT_EQ(warnings(" --set physics.integrator=adaptive --set duration=2.5", "adaptive"), "");
}

/// Shipped scenarios have no warnings; otherwise users would learn to ignore warnings.
TEST(Trust, NothingIsSaidOfShippedScenarios) {
  for (const char* engine : {"articulated", "bullet"}) {
    for (const auto& file : std::filesystem::directory_iterator(kScenarios)) {
      if (file.path().extension() != ".yaml") continue;
      // In engine bullet only 0.6 s of each scenario are tested, because its steps take too long.
      std::vector<std::string> sets{std::string("physics.engine=") + engine};
      if (sets[0] == "physics.engine=bullet") sets.emplace_back("duration=0.6");
      if (sets.size() > 1 && shipped(file.path().filename()).physics.adapts()) continue;  // requires engine articulated
      const Scenario s = shipped(file.path().filename(), sets);
      const Recording r = run(s);
      for (const std::string& warning : messages(s, r, About::accuracy)) {
        if (contains(warning, "% of the control ticks; step ")) continue;  // in bullet, rubble.yaml has stiff contacts
        ADD_FAILURE() << engine << ", " << s.name << ": " << warning;
      }
      EXPECT_EQ(r.tally.off, 0) << s.name;
      EXPECT_EQ(r.tally.estimated, s.actuator.entry != nullptr) << s.name;
    }
  }
}

TEST(Trust, TheSummarySaysHowItWasStepped) {
  const auto json = summary_of(shipped("hexapod.yaml", {"physics.engine=articulated", "duration=0.3"}));
  EXPECT_EQ(json.at("step"), 0.005);
  EXPECT_EQ(json.at("step_setting"), "auto");
  EXPECT_EQ(json.at("integrator"), "adaptive");
  EXPECT_EQ(json.at("accuracy"), 0.01);
  EXPECT_GT(json.at("solves"), 60 * 3);  // order 2 requires at least three solves in each of 60 steps
  EXPECT_EQ(json.at("off_law"), 0);
  EXPECT_GT(json.at("torque_error").at("worst"), 0);
  EXPECT_EQ(json.at("torque_error").at("per_joint").size(), 22U);
  const std::string joint = json.at("torque_error").at("joint");
  EXPECT_GT(json.at("torque_error").at("per_joint").at(joint), 0);

  const auto fixed = summary_of(shipped("hexapod.yaml", {"physics.engine=articulated", "physics.step=1e-3", "duration=0.3"}));
  EXPECT_EQ(fixed.at("step"), 0.001);
  EXPECT_EQ(fixed.at("step_setting"), 0.001);
  EXPECT_EQ(fixed.at("integrator"), "implicit");
  EXPECT_TRUE(fixed.at("accuracy").is_null());

  const auto bullet = summary_of(shipped("hexapod.yaml", {"physics.integrator=semi_implicit", "duration=0.3"}));
  EXPECT_EQ(bullet.at("step_setting"), 2.5e-5);
  EXPECT_EQ(bullet.at("solves"), 0);  // an explicit integrator solves nothing
  EXPECT_GT(bullet.at("torque_error").at("worst"), 0);
}

/// The columns torque_error.* and steps.* contain the numbers of the summary for the time up to the row.
TEST(Trust, ColumnsGrowIntoTheSummary) {
  const Scenario s = shipped("hexapod.yaml", {"physics.engine=articulated", "physics.step=5e-3", "duration=0.6",
                                              "trace.columns=['torque_error.*', 'steps.*']"});
  const Recording r = run(s);
  const Table table(r.trace);
  const std::size_t last = r.trace.rows() - 1;
  EXPECT_EQ(table.at(last, "steps.solves"), r.tally.solves);
  EXPECT_EQ(table.at(last, "steps.off"), 0);
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    EXPECT_EQ(table.at(last, fmt::format("torque_error.{}", j)), r.tally.torque_error[j]);
    EXPECT_EQ(table.at(0, fmt::format("torque_error.{}", j)), 0);
  }
  for (std::size_t k = 1; k <= last; ++k) EXPECT_GT(table.at(k, "steps.solves"), table.at(k - 1, "steps.solves"));
}

/// The torque error is not relative to a peak at the start, which may be much larger than all later torques.
TEST(Trust, AnErrorIsRelativeToTheTorquesOfTheWholeRun) {
  const Recording r = run(scenario(
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]], base: fixed, on_ground: false}\nground: {type: none}\n"
      "contact: {on: none}\nphysics: {engine: articulated, gravity: [0, 0, 0]}\ninitial: {angles: 0.02}\n"
      "cpg: {type: sine, frequency: 0, amplitude: 0}\nduration: 0.3\n"));
  // The last joint hardly moves and reaches its set point after some milliseconds. At t = 0 its motor has 2 V, which is 0.76 N
  // m at rest. From 5 ms on, where the error is estimated, its torque is 0.015 N m.
  EXPECT_GT(r.joints[3].torque_peak, 0.4);
  EXPECT_GT(r.tally.torque_peak[3], 0.001);
  EXPECT_LT(r.tally.torque_peak[3], 0.1);
}

/// The torque of an ideal source does not depend on the speed. If its command does not depend on the motion either, equal
/// torques of two runs are no evidence. With a control loop, the torques depend on the steps.
TEST(Trust, TorqueSourcesAreEstimatedByTheirCommands) {
  const std::string text =
      "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nactuator: {type: torque, limit: 1.9}\n"
      "cpg: {type: sine, frequency: 0.5, amplitude: 0.4}\nduration: 0.6\n";
  for (const char* engine : {"articulated", "bullet"}) {
    for (const char* gains : {"Kp: 0, Ki: 0, Kd: 0", "Kp: 5, Kd: 0.05"}) {
      const Scenario s = scenario(text + fmt::format("controller: {{type: pid, unit: N m, {}}}\n", gains),
                                  {std::string("physics.engine=") + engine});
      const Recording r = run(s);
      const bool nothing = contains(gains, "Kp: 0,");
      EXPECT_EQ(contains(steps_text(s, r), "; torque error not estimated"), nothing) << steps_text(s, r);
      const auto json = nlohmann::json::parse(to_json(summarise(s, r, 1), s, r));
      EXPECT_EQ(json.at("torque_error").is_null(), nothing);
    }
  }
}

/// The program warns of actuators that an implicit step cannot solve. If the torque increases with the speed, the step has many
/// solutions; with dry friction it has none while the joint sticks.
TEST(Trust, AnActuatorThatAnImplicitStepCannotSolveIsNeverSilent) {
  const Folder folder;
  std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
  folder.write("rises.yaml",
               "gaitlab: 1\nplugins: [" + std::string(gaitlab::test::build_folder()) +
                   "/plugins/rises.so]\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]], base: fixed, on_ground: "
                   "false}\nground: {type: none}\ncontact: {on: none}\nphysics: {engine: articulated}\n"
                   "actuator: {type: rises}\ncontroller: {type: pid, unit: N m, Kp: 0.5, Ki: 0, Kd: 0}\n"
                   "cpg: {type: sine, frequency: 0.5, amplitude: 0.4}\nduration: 0.3\n");
  int runs = 0;
  const auto said = [&](const std::string& sets) {
    return gaitlab(fmt::format("run rises.yaml --quiet --out out{}{}", ++runs, sets), folder / "").err;
  };
  for (const char* rise : {"0.05", "1", "10"}) {
    for (const char* steps : {"integrator=implicit", "step=5e-3", "integrator=extrapolated", "step=auto"}) {
      const std::string text = said(fmt::format(" --set actuator.rise={} --set physics.{}", rise, steps));
      EXPECT_TRUE(contains(text, "warning: the torque of joint m") || contains(text, "error: diverged at step ") ||
                  contains(text, "did not reach the accuracy 1 %"))
          << rise << " " << steps << ": " << text;
    }
  }
  const std::string text = said(" --set actuator.dry=0.1 --set physics.step=5e-3 --set duration=0.05");
  EXPECT_TRUE(contains(text, " joint-steps do not satisfy the law of their motor or end stop: their torques are wrong"))
      << text;
  const auto json = nlohmann::json::parse(read(folder / fmt::format("out{}/summary.json", runs)));
  EXPECT_GT(json.at("off_law"), 0);
  EXPECT_FALSE(contains(said(" --set actuator.rise=-0.05"), " joint-steps do not satisfy"));  // torque decreases with the speed
}

}  // namespace
}  // namespace gaitlab::test
