// Engine articulated with default settings against engine bullet at a short step: motors at their limits, and ground so stiff
// that contacts chatter.
#include <cmath>

#include "report/verdict/trust.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"
#include "tests/program/torque_error.h"
#include "tests/report/verdict/messages.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

// Fine runs of bullet.
const Label kFineRuns("Motors/Limits.*", "long;unsanitized");

const Label kLongLimits("StiffGround.MakesNoEnergyAndTheRobotWalksAsFar", "long");

double at_limit(const JointStatistics& joint) { return joint.saturated_voltage + joint.saturated_current; }

/// Share of time at a limit, mean of all joints.
double at_limit(const Recording& record) {
  double sum = 0;
  for (const JointStatistics& joint : record.joints) sum += at_limit(joint) / static_cast<double>(record.joints.size());
  return sum;
}

double outside_range(const Recording& record) {
  double most = 0;
  for (const JointStatistics& joint : record.joints) most = std::max(most, joint.range_share);
  return most;
}

double travel(const Recording& r) { return r.travel().head<2>().norm(); }

/// Step of engine bullet, s. With half of this step, results change by at most 0.03 % of a torque's peak, 0.02 percentage
/// points of time, and 0.02 % of energy. The method has order 1, so that errors at 10 us are about twice these changes. The
/// changes are a thirtieth of the tolerances. The torque of a directional gear jumps at rest, but varies over `turn_speed`
/// under engine bullet: both engines differ by 2.7, 1.3, 0.9 and 0.5 % at 10, 3, 2 and 1 mrad/s, with steps as small as needed.
constexpr double kFine = 1e-5;

struct Case {
  std::string name;
  std::string file;  ///< shipped scenario; "" if `text` is the scenario
  std::string text;
  std::vector<std::string> sets;
  double limited = 0;  ///< least share of time at a limit, mean of all joints
  std::vector<std::string> of_bullet = {fmt::format("physics.step={}", kFine)};

  [[nodiscard]] Scenario with(const std::vector<std::string>& more) const {
    std::vector<std::string> all = sets;
    all.insert(all.end(), more.begin(), more.end());
    return file.empty() ? scenario(text, all) : shipped(file, all);
  }
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const std::string kTwo = R"(
robot: {modules: mtran, docks: [[1, 1, 4, 0, 0]], base: fixed, on_ground: false}
ground: {type: none}
contact: {on: none}
physics: {gravity: [0, 0, 0]}
actuator: {type: dc_motor, i_max: 0.2}
cpg: {type: sine, frequency: 0, amplitude: 0, offset: {default: 0, m0/active: 0.5}}
duration: 0.3
)";
const std::string kRow =
    "robot: {modules: mtran, docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0], [1, 3, 4, 2, 0], [1, 4, 4, 3, 0], "
    "[1, 5, 4, 4, 0], [1, 6, 4, 5, 0], [1, 7, 4, 6, 0]]}\ncontact: {'on': all}\n";
const std::string kFourLegs =
    "robot: {modules: mtran, docks: [[1, 1, 4, 0, 1], [1, 2, 4, 1, 3], [0, 3, 3, 0, 3], [2, 4, 5, 0, 1], "
    "[0, 5, 3, 2, 3], [2, 6, 5, 2, 1]]}\n";

std::vector<Case> cases() {
  return {
      {"two_modules", "", "gaitlab: 1\n" + kTwo, {}, 0.2},
      {"hexapod_300_mA", "hexapod.yaml", "", {"duration=0.75", "actuator.i_max=0.3"}, 0.05},
      {"hexapod_150_mA", "hexapod.yaml", "", {"duration=1.5", "actuator.i_max=0.15"}, 0.15},
      {"caterpillar_300_mA", "caterpillar.yaml", "", {"duration=0.75", "actuator.i_max=0.3"}, 0.05},
      {"caterpillar_150_mA", "caterpillar.yaml", "", {"duration=0.75", "actuator.i_max=0.15"}, 0.2},
      {"caterpillar_fast",
       "caterpillar.yaml",
       "",
       {"duration=0.9", "cpg.frequency=1", "cpg.amplitude=0.6", "cpg.phase_lag=0.4"},
       0.2},
      {"supply_2500_mV",
       "",
       "gaitlab: 1\n" + kRow +
           "actuator: {type: dc_motor, u_max: 2.5}\ncpg: {type: phase_oscillator, frequency: 0.25, amplitude: 0.6, phase_lag: "
           "1.2, model: {amplitude_rate: 20}}\nduration: 0.75\n",
       {},
       0.5},
      {"directional_gear",
       "",
       "gaitlab: 1\n" + kFourLegs +
           "actuator: {type: dc_motor, efficiency_model: directional}\ncpg: {type: tripod, frequency: 0.5, amplitude: "
           "0.4}\nduration: 0.75\n",
       {},
       0,
       {"actuator.turn_speed=0.001", "physics.step=1e-6"}},
      {"beyond_the_stops",
       "",
       "gaitlab: 1\n" + kRow + "cpg: {type: sine, frequency: 0.5, amplitude: 1.9, phase_lag: 0.8}\nduration: 0.75\n",
       {},
       0.2},
  };
}

class Limits : public testing::TestWithParam<Case> {};

TEST_P(Limits, AreMetAsByBulletAtAFineStep) {
  const Case& c = GetParam();
  std::vector<std::string> fine = c.of_bullet;
  fine.emplace_back("physics.engine=bullet");
  const Recording truth = run(c.with(fine));
  const Scenario s = c.with({"physics.engine=articulated"});
  EXPECT_TRUE(s.physics.adaptive_step);
  const Recording ours = run(s);
  EXPECT_GE(at_limit(truth), c.limited);
  if (c.name == "beyond_the_stops") {
    EXPECT_GT(outside_range(truth), 0.05);
  }

  const double error = torque_error(ours, truth);
  const std::string source = "engine bullet at 10 us or below, order 1";
  if (report::torque_error(ours).share <= 0.01) {
    validate_below({"limits.torque", "motors at their limits, torque at rows: worst joint, RMS over its peak", source, ""},
                   error, 0.01, "what accuracy, 1 %, asks for");
  } else {
    EXPECT_FALSE(messages(s, ours, About::accuracy).empty());
  }
  double share = 0;
  for (std::size_t j = 0; j < ours.joints.size(); ++j) {
    share = std::max(share, std::abs(at_limit(ours.joints[j]) - at_limit(truth.joints[j])));
  }
  validate_below({"limits.time", "share of time of a joint at its limits: difference, worst joint", source, ""}, share, 0.01,
                 "a joint that grazes its limit to 0.1 % for a control period or two counts either way: 15 ms of 1.5 s");
  validate_below({"limits.energy", "electrical energy drawn at limits: relative difference", source, ""},
                 std::abs(ours.ledger.electrical / truth.ledger.electrical - 1), 0.02,
                 "torques are right to 1 %, power is torque by current: twice that");
  validate_below({"limits.residual", "energy that is missing at limits, of what is drawn", "conservation of energy", ""},
                 std::abs(ours.ledger.residual()) / ours.ledger.electrical, 0.01, "what accuracy, 1 %, asks for");
  EXPECT_EQ(ours.tally.off, 0);
}

INSTANTIATE_TEST_SUITE_P(Motors, Limits, testing::ValuesIn(cases()), [](const auto& info) { return info.param.name; });

/// On stiff ground (Kn 1e6 N/m, Cd 1e7 N s/m^2), where impacts last 0.1 ms, longer steps create no energy and give about the
/// same travel.
TEST(StiffGround, MakesNoEnergyAndTheRobotWalksAsFar) {
  const std::string text =
      "gaitlab: 1\n" + kFourLegs + "contact: {stiffness: 1e6, damping: 1e7}\ncpg: {type: tripod}\nduration: 1.5\n";
  const double far = travel(run(scenario(text, {"physics.engine=bullet", "physics.step=1e-5"})));
  EXPECT_NEAR(far, 36.6e-3, 1e-5);  // the travel at a step of 2.5 us is 36.5995 mm
  for (const char* step : {"2.5e-3", "5e-3", "auto"}) {
    const Scenario s = scenario(text, {"physics.engine=articulated", std::string("physics.step=") + step});
    const Recording r = run(s);
    validate_below(
        {"limits.stiff_ground", "ground of Kn 1e6 N/m at steps of 2.5 ms, 5 ms and auto: energy missing, of what is drawn",
         "conservation of energy", ""},
        std::abs(r.ledger.residual()) / r.ledger.electrical, 0.01, "required: what is said in warnings from there on");
    // Chattering feet reduce the travel. With a fixed step, friction depends on the normal force before the step, which doubles
    // the tolerance.
    const double allowed = s.physics.adaptive_step ? 0.03 : 0.06;
    EXPECT_NEAR(travel(r), far, allowed * far) << step;
    EXPECT_EQ(r.tally.off, 0) << step;
    EXPECT_FALSE(messages(s, r, About::accuracy).empty()) << step;
  }
}

}  // namespace
}  // namespace gaitlab::test
