// Tests of the footfall diagram and of the figure of a legged robot. The expected values are counted by hand.
#include "report/figures/run/footfall.h"

#include <limits>

#include "report/analysis/legs.h"
#include "report/figures/paper/run_figure.h"
#include "report/plot/svg.h"
#include "tests/labels.h"
#include "tests/program/fixture.h"
#include "tests/report/sample.h"

namespace gaitlab::test {
namespace {

// Whole walks, each of which takes two seconds under the sanitizers.
const Label kFootfalls("Footfall.*", "long;unsanitized");

using namespace report;
using sample::count;

TEST(Footfall, StancesLastFromOneSampleToTheNext) {
  const std::vector<double> time{0, 1, 2, 3, 4, 5};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto found = stances(time, std::vector<double>{2, 1, 3, nan, 4, 5}, 1);
  ASSERT_EQ(found.size(), 3U);  // a load equal to the threshold does not count
  EXPECT_EQ(found[0].from, 0);
  EXPECT_EQ(found[0].to, 1);
  EXPECT_EQ(found[1].from, 2);
  EXPECT_EQ(found[1].to, 3);
  EXPECT_EQ(found[2].from, 4);
  EXPECT_EQ(found[2].to, 5);
  EXPECT_TRUE(stances({}, {}, 1).empty());
}

TEST(Footfall, DutyFactorIsTheShareOfTheStretch) {
  const std::vector<Stance> found{{0, 1}, {2, 3}, {4, 5}};
  EXPECT_DOUBLE_EQ(duty_factor(found, 0, 5), 0.6);
  EXPECT_DOUBLE_EQ(duty_factor(found, 0.5, 2.5), 0.5);
  EXPECT_DOUBLE_EQ(duty_factor(found, 1, 2), 0);
  EXPECT_DOUBLE_EQ(duty_factor(found, 5, 5), 0);
}

TEST(Footfall, DrawsABarAStanceAndJoinsWhatNobodySees) {
  Svg svg(1000, 100);
  const Ticks time = ticks_within(10, 18, 8);
  // One footfall before the panel, one across its edge, two separated by 1 ms, and one near the end.
  const Footfall row{"front left", {{8, 9}, {9.5, 11}, {12, 13}, {13.001, 14}, {17, 19}}, 0.625};
  const std::vector<Footfall> rows{row};
  draw_footfalls(svg, rows, {.ticks = time, .texts = false}, {120, 920, 30, 54});
  const std::string text = svg.finish();
  EXPECT_EQ(count(text, "height=\"12\""), 3U);
  EXPECT_NE(text.find("width=\"100\" height=\"12\""), std::string::npos);  // from 10 to 11 s
  EXPECT_NE(text.find("width=\"200\" height=\"12\""), std::string::npos);  // from 12 to 14 s
  for (const std::string part : {">front left<", ">0.62<", ">duty factor<"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(Footfall, CentralSpineJointIsThePapers) {
  const RobotInfo robot = info(*shipped("hexapod.yaml").robot);
  const std::vector<Leg> legs = robot.legs;
  EXPECT_EQ(central_spine_joint(robot, legs), 5U);  // joint of the paper; joint 4 is as close to the middle, but behind it
  RobotInfo turned = robot;
  for (JointInfo& joint : turned.joints) joint.axis = {0, 0, 1};
  EXPECT_EQ(central_spine_joint(turned, legs), 5U) << "no joint bends it up and down: the middle one";
}

struct Shown {
  explicit Shown(const std::string& name) : scenario(shipped(name, {"duration=4"})), record(run(scenario)) {}
  Scenario scenario;
  Recording record;
};

const Shown& shown_hexapod() {
  static const Shown walked("hexapod.yaml");
  return walked;
}

TEST(Footfall, LoadsAreTheSumsOfTheContactColumns) {
  const Robot& robot = *shown_hexapod().scenario.robot;
  const Recording& r = shown_hexapod().record;
  const Table table(r.trace);
  const auto contacts = contact_elements(robot, ContactSet::feet);
  double most = 0;
  for (std::size_t tick = 0; tick < r.rows(); ++tick) {
    std::vector<double> sum(robot.modules.size(), 0.0);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      sum[robot.bodies[contacts[c].body].module] += table.at(tick, fmt::format("contact.{}.fn", c));
    }
    for (std::size_t m = 0; m < sum.size(); ++m) {
      most = std::max(most, sum[m]);
      const Series load = r.series(fmt::format("load.{}", m));
      ASSERT_EQ(load.empty() ? 0.0 : load[tick], sum[m]) << tick << " m" << m;
    }
  }
  EXPECT_GT(most, 5);
}

TEST(Footfall, FigureOfAHexapodShowsItsGait) {
  const auto& [scenario, record] = shown_hexapod();
  const Summary summary = summarise(scenario, record, 0);
  const std::string svg = run_figure(scenario, record, summary);
  EXPECT_EQ(svg, run_figure(scenario, record, summary));
  for (const std::string part :
       {"joint 5 (m2/passive), middle of the spine", ">front left<", ">front right<", ">middle left<", ">middle right<",
        ">rear left<", ">rear right<", "load above 2 % of the weight", "front at the right, moves to the right<",
        ", most loaded", "arrow: m", "centre of mass", "far side"}) {
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  }
  // The figure has five views a fifth of the 2 s cycle apart, also without a limit cycle (ramp of 1 s, duration of 4 s).
  for (const std::string part : {">2 s<", ">2.4 s<", ">2.8 s<", ">3.2 s<", ">3.6 s<"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  EXPECT_EQ(count(svg, "paint-order"), 5U * 33U);
}

/// A long run keeps every k-th row, so that rows are k trace periods apart. Its figure still has all views.
TEST(Footfall, FigureOfReducedRowsHasItsViews) {
  Scenario scenario = shown_hexapod().scenario;
  Recording record = shown_hexapod().record;
  const std::string all = run_figure(scenario, record, summarise(scenario, record, 0));
  const std::size_t rows = record.rows();
  const auto reduced = thin_rows(record, 8 * (record.trace.values.size() + record.rest.values.size()) / 10);
  ASSERT_TRUE(reduced.has_value());
  EXPECT_LT(record.rows(), rows / 8);
  scenario.trace.period *= static_cast<double>(reduced->stride);
  const std::string svg = run_figure(scenario, record, summarise(scenario, record, 0));
  EXPECT_EQ(count(svg, "paint-order"), count(all, "paint-order"));
}

TEST(Footfall, LongPeriodsAreCutAndEarlyEndsDrawn) {
  const auto& [scenario, record] = shown_hexapod();
  Summary summary = summarise(scenario, record, 0);
  summary.limit_cycle = {true, 0, 6, 0.001};  // limit cycle of three periods of the gait
  const std::string svg = run_figure(scenario, record, summary);
  for (const std::string part : {">0 s<", ">0.8 s<", ">3.2 s<", "side view over the last 4 s"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  Recording first = record;  // becomes a run that ends at its first row
  for (Trace* table : {&first.trace, &first.rest}) table->values.resize(table->columns.size());
  summary.simulated = 0;
  summary.limit_cycle = {};
  EXPECT_EQ(count(run_figure(scenario, first, summary), "paint-order"), 33U);
}

TEST(Footfall, WithoutContactsTheFigureIsTheCommonOne) {
  Scenario scenario = shown_hexapod().scenario;
  scenario.contact.on = ContactSet::none;
  const Summary summary = summarise(shown_hexapod().scenario, shown_hexapod().record, 0);
  const std::string svg = run_figure(scenario, shown_hexapod().record, summary);
  EXPECT_EQ(svg.find("footfall"), std::string::npos);
  EXPECT_NE(svg.find("side view (arrow: m"), std::string::npos);
}

}  // namespace
}  // namespace gaitlab::test
