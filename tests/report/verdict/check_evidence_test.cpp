// Evidence, values too close to their limits, and the words that follow from checks.
#include <cmath>
#include <limits>

#include "report/verdict/trust.h"
#include "tests/report/verdict/check_changes.h"

namespace gaitlab::test {
namespace {

constexpr double kEvidenceRounding = 1e-9;  // of quotients of numbers near 1

Word word_after(const Change& change) {
  Case made = gait();
  change(made);
  return made.judged().word;
}

/// The gait with this summary.
Change with_summary(const std::function<void(Summary&)>& change) {
  return [=](Case& made) { made.also = [=](Summary& summary, Overlaps&) { change(summary); }; };
}

CheckStatus after(const char* id, const Change& change) { return changed(id, change).status; }

TEST(CheckEvidence, PeriodicIsWhatRepeats) {
  const auto with = [](bool found, double set_points, double error = 0.03) {
    return changed("periodic", with_summary([=](Summary& summary) {
                     summary.limit_cycle.found = found;
                     summary.limit_cycle.error = error;
                     summary.set_point_period = set_points;
                   }));
  };
  EXPECT_EQ(with(true, 4, 0.019).status, CheckStatus::pass);
  EXPECT_NEAR(with(true, 4, 0.019).margin, 0.05, kEvidenceRounding);
  EXPECT_EQ(with(false, 4).status, CheckStatus::warn);
  EXPECT_NEAR(with(false, 4).margin, -0.5, kEvidenceRounding);
  EXPECT_EQ(with(false, 0).status, CheckStatus::not_judged) << "the set points do not repeat";
  EXPECT_EQ(with(false, 5).status, CheckStatus::not_judged) << "too short";
}

/// Three periods but for a thousandth, which is the error of a period, or one that is settled; 2 s where nothing repeats; half
/// of the weight.
TEST(CheckEvidence, EvidenceIsComplete) {
  const auto periods = [](double held) {
    return after("evidence", with_summary([=](Summary& summary) {
                   summary.limit_cycle.found = false;
                   summary.set_point_period = 12 / held;
                 }));
  };
  EXPECT_EQ(periods(3), CheckStatus::pass);
  EXPECT_EQ(periods(3 * (1 - 0.9e-3)), CheckStatus::pass);
  EXPECT_EQ(periods(3 * (1 - 1.1e-3)), CheckStatus::not_judged);
  const auto settled = [](double error, std::size_t whole) {
    return after("evidence", with_summary([=](Summary& summary) {
                   summary.limit_cycle.found = true;
                   summary.limit_cycle.error = error;
                   summary.judged.periods = whole;
                   summary.set_point_period = 8;
                 }));
  };
  EXPECT_EQ(settled(0.0099, 1), CheckStatus::pass);
  EXPECT_EQ(settled(0.0101, 1), CheckStatus::not_judged);
  EXPECT_EQ(settled(0.0099, 0), CheckStatus::not_judged);
  const auto lasts = [](double seconds) {
    return after("evidence", [=](Case& made) {
      made.record.simulated = seconds;
      made.also = [](Summary& summary, Overlaps&) {
        summary.limit_cycle.found = false;
        summary.set_point_period = 0;
      };
    });
  };
  EXPECT_EQ(lasts(2), CheckStatus::pass);
  EXPECT_EQ(lasts(2 * (1 - 0.9e-9)), CheckStatus::pass);
  EXPECT_EQ(lasts(2 * (1 - 1.1e-9)), CheckStatus::not_judged);
  const auto borne = [](double share) {
    return after("evidence", with_summary([=](Summary& summary) { summary.posture.borne_share = share; }));
  };
  EXPECT_EQ(borne(0.5), CheckStatus::pass);
  EXPECT_EQ(borne(0.499), CheckStatus::not_judged);
  EXPECT_EQ(borne(std::nan("")), CheckStatus::pass);
  const auto unaccounted = [](double share) {
    return after("evidence", [=](Case& made) {
      made.record.ledger.copper += made.record.ledger.residual() - share * made.record.ledger.electrical;
    });
  };
  EXPECT_EQ(unaccounted(0.0499), CheckStatus::pass);
  EXPECT_EQ(unaccounted(0.0501), CheckStatus::not_judged);
  EXPECT_EQ(unaccounted(-0.0501), CheckStatus::not_judged);
  EXPECT_EQ(after("evidence", off(0.0499)), CheckStatus::pass);
  EXPECT_EQ(after("evidence", off(0.0501)), CheckStatus::not_judged);
  EXPECT_EQ(after("evidence", off(std::nan(""))), CheckStatus::not_judged);
  const auto coarse = [](double share) {
    return after("evidence", [=](Case& made) { made.record.tally.coarse = share * made.record.simulated; });
  };
  EXPECT_EQ(coarse(0.0999), CheckStatus::pass);
  EXPECT_EQ(coarse(0.1001), CheckStatus::not_judged);
}

/// Every rating that is of a torque or of a current: within the error of the torques nothing is decided.
TEST(CheckEvidence, TooClose) {
  const std::vector<std::tuple<const char*, double, std::function<Change(double)>>> rated{
      {"heat", 1, [](double v) { return rate(kCurrentSquare, v * v); }},
      {"gear_peak", 5, [](double v) { return tick(kTorquePeak, v); }},
      {"gear_continuous", 3, [](double v) { return rate(kTorqueSquare, v * v); }},
      {"dock_tension", 1000, [](double v) { return load("dock.3.tension", v); }},
      {"dock_shear", 800, [](double v) { return load("dock.3.shear", v); }},
      {"dock_bending", 400, [](double v) { return load("dock.3.bending", v); }},
      {"dock_torsion", 200, [](double v) { return load("dock.3.torsion", v); }}};
  for (const auto& [id, limit, change] : rated) {
    for (const auto& [share, status] : {std::pair{0.97, CheckStatus::warn},
                                        {0.975, CheckStatus::too_close},
                                        {1.025, CheckStatus::too_close},
                                        {1.035, CheckStatus::fail}}) {
      const Check check = changed(id, [&, &at = change, most = limit, part = share](Case& made) {
        off(0.03)(made);
        at(part * most)(made);
      });
      EXPECT_EQ(check.status, status) << id << ": " << check.text;
      EXPECT_EQ(check.error, 0.03) << id;
    }
  }
}

/// A joint whose torque comes within its error of the limit would be at it if the torque were that much larger.
TEST(CheckEvidence, TooCloseToTheLimitOfAMotor) {
  const auto with = [](double error, double peak, double current) {
    Case made = rated_gait();
    off(error)(made);
    for (std::size_t k = made.last_tick() - 40; k <= made.last_tick(); ++k) {
      made.tick(k, kJoint, kEnvelopePeak) = peak;
      made.tick(k, kJoint, kCurrentPeak) = current;
    }
    return made;
  };
  const double most = 1.2;  // A, i_max
  EXPECT_EQ(with(0.03, 0.975, 0).status("voltage"), CheckStatus::too_close);
  EXPECT_EQ(with(0.03, 0.975, 0).status("current"), CheckStatus::pass);
  EXPECT_EQ(with(0.03, 0.975, 0.975 * most).status("current"), CheckStatus::too_close);
  EXPECT_EQ(with(0.03, 0.975, 0.975 * most).status("voltage"), CheckStatus::pass);
  EXPECT_EQ(with(0.03, 0.975, 0.965 * most).status("current"), CheckStatus::pass);
  EXPECT_EQ(with(0.03, 0.965, 0).status("voltage"), CheckStatus::pass);
  EXPECT_EQ(with(0.049, 0.96, 0).status("voltage"), CheckStatus::too_close);
  EXPECT_EQ(with(0.051, 0.96, 0).status("voltage"), CheckStatus::pass) << "an error above limits.torque_error proves nothing";
  // What fails though it were at the limit by its error less, fails.
  Case fails = with(0.03, 0.975, 0);
  grow(fails, kVoltageLimited, 1, 11, 12);
  EXPECT_EQ(fails.status("voltage"), CheckStatus::fail);
  grow(fails, kVoltageLimited, 1, 12 - 3.05 * 0.015, 12);
  fails.scenario.limits.saturated_share = 1;
  EXPECT_EQ(fails.status("voltage"), CheckStatus::too_close) << "3.05 periods less 3 %";
}

TEST(CheckEvidence, WordsOfWhatIsTooClose) {
  const auto with = [](double share) {
    Case made = rated_gait();
    off(0.03)(made);
    tick(kTorquePeak, 5 * share)(made);
    return made;
  };
  for (const double share : {0.98, 1.02}) {
    const Verdict made = with(share).judged();
    EXPECT_EQ(made.word, Word::not_judged);
    EXPECT_TRUE(contains(made.why(), " of the limit")) << made.why();
    EXPECT_TRUE(contains(with(share).check("gear_peak").remedy, "take physics.accuracy: "));
  }
  EXPECT_EQ(with(1.04).judged().word, Word::infeasible);
  EXPECT_EQ(with(0.96).judged().word, Word::feasible) << with(0.96).judged().why();
}

TEST(CheckEvidence, WordsOfFailuresAndOfMissingEvidence) {
  EXPECT_EQ(word_after([](Case&) {}), Word::feasible);
  EXPECT_EQ(word_after(tick(kErrorPeak, 0.21)), Word::infeasible);
  EXPECT_EQ(word_after([](Case& made) { made.record.outcome = {Ended::diverged, "diverged at step 3"}; }), Word::failed);
  EXPECT_EQ(word_after([](Case& made) { made.record.tally.coarse = 0.11 * made.record.simulated; }), Word::not_judged);
  EXPECT_EQ(word_after([](Case& made) { made.record.tally.coarse = 0.09 * made.record.simulated; }), Word::feasible);
  EXPECT_EQ(word_after(off(0.051)), Word::not_judged);
  EXPECT_EQ(word_after(off(0.049)), Word::feasible);
  EXPECT_EQ(word_after([&](Case& made) {
              off(0.051)(made);
              made.scenario.limits.torque_error = 0.06;
            }),
            Word::feasible);
  // What no time undoes is said of a run that is too short, too; what time could undo is not.
  Case brief = walk();
  brief.record.joints[4].range_worst = 0.02;
  EXPECT_EQ(brief.judged().word, Word::infeasible);
  brief = walk();
  brief.tick(brief.last_tick(), 5, kErrorPeak) = 3;
  EXPECT_EQ(brief.judged().word, Word::not_judged);
  // Nothing can be said of a run whose numbers are not to be trusted.
  brief.record.joints[4].range_worst = 0.02;
  brief.record.tally.coarse = brief.record.simulated;
  EXPECT_EQ(brief.judged().word, Word::not_judged);
}

}  // namespace
}  // namespace gaitlab::test
