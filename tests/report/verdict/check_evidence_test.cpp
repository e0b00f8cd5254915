// Tests of the evidence for a verdict, of values that are too close to their limits, and of the verdict that follows from the
// checks.
#include <cmath>
#include <limits>

#include "report/verdict/error_bar.h"
#include "report/verdict/measure.h"
#include "report/verdict/trust.h"
#include "tests/report/verdict/checks/check_changes.h"

namespace gaitlab::test {
namespace {

constexpr double kEvidenceRounding = 1e-9;  // rounding errors of quotients of numbers near 1

Word word_after(const Change& change) {
  Case made = gait();
  change(made);
  return made.judged().word;
}

/// Change of the summary of a run.
Change with_summary(const std::function<void(Summary&)>& change) {
  return [=](Case& made) { made.also = [=](Summary& summary, Overlaps&) { change(summary); }; };
}

CheckStatus after(const char* id, const Change& change) { return changed(id, change).status; }

TEST(CheckEvidence, PeriodicIsWhatRepeats) {
  const auto with = [](bool found, double set_points, double error = 0.03) {
    return changed("periodic", with_summary([=](Summary& summary) {
                     summary.limit_cycle.found = found;
                     summary.limit_cycle.error = error;
                     summary.gait.period = set_points;
                     summary.gait.start = 0;
                   }));
  };
  EXPECT_EQ(with(true, 4, 0.019).status, CheckStatus::pass);
  EXPECT_NEAR(with(true, 4, 0.019).margin, 0.05, kEvidenceRounding);
  EXPECT_EQ(with(false, 4).status, CheckStatus::warn);
  EXPECT_NEAR(with(false, 4).margin, -0.5, kEvidenceRounding);
  EXPECT_EQ(with(false, 0).status, CheckStatus::not_judged) << "the set points do not repeat";
  EXPECT_EQ(with(false, 5).status, CheckStatus::not_judged) << "too short";
}

/// As a quantity, missing evidence and a failure without a margin are below every limit; a check that does not apply has none.
TEST(CheckEvidence, MarginsOfChecksWithoutOne) {
  const auto margin = [](const char* id, CheckStatus status) {
    Check check;
    check.id = id;
    check.status = status;
    check.margin = NAN;
    return margin_quantity(std::string("margin.") + id, check);
  };
  EXPECT_EQ(margin("evidence", CheckStatus::not_judged), -1);
  EXPECT_TRUE(std::isnan(margin("evidence", CheckStatus::pass)));
  EXPECT_EQ(margin("speed", CheckStatus::fail), -1);
  EXPECT_TRUE(std::isnan(margin("speed", CheckStatus::not_judged)));
}

/// Sufficient evidence is three periods, of which a thousandth may be missing, or one settled period, or 2 s
/// without a period. The ground must carry half of the weight.
TEST(CheckEvidence, EvidenceIsComplete) {
  const auto periods = [](double held) {
    return after("evidence", with_summary([=](Summary& summary) {
                   summary.limit_cycle.found = false;
                   summary.gait.period = 12 / held;
                   summary.gait.start = 0;
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
                   summary.gait.period = 8;
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
        summary.gait.period = 0;
        summary.gait.ahead = nullptr;
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

/// Every rating of a torque or current is `too close` if the value is within the torque error of the limit.
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

/// A motor is too close to its limit if the torque, increased by its error, would reach the limit.
TEST(CheckEvidence, TooCloseToTheLimitOfAMotor) {
  const auto with = [](double error, double peak, double current) {
    Case made = rated_gait();
    off(error)(made);
    for (std::size_t k = made.last_tick() - 40; k <= made.last_tick(); ++k) {
      made.tick(k, kChanged, kEnvelopePeak) = peak;
      made.tick(k, kChanged, kCurrentPeak) = current;
    }
    return made;
  };
  const double most = 1.2;  // i_max, A
  EXPECT_EQ(with(0.03, 0.975, 0).status("voltage"), CheckStatus::too_close);
  EXPECT_EQ(with(0.03, 0.975, 0).status("current"), CheckStatus::pass);
  EXPECT_EQ(with(0.03, 0.975, 0.975 * most).status("current"), CheckStatus::too_close);
  EXPECT_EQ(with(0.03, 0.975, 0.975 * most).status("voltage"), CheckStatus::pass);
  EXPECT_EQ(with(0.03, 0.975, 0.965 * most).status("current"), CheckStatus::pass);
  EXPECT_EQ(with(0.03, 0.965, 0).status("voltage"), CheckStatus::pass);
  EXPECT_EQ(with(0.049, 0.96, 0).status("voltage"), CheckStatus::too_close);
  EXPECT_EQ(with(0.051, 0.96, 0).status("voltage"), CheckStatus::pass) << "an error above limits.torque_error proves nothing";
  // A check fails if it fails even with its value reduced by the error.
  Case fails = with(0.03, 0.975, 0);
  grow(fails, kVoltageLimited, 1, 11, 12);
  EXPECT_EQ(fails.status("voltage"), CheckStatus::fail);
  grow(fails, kVoltageLimited, 1, 12 - 3.05 * 0.015, 12);
  fails.scenario.limits.saturated_share = 1;
  EXPECT_EQ(fails.status("voltage"), CheckStatus::too_close) << "3.05 periods less 3 %";
  // A failure of a joint without error counts, also if a joint with a smaller margin is too close.
  const auto other = [&](double periods) {
    Case two = fails;
    for (std::size_t k = 0; k <= two.last_tick(); ++k)
      two.tick(k, 2, kVoltageLimited) = std::max(0.0, two.time(k) - (12 - periods * 0.015));
    return two.check("voltage");
  };
  EXPECT_EQ(other(3.04).status, CheckStatus::fail) << other(3.04).text;
  EXPECT_EQ(other(3.04).worst, fails.scenario.robot->joints[kChanged].name);
  EXPECT_EQ(other(2.9).status, CheckStatus::too_close) << other(2.9).text;
}

/// Intervals with torques within the error of the limit: up to three control periods pass, longer intervals are too close. If
/// the torque minus its error is at the limit for longer, the check fails.
TEST(CheckEvidence, TheBarOfAStretch) {
  const auto with = [](std::size_t near, double periods) {
    Case made = rated_gait();
    off(0.03)(made);
    made.scenario.limits.saturated_share = 1;
    for (std::size_t k = made.last_tick() + 1 - near; k <= made.last_tick(); ++k) made.tick(k, kChanged, kEnvelopePeak) = 0.98;
    grow(made, kVoltageLimited, 1, 9, 9 + periods * 0.015);
    return made.status("voltage");
  };
  EXPECT_EQ(with(3, 0), CheckStatus::pass);
  EXPECT_EQ(with(4, 0), CheckStatus::too_close);
  EXPECT_EQ(with(3, 3), CheckStatus::warn);
  EXPECT_EQ(with(0, 3.05), CheckStatus::too_close) << "less 3 %";
  EXPECT_EQ(with(0, 3.15), CheckStatus::fail);
  EXPECT_EQ(with(4, 3.15), CheckStatus::fail);
  // If a joint is at a limit of voltage or current for part of a row, the recorded time at the limit counts, not the whole row.
  for (const TickColumn column : {kVoltageLimited, kCurrentLimited}) {
    Case partly = rated_gait();
    off(0.03)(partly);
    partly.scenario.limits.saturated_share = 1;
    double sum = 0;
    for (std::size_t k = partly.last_tick() - 5; k <= partly.last_tick(); ++k) {
      partly.tick(k, kChanged, kEnvelopePeak) = 1;
      partly.tick(k, kChanged, column) = sum += 0.4 * (partly.time(k) - partly.time(k - 1));
    }
    EXPECT_EQ(partly.status("voltage"), column == kVoltageLimited ? CheckStatus::warn : CheckStatus::pass);
  }
}

/// Ratings of several joints with errors: the check fails if any joint is beyond its limit by more than its error. Otherwise it
/// is too close if the limit of any joint is within the error.
TEST(CheckEvidence, AnyPartDecides) {
  const auto with = [](TickColumn column, double limit, bool square, double first, double second) {
    return [=](Case& made) {
      off(0.03)(made);
      const auto set = [&](std::size_t joint, double share) {
        for (std::size_t k = 0; k <= made.last_tick(); ++k)
          made.tick(k, joint, column) = square ? share * share * limit * limit * made.time(k) : share * limit;
      };
      set(kChanged, first);
      set(2, second);
    };
  };
  for (const auto& [id, column, limit, square] : {std::tuple{"heat", kCurrentSquare, 1.0, true},
                                                  {"gear_peak", kTorquePeak, 5.0, false},
                                                  {"gear_continuous", kTorqueSquare, 3.0, true}}) {
    const auto check = [&, &of = id, in = column, most = limit, sums = square](double first, double second) {
      return changed(of, with(in, most, sums, first, second));
    };
    const std::string& nearer = rated_gait().scenario.robot->joints[kChanged].name;
    EXPECT_EQ(check(1.02, 0.9).status, CheckStatus::too_close) << id;
    EXPECT_EQ(check(1.02, 1.01).status, CheckStatus::fail) << id << ": " << check(1.02, 1.01).text;
    EXPECT_EQ(check(1.02, 1.01).worst, nearer) << id;
    const Check open = check(0.98, 0.99);
    EXPECT_EQ(open.status, CheckStatus::too_close) << id << ": " << open.text;
    EXPECT_NE(open.worst, nearer) << id;
    EXPECT_EQ(open.error, 0) << id;
    EXPECT_TRUE(contains(open.text,
                         fmt::format("; joint {} takes, with the error of its torque, 95.1 % to 101 % of its limit", nearer)))
        << open.text;
    EXPECT_TRUE(contains(open.remedy, "take physics.accuracy: ")) << open.remedy;
    EXPECT_EQ(check(0.96, 0.99).status, CheckStatus::warn) << id;
  }
}

TEST(CheckEvidence, AnErrorBarWhoseEndsArePrintedAlike) {
  const ErrorBar bars[] = {ErrorBar::around("m1", 1.0001, 3e-4)};
  Check made;
  made.worst = "m1";
  widen(rated_gait().scenario, bars, made);
  EXPECT_EQ(made.status, CheckStatus::too_close);
  EXPECT_EQ(made.text, "; with the error of the torques, this is slightly less or slightly more than 100 % of the limit");
}

/// If the ground does not carry the robot, this is reported first, with the setting that causes it, because neither a longer
/// run nor smaller steps help.
TEST(CheckEvidence, WhatNothingBears) {
  for (const auto& [set, text] : {std::pair{"physics.gravity=[0, 0, 0]", "there is no gravity"},
                                  {"ground.type=none", "there is no ground"},
                                  {"contact.on=none", "no part of it touches the ground"}}) {
    for (const Case& of : {walk(), rated_gait()}) {
      Case made = of;
      made.known = Overlaps{made.scenario.robot->bodies.size()};
      made.scenario = shipped("caterpillar.yaml", {fmt::format("duration={}", of.scenario.duration), set});
      const Check check = made.check("evidence");
      EXPECT_EQ(check.status, CheckStatus::not_judged);
      EXPECT_EQ(check.place.file, std::string("--set ") + set);
      EXPECT_TRUE(contains(check.text, text)) << check.text;
      EXPECT_TRUE(contains(check.remedy, "take ")) << check.remedy;
      EXPECT_EQ(made.judged().word, Word::not_judged);
      EXPECT_TRUE(made.judged().why().starts_with(check.text + "; " + check.remedy)) << made.judged().why();
      off(0.051)(made);
      EXPECT_TRUE(contains(made.judged().why(), text)) << made.judged().why();
    }
  }
  EXPECT_EQ(walk().check("evidence").place.line, walk().scenario.nearest_place("duration").line);
  EXPECT_TRUE(contains(walk().judged().why(), "take duration: 12")) << walk().judged().why();
  Case wrong = rated_gait();
  off(0.051)(wrong);
  wrong.scenario.own_places["physics.accuracy"] = SourceLocation{"accuracy"};
  EXPECT_EQ(wrong.check("evidence").place.file, "accuracy");
}

/// A torque error that is NaN counts as the largest error, in any joint.
TEST(CheckEvidence, NotANumberIsNoEvidence) {
  for (const std::size_t joint : {std::size_t{0}, kChanged, std::size_t{9}}) {
    Case made = rated_gait();
    off(0.01)(made);
    made.record.tally.torque_error[joint] = std::nan("");
    EXPECT_TRUE(torque_error(made.record).estimated);
    EXPECT_EQ(torque_error(made.record).joint, joint);
    EXPECT_EQ(made.judged().word, Word::not_judged);
    EXPECT_EQ(made.judged().why(),
              fmt::format("the error of the torque of joint {} is not a number", made.scenario.robot->joints[joint].name));
    EXPECT_EQ(made.status("torque_error"), CheckStatus::warn);
  }
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
  // In a run that is too short, a failure counts only if a longer run cannot undo it.
  Case brief = walk();
  brief.record.joints[4].range_worst = 0.02;
  EXPECT_EQ(brief.judged().word, Word::infeasible);
  brief = walk();
  brief.tick(brief.last_tick(), 5, kErrorPeak) = 3;
  EXPECT_EQ(brief.judged().word, Word::not_judged);
  // A run with inaccurate numbers is not judged.
  brief.record.joints[4].range_worst = 0.02;
  brief.record.tally.coarse = brief.record.simulated;
  EXPECT_EQ(brief.judged().word, Word::not_judged);
}

}  // namespace
}  // namespace gaitlab::test
