// Figures 9, 13 and 14 of Chariot, Filippi, Verlinden (2012) with a stiff position loop (docs/paper.md): axes of the figures,
// statements of the text, statics by hand, and the same numbers on both engines.
#include "report/analysis/summary.h"
#include "report/verdict/verdict.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

using Sets = std::vector<std::string>;

const Label kLongPaper("Paper.Figure*Caterpillar:Paper.Figure*Hexapod:Paper.Stiffness*:Paper.Default*", "long");
const Label kSlowPaper("Paper.Thirteen*:Paper.Eleven*:Paper.*OnBullet",
                       "long;unsanitized");  // engine bullet is ten times as slow

struct Extremes {
  double low = INFINITY, high = -INFINITY, rms = 0, negative = 0;  // N m or rad; share of the rows below 0
  [[nodiscard]] double peak() const { return std::max(-low, high); }
};

Extremes extremes(const Trace& trace, std::size_t joint, const std::string& quantity, double from, double to) {
  const Series t(trace, 0);
  const Series values(trace, trace.find(fmt::format("joint.{}.{}", joint, quantity)));
  Extremes made;
  double rows = 0;
  for (std::size_t row = 0; row < t.size(); ++row) {
    if (t[row] < from - 1e-9 || t[row] > to + 1e-9) continue;
    made.low = std::min(made.low, values[row]);
    made.high = std::max(made.high, values[row]);
    made.rms += values[row] * values[row];
    made.negative += values[row] < 0 ? 1 : 0;
    ++rows;
  }
  made.rms = std::sqrt(made.rms / rows);
  made.negative /= rows;
  return made;
}

/// A figure of the paper: its joint in its window, and the largest numbers of all other joints.
struct Figure {
  bool feasible = false;
  Extremes torque, angle;
  double next_peak = 0, next_rms = 0;  // N m
};

Figure figure(const Scenario& s, std::size_t joint, double from, double to) {
  const Recording made = run(s);
  Figure f;
  f.feasible = report::verdict(s, made, report::summarise(s, made, 0), report::overlaps(s, made)).word == Word::feasible;
  f.torque = extremes(made.trace, joint, "torque", from, to);
  f.angle = extremes(made.trace, joint, "angle", from, to);
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    if (j == joint) continue;
    const Extremes other = extremes(made.trace, j, "torque", from, to);
    f.next_peak = std::max(f.next_peak, other.peak());
    f.next_rms = std::max(f.next_rms, other.rms);
  }
  return f;
}

Figure caterpillar(const Sets& sets = {}) { return figure(shipped("paper-caterpillar.yaml", sets), 7, 6, 14); }
Figure paper_hexapod(const Sets& sets = {}) {
  const Scenario s = shipped("paper-hexapod.yaml", sets);
  EXPECT_EQ(s.robot->joints[5].name, "m2/passive");
  return figure(s, 5, 4, 8);
}

bool near(double value, double expected, double share) { return std::abs(value / expected - 1) <= share; }

/// Largest torque of the central spine joint of a rigid robot on three points, by hand (docs/paper.md). Lengths, m, are those
/// of the hexapod of M-TRAN modules (0.4 kg and 0.13 m each), in the stance of the tripod whose middle leg bears half of the
/// weight.
double statics(double amplitude) {
  constexpr double g = 9.81;
  const double stride = -0.065 * std::sin(amplitude);
  const double weight = 11 * 0.4 * g;
  const double middle = weight / 2;
  const double centre = (5 * 0.26 + 6 * 0.2925) / 11;
  const double front = (weight * centre - middle * (0.2925 + stride) - weight / 2 * (0.0325 + stride)) / 0.52;
  const double own = g * (0.8 * 0.26 + 0.4 * 0.2275 + 0.4 * 0.0975 + 0.16 * 0.003034);
  return own - front * (0.26 + stride) - middle * stride;
}

/// Statements that are not satisfied.
struct Unmet {
  Sets lines = {};
  void operator()(bool holds, const char* text) {
    if (!holds) lines.emplace_back(text);
  }
};

/// Statements on figure 9 and on the caterpillar's own numbers that are not satisfied. Torques have a tolerance of 4 %, because
/// each of the thirteen other settings changes one of them by more.
Sets unmet(const Figure& f) {
  Unmet line;
  line(f.feasible, "feasible");
  line(f.torque.rms > f.next_rms, "first by RMS");
  line(f.torque.high >= 1.3 && f.torque.high <= 2 && f.torque.low <= -1.3 && f.torque.low >= -2,
       "1.3 to 2.0 N m to both sides");
  line(near(f.torque.low, -1.45, 0.04) && near(f.torque.high, 1.44, 0.04) && near(f.torque.rms, 0.85, 0.04),
       "-1.45, +1.44, RMS 0.85");
  line(std::abs(f.angle.high - 0.6) < 0.005 && std::abs(f.angle.low + 0.6) < 0.005, "0.6 rad");
  return line.lines;
}

/// Statements on figures 13 and 14 and on the hexapod's own numbers that are not satisfied.
Sets unmet_spine(const Figure& f) {
  Unmet line;
  line(f.feasible, "feasible");
  line(f.torque.rms > f.next_rms, "first by RMS");
  line(f.next_peak <= 0.95 * f.torque.peak(), "first by peak");
  line(f.torque.low <= -1.0 && f.torque.low >= -1.2, "largest 1.0 to 1.2 N m");
  line(f.torque.high <= 0.06 && f.torque.negative >= 0.97, "one sign");
  line(near(-f.torque.low, statics(0.3), 0.15), "statics");
  line(near(f.torque.rms, 0.73, 0.04), "RMS 0.73");
  line(f.angle.peak() < 0.005, "angle at 0");
  return line.lines;
}

TEST(Paper, FigureNineIsMetByTheCaterpillar) { EXPECT_EQ(unmet(caterpillar()), Sets()); }

TEST(Paper, FiguresThirteenAndFourteenAreMetByTheHexapod) {
  const Figure f = paper_hexapod();
  EXPECT_EQ(unmet_spine(f), Sets());
  validate({"closed.spine_torque", "largest torque of the hexapod's central spine joint, paper-hexapod.yaml",
            "rigid robot on three points", "N m"},
           -f.torque.low, statics(0.3), 0.15 * statics(0.3),
           "the size alone: square feet stand on edges, and a stiffer loop has up to 20 % more (docs/paper.md)");
}

/// The formula of docs/paper.md, as printed there.
TEST(Paper, StaticsByHand) {
  const std::pair<double, double> printed[] = {{0.2, 0.97}, {0.3, 1.05}, {0.4, 1.13}, {0.6, 1.30}};
  for (const auto& [amplitude, torque] : printed) {
    const double s = 0.065 * std::sin(amplitude);
    EXPECT_NEAR(statics(amplitude), torque, 0.006);
    EXPECT_NEAR(statics(amplitude), 0.834 + 9.56 * s + 83 * s * s, 0.001) << amplitude;
  }
}

const char* const kOtherSettings[] = {"controller.Kp=100",
                                      "controller.Kp=785",
                                      "controller.Kp=1180",
                                      "controller.Kp=2356",
                                      "controller.Ki=500",
                                      "contact.stiffness=2e3",
                                      "contact.stiffness=5e3",
                                      "contact.stiffness=2e4",
                                      "contact.stiffness=4e4",
                                      "contact.slip_speed=0.001",
                                      "ground.friction=0.4",
                                      "actuator.efficiency=0.5",
                                      "actuator.efficiency_model=directional"};

/// The statements without those on the verdict, which would need a longer run.
Sets numbers(Sets lines) {
  std::erase(lines, "feasible");
  return lines;
}

/// Each of these settings violates a number or a rank of figure 9 (table in docs/paper.md).
TEST(Paper, ThirteenOtherSettingsMissIt) {
  EXPECT_EQ(numbers(unmet(caterpillar({"duration=14"}))), Sets());
  for (const char* const set : kOtherSettings) EXPECT_NE(numbers(unmet(caterpillar({set, "duration=14"}))), Sets()) << set;
}

/// All but two of the settings above also violate a number or a rank of figures 13 and 14.
TEST(Paper, ElevenOfThemMissTheSpineToo) {
  EXPECT_EQ(numbers(unmet_spine(paper_hexapod({"duration=8"}))), Sets());
  for (const std::string set : kOtherSettings) {
    const bool met = set == "contact.stiffness=5e3" || set == "ground.friction=0.4";
    EXPECT_EQ(numbers(unmet_spine(paper_hexapod({set, "duration=8"}))).empty(), met) << set;
  }
}

/// A control period up to the longest that works changes nothing. With a tenth of the resistance, the loop works at the paper's
/// 15 ms. The stiffness alone therefore decides the torques.
TEST(Paper, StiffnessDecidesNotThePeriod) {
  EXPECT_EQ(unmet(caterpillar({"controller.period=0.0025"})), Sets());
  EXPECT_EQ(unmet_spine(paper_hexapod({"controller.period=0.0025"})), Sets());
  const Sets strong{"controller.period=0.015", "actuator.R=0.43", "controller.Kp=157"};
  const Extremes slow =
      caterpillar(strong).torque;  // the tolerance of 3 % is for a command every 15 ms instead of every millisecond
  EXPECT_TRUE(near(slow.low, -1.45, 0.03) && near(slow.high, 1.44, 0.03)) << slow.low << " " << slow.high;
  EXPECT_TRUE(near(paper_hexapod(strong).torque.low, -1.08, 0.03));
  // Directional gears at rest are between both directions, so that Kp 1099 is 600 N m/rad. The gears differ if the joint moves;
  // the measured difference is 4.6 %. A spine joint at rest sticks, and can bear a small torque of the other sign.
  const Sets directional{"actuator.efficiency_model=directional", "controller.Kp=1099"};
  const Extremes driven = caterpillar(directional).torque;
  EXPECT_TRUE(near(driven.low, -1.45, 0.06) && near(driven.high, 1.44, 0.06)) << driven.low << " " << driven.high;
  EXPECT_EQ(unmet_spine(paper_hexapod(directional)), Sets{"one sign"});
}

/// Tests the scenarios with the default gains, which a real module can have. The tolerances are the last digit in
/// docs/paper.md.
TEST(Paper, DefaultGainsHaveAThirdOfTheTorque) {
  const Extremes joint = figure(shipped("caterpillar.yaml", {"physics.engine=articulated"}), 7, 6, 14).torque;
  EXPECT_TRUE(near(joint.low, -0.61, 0.01) && near(joint.high, 0.51, 0.01)) << joint.low << " " << joint.high;
  const Extremes spine = figure(shipped("hexapod.yaml", {"physics.engine=articulated"}), 5, 4, 8).torque;
  EXPECT_TRUE(near(spine.low, -0.40, 0.02)) << spine.low;
}

/// Both engines have the same peaks within 0.5 %, half of the physics.accuracy of one engine (1 %). The measured difference is
/// 0.1 %.
void expect_equal(const Figure& a, const Figure& b) {
  for (const auto& [one, other] :
       {std::pair(a.torque.low, b.torque.low), {a.torque.rms, b.torque.rms}, {a.next_peak, b.next_peak}})
    EXPECT_TRUE(near(one, other, 0.005)) << one << " " << other;
  EXPECT_LT(std::abs(a.torque.high - b.torque.high), 0.005 * a.torque.peak());
}

TEST(Paper, FigureNineIsMetOnBullet) {
  const Figure f = caterpillar({"physics.engine=bullet"});
  EXPECT_EQ(unmet(f), Sets());
  expect_equal(f, caterpillar());
}

TEST(Paper, FiguresThirteenAndFourteenAreMetOnBullet) {
  const Figure f = paper_hexapod({"physics.engine=bullet"});
  EXPECT_EQ(unmet_spine(f), Sets());
  expect_equal(f, paper_hexapod());
}

}  // namespace
}  // namespace gaitlab::test
