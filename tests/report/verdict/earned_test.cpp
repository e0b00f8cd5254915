// Runs for which the correct verdict is known, most of which earlier versions called `feasible` by mistake.
#include "report/analysis/fall.h"
#include "report/analysis/upright.h"
#include "report/verdict/screen.h"
#include "tests/folders.h"
#include "tests/labels.h"
#include "tests/report/verdict/verdict_case.h"

namespace gaitlab::test {
namespace {

const Label kLongEarned("Earned.NothingBearsTheRobot:Earned.ATorqueErrorOfAHundredPercent", "long");

/// Run with its loads and its verdict, as `gaitlab run` computes it.
struct Told {
  Scenario scenario;
  Recording record;
  Summary summary;
  Verdict made;

  explicit Told(Scenario s) : scenario(std::move(s)) {
    Simulation simulation({&scenario, 1}, Loads::recorded);
    simulation.run();
    record = simulation.take_recording(0);
    summary = summarise(scenario, record, 0);
    made = verdict(scenario, record, summary, overlaps(scenario, record));
  }
  [[nodiscard]] const Check& check(const std::string& id) const { return *std::ranges::find(made.checks, id, &Check::id); }
};

Scenario known_truth(const std::string& name) {
  return read_scenario(std::string(gaitlab::test::source_folder()) + "/tests/data/verdict/" + name + ".yaml", {}, catalog());
}

/// V1: a dock opens at the landing, before the judged window. Docks are judged in the whole run.
TEST(Earned, ADockThatOpensAtTheLanding) {
  const Told drop(known_truth("V1-docks-at-landing"));
  EXPECT_EQ(drop.made.word, Word::infeasible);
  const Check& shear = drop.check("dock_shear");
  EXPECT_EQ(shear.status, CheckStatus::fail);
  EXPECT_EQ(shear.part, Part::dock);
  // Largest load of all rows, and first time above 25 N, computed from the table of loads.
  double most = 0;
  double first = -1;
  const Trace& loads = drop.record.loads;
  for (std::size_t row = 0; row < loads.rows(); ++row) {
    for (const char* const column : {"dock.1.shear", "dock.2.shear"}) {
      const double load = std::abs(loads.at(row, loads.find(column)));
      if (load > 25 && first < 0) first = loads.at(row, 0);
      most = std::max(most, load);
    }
  }
  EXPECT_EQ(shear.value, most);
  EXPECT_EQ(shear.first, first);
  EXPECT_LT(shear.from, drop.made.from) << "before the judged window";
}

/// V2: a gear breaks at the landing, before the judged window. Gears are judged in the whole run.
TEST(Earned, AGearThatBreaksAtTheLanding) {
  const Told drop(known_truth("V2-gear-at-landing"));
  EXPECT_EQ(drop.made.word, Word::infeasible);
  double most = 0;
  for (const JointStatistics& joint : drop.record.joints) most = std::max(most, joint.torque_peak);
  EXPECT_NEAR(drop.check("gear_peak").value, most, 1e-6 * most) << "rows of ticks are single precision";
  EXPECT_GT(most, 1);
}

/// V5: a run of a fortieth of a period is not sufficient evidence.
TEST(Earned, APieceOfAPeriod) {
  const Told brief(shipped("hexapod.yaml", {"physics.engine=articulated", "duration=0.05"}));
  EXPECT_EQ(brief.made.word, Word::not_judged);
  EXPECT_EQ(brief.made.why(), "0.05 s contain only 0.025 of the 3 periods of 2 s that a gait needs; take duration: 6");
  // The remedy, a longer run, makes the run feasible.
  EXPECT_EQ(Told(shipped("hexapod.yaml", {"physics.engine=articulated", "duration=6"})).made.word, Word::feasible);
}

/// V6: runs without value are not feasible: a motor that creates energy, constant set points, a ground that does not carry the
/// robot.
TEST(Earned, RunsThatAreWorthless) {
  const std::vector<std::string> sets{"physics.engine=articulated", "duration=12"};
  const auto with = [&](const std::string& set) {
    std::vector<std::string> all = sets;
    all.push_back(set);
    return Told(shipped("caterpillar.yaml", all)).made;
  };
  EXPECT_EQ(with("actuator.Kt=1").word, Word::not_judged);
  EXPECT_TRUE(contains(with("actuator.Kt=1").why(), "the motor of joint m0/active makes energy"))
      << with("actuator.Kt=1").why();
  EXPECT_EQ(with("cpg.type=keyframes").word, Word::not_judged);
  EXPECT_TRUE(contains(with("cpg.type=keyframes").why(), "cpg keyframes moves no joint")) << with("cpg.type=keyframes").why();
  const Verdict up = with("physics.gravity=[0, 0, 9.81]");
  EXPECT_NE(up.word, Word::feasible);
  EXPECT_NE(up.word, Word::infeasible) << "nothing breaks in free flight: " << up.why();
  EXPECT_TRUE(contains(up.why(), "the ground carries 0 % of the weight on average")) << up.why();
}

/// V7: torques have errors as large as the torques.
TEST(Earned, ATorqueErrorOfAHundredPercent) {
  const Told stiff(shipped("hexapod.yaml", {"physics.engine=articulated", "contact.stiffness=1.47265e+11",
                                            "actuator.Kt=0.545382", "contact.damping_exponent=5.42154", "duration=0.3"}));
  EXPECT_NE(stiff.made.word, Word::feasible);
}

/// V9: on a slope of 30 degrees the friction is too small and the robot slides down, which is not a gait.
TEST(Earned, SlidingDownASlope) {
  const double g = 9.81;
  const Told slide(shipped("hexapod.yaml", {"physics.engine=articulated", "duration=12", "ground.friction=0.3",
                                            fmt::format("physics.gravity=[{}, 0, {}]", g / 2, -g * std::sqrt(3) / 2)}));
  EXPECT_GT(slide.summary.distance, 50);
  EXPECT_EQ(slide.check("progress").status, CheckStatus::fail) << slide.check("progress").text;
  EXPECT_EQ(slide.check("progress").unit, "times");
  EXPECT_EQ(slide.check("progress").limit, 1.2);
  EXPECT_NE(slide.made.word, Word::feasible);
}

/// A robot that drops at its start and begins its gait slowly does not count as sliding.
TEST(Earned, ADropAtTheStartIsNoSlide) {
  Catalog& known = catalog();
  const Told dropped(
      read_scenario(std::string(gaitlab::test::source_folder()) + "/tests/data/verdict/V11-starts-above-the-ground.yaml",
                    {"cpg.model.ramp=8", "duration=10"}, known));
  EXPECT_NE(dropped.check("progress").status, CheckStatus::fail) << dropped.check("progress").text;
}

/// Robots that drop onto a flat plane, also within the judged time, and are then faster do not slide.
TEST(Earned, ADropOntoAPlaneIsNoSlide) {
  const auto text = [](const std::string& robot, const std::vector<std::string>& sets) {
    const Told dropped(shipped(robot, sets));
    EXPECT_NE(dropped.check("progress").status, CheckStatus::fail);
    return dropped.check("progress").text;
  };
  EXPECT_TRUE(text("library/y1-snake.yaml", {"cpg.frequency=0.933", "robot.position=[0, 0, 0.26]", "duration=4.29"})
                  .starts_with("the robot goes "));
  EXPECT_TRUE(text("hexapod.yaml", {"physics.engine=articulated", "contact.on=all", "robot.position=[0, 0, 0.35]",
                                    "cpg.frequency=1", "duration=4.2"})
                  .starts_with("the robot goes "));
}

/// An arch that stands high at the start and lowers itself to a snake on the ground has not fallen. (A robot that topples with
/// the set points of its start has: FallCheck.IsOfTheHeightAboveTheGround.)
TEST(Earned, ARobotThatLowersItselfAsItIsTold) {
  const auto arch = [](const std::string& docks, const std::string& angles, const std::string& gait, int duration) {
    return Told(scenario(fmt::format(R"(
gaitlab: 1
robot: {{modules: mtran, docks: {0}}}
physics: {{engine: articulated}}
contact: {{on: all}}
initial: {{angles: {{default: 0, {1}}}}}
cpg:
  type: equations
  model:
    states: {{u: "1"}}
    initial: {{u: "0"}}
    parameters: {{h: {{default: 0, {1}}}}}
    output: h*max(0,1-u/4) + {2}
duration: {3}
)",
                                     docks, angles, gait, duration)));
  };
  const std::string six = "[[1, 1, 4, 0, 0], [1, 2, 4, 1, 0], [1, 3, 4, 2, 0], [1, 4, 4, 3, 0], [1, 5, 4, 4, 0]]";
  const std::string of_six = "m0/passive: -0.8, m2/passive: 0.8, m3/active: 0.8, m5/active: -0.8";
  const std::string four = "[[1, 1, 4, 0, 0], [1, 2, 4, 1, 0], [1, 3, 4, 2, 0]]";
  const std::string of_four = "m0/passive: -1, m1/passive: 1, m2/active: 1, m3/active: -1";
  for (const Told& told : {arch(six, of_six, "0.4*clamp((u-4)/2,0,1)*sin(3.14159265*u+1.2*index)", 8),
                           arch(six, of_six, "0.2*clamp((u-4)/2,0,1)*sin(2*u+1.2*index)", 8), arch(four, of_four, "0", 5)}) {
    const Check& fall = told.check("fall");
    EXPECT_EQ(fall.status, CheckStatus::pass) << fall.text;
    const std::vector<double> height = heights(told.scenario, told.record);
    EXPECT_LT(*std::ranges::min_element(height), 0.5 * height.front()) << "lower than half of its start";
  }
}

/// A hinge without a motor may touch its stop, but fails if it is pressed against the stop.
TEST(Earned, AHingeThatRestsOnItsStop) {
  const auto leg = [](double mass, double frequency) {
    return Told(scenario(fmt::format(R"(
gaitlab: 1
robot:
  base: fixed
  position: [0, 0, 1]
  modules:
    gaitlab_module: 1
    name: leg
    bodies:
      base: {{mass: 1, inertia: [1e-3, 1e-3, 1e-3, 0, 0, 0]}}
      horn: {{mass: 0.01, inertia: [1e-6, 1e-6, 1e-6, 0, 0, 0]}}
      calf: {{mass: {0}, com: [0.1, 0, 0], inertia: [7e-4, 7e-4, 7e-4, 0, 0, 0]}}
    hinges:
      - {{name: motor, parent: base, child: horn, axis: [0, 1, 0], range: [-2, 2]}}
      - {{name: lash, parent: horn, child: calf, axis: [0, 1, 0], range: [-0.02, 0.02], drive: none, damping: 1e-4}}
    actuator: {{type: servo, voltage: 24, stall_torque: 23, no_load_speed: 30, rotor_inertia: 0.01}}
    controller: {{type: pid, Kp: 40}}
physics: {{engine: articulated}}
ground: {{type: none}}
contact: {{on: none}}
cpg: {{type: sine, frequency: {1}, amplitude: 0.1}}
duration: 1
)",
                                     mass, frequency)));
  };
  for (const double frequency : {1.0, 2.0}) {
    const Told rests = leg(0.2, frequency);
    EXPECT_GT(rests.record.joints[1].range_share, 0.1);
    EXPECT_EQ(rests.check("stops").status, CheckStatus::pass) << rests.check("stops").text;
    EXPECT_TRUE(
        contains(rests.check("stops").text, "no joint with a motor leaves its range; m0/lash without a motor is up to "));
    EXPECT_EQ(rests.check("stops").limit, 0.05);
    const Told pressed = leg(3, frequency);
    const Check& stops = pressed.check("stops");
    EXPECT_EQ(stops.status, CheckStatus::fail) << stops.text;
    EXPECT_TRUE(contains(stops.text, fmt::format("which gives {:.3g} N m", 50 * stops.value))) << stops.text;
  }
}

/// Sliding is detected also in short runs of 2, 2.5 and 3.5 periods.
TEST(Earned, SlidingInAShortRun) {
  const double g = 9.81;
  const auto on_slope = [&](const char* duration) {
    return Told(shipped("hexapod.yaml", {"physics.engine=articulated", duration, "ground.friction=0.3",
                                         fmt::format("physics.gravity=[{}, 0, {}]", g / 2, -g * std::sqrt(3) / 2)}));
  };
  for (const char* const duration : {"duration=4", "duration=5", "duration=7"}) {
    const Told slide = on_slope(duration);
    EXPECT_EQ(slide.check("progress").status, CheckStatus::fail) << duration << ": " << slide.check("progress").text;
  }
}

/// Runs in which the ground does not carry the robot are not judged: without ground, without contact elements, or without
/// gravity.
TEST(Earned, NothingBearsTheRobot) {
  const auto with = [](const std::vector<std::string>& more) {
    std::vector<std::string> all{"physics.engine=articulated", "duration=12"};
    all.insert(all.end(), more.begin(), more.end());
    return Told(shipped("caterpillar.yaml", all)).made;
  };
  const Verdict weightless = with({"physics.gravity=[0, 0, 0]"});
  EXPECT_EQ(weightless.word, Word::not_judged);
  EXPECT_TRUE(contains(weightless.why(), "there is no gravity")) << weightless.why();
  const Verdict falling = with({"ground.type=none"});
  EXPECT_EQ(falling.word, Word::not_judged);
  EXPECT_TRUE(contains(falling.why(), "falls freely: there is no ground")) << falling.why();
  const Verdict through = with({"contact.on=none"});
  EXPECT_NE(through.word, Word::feasible) << through.why();
  EXPECT_EQ(
      with({"ground.type=none", "robot.base=fixed", "physics.gravity=[0, 0, 0]", "cpg.amplitude=0.1", "duration=14"}).word,
      Word::feasible)
      << "of a fixed base nothing is asked";
}

/// Keyframes that are played once at the start are the whole gait. A long rest after them does not change the verdict.
TEST(Earned, FramesPlayedOnce) {
  const auto bend = [](double end) {
    return Told(shipped("caterpillar.yaml",
                        {"physics.engine=articulated", "duration=20", "cpg.type=keyframes", "cpg.model.repeat=false",
                         fmt::format("cpg.model.frames=[{{time: 0, angles: 0}}, {{time: {}, angles: "
                                     "{{default: 0, m0/active: 0.4}}}}]",
                                     end)}));
  };
  const Told quick = bend(0.1);
  EXPECT_EQ(quick.made.from, 0);
  EXPECT_EQ(quick.check("voltage").status, CheckStatus::fail) << quick.check("voltage").text;
  EXPECT_LT(quick.check("voltage").to, 1);
  EXPECT_EQ(quick.made.word, Word::infeasible);
  const Told slow = bend(2);
  EXPECT_EQ(slow.made.word, Word::feasible) << slow.made.why();
  EXPECT_EQ(slow.made.rests_on, "the 20 s of the run; the set points do not repeat");
}

/// Wheels have no period, also if the settings contain a frequency that their CPG does not use. They are judged after 2 s.
TEST(Earned, WheelsAreJudgedAfterTwoSeconds) {
  const auto drive = [](const char* duration) { return Told(shipped("library/linkbot-drive.yaml", {duration})).made; };
  EXPECT_EQ(drive("duration=6").word, Word::feasible) << drive("duration=6").why();
  EXPECT_EQ(drive("duration=6").rests_on, "the 6 s of the run; the set points do not repeat");
  EXPECT_EQ(drive("duration=3").word, Word::feasible) << drive("duration=3").why();
  EXPECT_EQ(drive("duration=1").word, Word::not_judged);
}

/// If the run is shorter than a period of the CPG, the period of the CPG counts, and not the duration of the run.
TEST(Earned, FramesThatRepeatHaveTheirPeriod) {
  const Told brief(
      shipped("caterpillar.yaml", {"physics.engine=articulated", "duration=3", "cpg.type=keyframes",
                                   "cpg.model.frames=[{time: 0, angles: 0}, {time: 0.8, angles: 0.2}, {time: 2, angles: 0}]"}));
  EXPECT_EQ(brief.made.word, Word::not_judged);
  EXPECT_TRUE(contains(brief.made.why(), "3 s contain only 1.5 of the 3 periods of 2 s that a gait needs; take duration: 6"))
      << brief.made.why();
}

/// A base that turns over at every hop, by the angles of its hinges, does not count as rolling, nor the robot as turned over.
TEST(Earned, ABaseThatTipsOverIsNoRolling) {
  const Told hops(shipped("hexapod.yaml", {"physics.engine=articulated", "contact.on=all", "duration=3",
                                           "cpg={type: sine, frequency: 2.4, amplitude: 0.9, phase_lag: 0}",
                                           "actuator.u_max=20", "actuator.i_max=6"}));
  EXPECT_FALSE(upright(hops.scenario, hops.record, hops.summary.judged, 0)->rolls);
  EXPECT_EQ(hops.check("upright").status, CheckStatus::pass) << hops.check("upright").text;
}

/// The check with the least margin decides the verdict. In a run that is too short, only failures count that more time cannot
/// undo.
TEST(Earned, TheHeadlineIsTheLeastMargin) {
  const Told wide(shipped("caterpillar.yaml", {"physics.engine=articulated", "duration=12", "cpg.amplitude=1.7"}));
  const std::vector<const Check*> failures = wide.made.failures();
  ASSERT_GT(failures.size(), 1U);
  for (const Check* const check : failures) EXPECT_GE(check->margin, failures.front()->margin) << check->id;
  EXPECT_EQ(wide.made.decided_by, failures.front()->id);
  EXPECT_EQ(wide.made.why(), failures.front()->sentence());
  EXPECT_EQ(wide.made.tightest(), failures.front());
  const Told brief(shipped("caterpillar.yaml", {"physics.engine=articulated", "duration=3", "cpg.amplitude=1.7"}));
  ASSERT_EQ(brief.made.word, Word::infeasible);
  EXPECT_EQ(brief.check(brief.made.decided_by).span, CheckSpan::whole_run);
}

/// V14: the terminal and the check name the same worst joint.
TEST(Earned, TheTerminalNamesTheJointOfTheCheck) {
  const Told wide(shipped("caterpillar.yaml", {"physics.engine=articulated", "duration=12", "cpg.amplitude=1.7"}));
  const Check& stops = wide.check("stops");
  ASSERT_EQ(stops.status, CheckStatus::fail);
  std::size_t worst = 0;
  const auto margin = [&](std::size_t j) {
    const JointStatistics& joint = wide.record.joints[j];
    return std::min((0.01 - joint.range_worst) / 0.01, (0.01 - joint.range_share) / 0.01);
  };
  for (std::size_t j = 1; j < wide.record.joints.size(); ++j) worst = margin(j) < margin(worst) ? j : worst;
  EXPECT_EQ(stops.worst, wide.scenario.robot->joints[worst].name);
  EXPECT_TRUE(contains(stops.text, "worst " + stops.worst + ": ")) << stops.text;
  std::string screen;
  for (const ScreenLine& line : first_screen({wide.scenario, wide.record, wide.summary}, wide.made, 4))
    screen += line.text + " ";
  for (const Check& check : wide.made.checks) {
    if (check.status != CheckStatus::fail || check.worst.empty()) continue;
    EXPECT_TRUE(contains(screen, check.worst)) << check.id << ": " << screen;
  }
}

/// The first screen of output is short for every run, and its lines fit into a terminal.
TEST(Earned, TheFirstScreenIsShort) {
  for (const std::vector<std::string>& sets :
       {std::vector<std::string>{}, {"actuator.i_max=0.35"}, {"cpg.amplitude=1.7"}, {"duration=1"}}) {
    std::vector<std::string> all{"physics.engine=articulated", "duration=12"};
    all.insert(all.end(), sets.begin(), sets.end());
    const Told run(shipped("caterpillar.yaml", all));
    const std::vector<ScreenLine> lines = first_screen({run.scenario, run.record, run.summary}, run.made, 4);
    EXPECT_LE(lines.size(), sets.empty() ? 9U : 26U);
    for (const ScreenLine& line : lines) {
      EXPECT_LE(line.text.size(), 88U) << line.text;
      if (line.title == "unknown") {
        EXPECT_EQ(line.text.find("docks"), line.text.rfind("docks")) << "one word for four checks: " << line.text;
      }
    }
  }
}

}  // namespace
}  // namespace gaitlab::test
