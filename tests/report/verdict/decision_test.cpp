// Failures that decide a verdict in spite of inaccurate torques, missing evidence in one sentence, and the events of
// verdict.json.
#include <nlohmann/json.hpp>

#include "report/verdict/numbers/number_texts.h"
#include "tests/report/verdict/checks/check_changes.h"

namespace gaitlab::test {
namespace {

/// A failure by more than the error of the torques decides, although that error is above limits.torque_error. Other failures
/// are reported beside the missing evidence.
TEST(Decision, AFailureBeyondTheErrorDecides) {
  const auto with = [](double error, double from) {
    Case made = rated_gait();
    off(error)(made);
    grow(made, kVoltageLimited, 1, from, 12);
    made.scenario.limits.saturated_share = 0.1;
    made.scenario.limits.saturated_periods = 1000;
    return made.judged();
  };
  const double window = 8;
  const Verdict surely = with(0.085, 12 - 0.12 * window);
  EXPECT_EQ(surely.word, Word::infeasible) << surely.why();
  EXPECT_EQ(surely.decided_by, "voltage");
  EXPECT_TRUE(contains(surely.why(), "; this is certain, although torques are off by up to about 8.5 %")) << surely.why();
  const Verdict perhaps = with(0.085, 12 - 0.105 * window);
  EXPECT_EQ(perhaps.word, Word::not_judged);
  EXPECT_TRUE(contains(perhaps.why(),
                       "is off by about 8.5 % of its peak, more than 5 %; take physics.accuracy: 0.0005; so "
                       "far: 1 of 16 joints reaches"))
      << perhaps.why();
  EXPECT_EQ(perhaps.retry, std::vector<std::string>{"physics.accuracy=0.0005"});
  EXPECT_TRUE(perhaps.retry_is_finer);
  EXPECT_EQ(with(0.499, 4).word, Word::infeasible);
  EXPECT_EQ(with(0.501, 4).word, Word::not_judged) << "an error of half the torque shows nothing";
  const auto tracking = [](double error) {
    Case made = gait();
    off(error)(made);
    made.scenario.limits.tracking_error = 1e-6;
    return made.judged().word;
  };
  EXPECT_EQ(tracking(0.049), Word::infeasible);
  EXPECT_EQ(tracking(0.051), Word::not_judged) << "the error of this number is not known";
}

/// Failing checks are listed by the time when a part was first beyond its limit, within a tick where it is known.
TEST(Decision, EventsAreByTime) {
  Case made = rated_gait();
  grow(made, kVoltageLimited, 1, 10, 12);
  grow(made, kCurrentLimited, 1, 8, 9);
  made.scenario.limits.tracking_error = 1e-6;  // this check fails without such a time
  const auto json = nlohmann::json::parse(to_json(made.judged()));
  const std::string& joint = made.scenario.robot->joints[kChanged].name;
  ASSERT_EQ(json["events"].size(), 2U) << json["events"];
  EXPECT_EQ(json["events"][0]["check"], "current");
  EXPECT_NEAR(json["events"][0]["time"], 8, 1e-9);
  EXPECT_EQ(json["events"][0]["part"], joint);
  EXPECT_EQ(json["events"][1]["check"], "voltage");
  EXPECT_NEAR(json["events"][1]["time"], 10, 1e-9);
}

/// Motors that lose less than 1 % of the energy drawn, or that carry a robot at less than the resistance of rails, have no cost
/// of transport.
TEST(Decision, NoCostOfTransportWithoutLosses) {
  Case made = rated_gait();
  Summary summary = summarise(made.scenario, made.record, 0);
  const auto lossless = [&] { return texts::lossless({made.scenario, made.record, summary}); };
  EXPECT_FALSE(lossless()) << summary.cost_electrical;
  Ledger& energy = made.record.ledger;
  energy.gear = energy.hinges = 0;
  energy.copper = 0.0101 * energy.electrical;
  EXPECT_FALSE(lossless());
  energy.copper = 0.0099 * energy.electrical;
  EXPECT_TRUE(lossless());
  energy.copper = energy.electrical;
  summary.cost_electrical = 0.00101;
  EXPECT_FALSE(lossless());
  summary.cost_electrical = 0.00099;
  EXPECT_TRUE(lossless());
}

/// One sentence lists all missing evidence, and the settings of the next run supply it.
TEST(Decision, AllLacksAreNamed) {
  Case made = walk();
  made.scenario.limits.tracking_error = 1e-6;
  made.record.tally.torque_error[0] = 0.085 * made.record.tally.torque_peak[0];
  const Verdict verdict = made.judged();
  EXPECT_EQ(verdict.word, Word::not_judged);
  EXPECT_TRUE(contains(verdict.reason.text,
                       "take physics.accuracy: 0.0005; and 4 s contain only 1 of the 3 periods of 4 s that a gait needs; take "
                       "duration: 12; so far: joint "))
      << verdict.reason.text;
  EXPECT_EQ(verdict.retry, (std::vector<std::string>{"physics.accuracy=0.0005", "duration=12"}));
  const auto json = nlohmann::json::parse(to_json(verdict));
  EXPECT_EQ(json.at("reason_code"), "lacks");
  EXPECT_EQ(json.at("reason_check"), "tracking") << "the check that fails so far";
  EXPECT_EQ(json.at("failures").at(0), "tracking");
  EXPECT_FALSE(verdict.retry_is_finer) << "the user has chosen the duration";
}

}  // namespace
}  // namespace gaitlab::test
