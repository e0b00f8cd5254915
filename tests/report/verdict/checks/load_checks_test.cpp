// Tests of the checks of docks, slip and stability with runs whose recordings are changed.
#include <limits>

#include "core/model/pattern.h"
#include "report/verdict/checks/loads.h"
#include "report/verdict/verdict.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;

constexpr double kUnknownLimit = std::numeric_limits<double>::quiet_NaN();

/// Run of the caterpillar for 4 s with loads. Tests change its recording.
struct LoadCase {
  Scenario scenario = shipped("caterpillar.yaml", {"duration=4", "physics.engine=articulated"});
  Recording record = recorded(scenario);

  static Recording recorded(const Scenario& scenario) {
    Simulation simulation({&scenario, 1}, Loads::recorded);
    simulation.run();
    return simulation.take_recording(0);
  }
  /// Sets a column of the loads in all rows from row `from` on.
  void set(const std::string& column, double value, std::size_t from = 0) {
    const std::size_t at = record.loads.find(column);
    for (std::size_t row = from; row < record.loads.rows(); ++row)
      record.loads.values.at(row * record.loads.columns.size() + at) = value;
  }
  [[nodiscard]] std::size_t last() const { return record.loads.rows() - 1; }
  [[nodiscard]] Summary summary() const { return summarise(scenario, record, 0); }
  [[nodiscard]] Check check(const std::string& id) const {
    const Verdict made = verdict(scenario, record, summary(), overlaps(scenario, record));
    const auto found = std::ranges::find(made.checks, id, &Check::id);
    return found != made.checks.end() ? *found : Check();
  }
  [[nodiscard]] Check docks(DockQuantity quantity, const std::vector<double>& limits) const {
    Check made;
    made.value = made.limit = made.from = made.to = kUnknownLimit;
    judge_docks(scenario, record, quantity, limits, made);
    return made;
  }
};

LoadCase& crawl() {
  static LoadCase made;
  return made;
}

TEST(LoadChecks, NameTheDockThatBearsMost) {
  const std::tuple<const char*, const char*, const char*> all[] = {
      {"dock_tension", "tension", "m3's dock is pulled apart by up to 77 N"},
      {"dock_shear", "shear", "m3's dock is sheared by up to 77 N"},
      {"dock_bending", "bending", "m3's dock is bent by up to 77 N m"},
      {"dock_torsion", "torsion", "m3's dock is twisted by up to 77 N m"}};
  for (const auto& [id, column, text] : all) {
    LoadCase made = crawl();
    made.set(fmt::format("dock.3.{}", column), 77, made.last());
    const Check check = made.check(id);
    EXPECT_EQ(check.status, CheckStatus::not_judged) << "no module type states a limit";
    EXPECT_EQ(check.value, 77);
    EXPECT_EQ(check.from, 4);
    EXPECT_TRUE(contains(check.text, text)) << check.text;
    EXPECT_TRUE(contains(check.text, "do not state")) << check.text;
  }
}

TEST(LoadChecks, HoldDocksAgainstTheirLimits) {
  LoadCase made = crawl();
  for (int m = 1; m < 8; ++m) made.set(fmt::format("dock.{}.bending", m), 0.1);
  made.set("dock.2.bending", 5);
  made.set("dock.6.bending", 4);
  const auto with = [&](double second, double sixth) {
    return made.docks(DockQuantity::bending,
                      {kUnknownLimit, kUnknownLimit, second, kUnknownLimit, kUnknownLimit, kUnknownLimit, sixth});
  };
  EXPECT_EQ(with(10, 5.1).status, CheckStatus::pass);
  EXPECT_EQ(with(10, 5.1).limit, 5.1) << "4 of 5.1 is nearer than 5 of 10";
  EXPECT_EQ(with(10, 4.5).status, CheckStatus::warn) << "above the margin of 80 %";
  EXPECT_EQ(with(10, 3.9).status, CheckStatus::fail);
  EXPECT_EQ(with(10, 3.9).parts, 1U);
  EXPECT_EQ(with(4, 3.9).parts, 2U);
  EXPECT_EQ(with(kUnknownLimit, 5.1).status, CheckStatus::pass) << "docks of which nothing is stated do not count";
  EXPECT_EQ(with(kUnknownLimit, kUnknownLimit).status, CheckStatus::not_judged);
  EXPECT_EQ(with(kUnknownLimit, kUnknownLimit).value, 5);
}

/// Run of the caterpillar with these connectors on its active and passive faces.
LoadCase connected(const Connector& active, const Connector& passive) {
  LoadCase made = crawl();
  Robot robot = *made.scenario.robot;
  for (ModuleType& type : robot.types) {
    type.connectors = {{"hook", active}, {"eye", passive}};
    for (FaceType& face : type.faces) face.connector = face.gender == Gender::active ? "hook" : "eye";
  }
  made.scenario.robot = std::make_shared<const Robot>(std::move(robot));
  return made;
}

TEST(LoadChecks, TakeTheSmallerLimitOfBothConnectors) {
  const LoadCase free = crawl();
  const double tension = free.check("dock_tension").value;  // 11.3 N at the dock of m5
  ASSERT_NEAR(tension, 11.3, 0.6);
  EXPECT_NEAR(free.check("dock_shear").value, 9.34, 0.5) << "at m6";
  const LoadCase held =
      connected({.tension = 110, .shear = 50, .source = "rofi.fi.muni.cz"}, {.tension = 20, .source = "chosen: test"});
  EXPECT_EQ(held.check("dock_tension").status, CheckStatus::pass);
  EXPECT_EQ(held.check("dock_tension").limit, 20);
  EXPECT_EQ(held.check("dock_tension").source, "chosen: test");
  EXPECT_TRUE(contains(held.check("dock_tension").text, "of what it holds by a chosen figure"))
      << held.check("dock_tension").text;
  EXPECT_EQ(held.check("dock_shear").limit, 50) << "the other states none";
  EXPECT_EQ(held.check("dock_shear").source, "rofi.fi.muni.cz");
  EXPECT_EQ(held.check("dock_bending").status, CheckStatus::not_judged);
  EXPECT_TRUE(contains(held.check("dock_bending").text, "do not state"));
  const double limit = 0.97 * tension;  // about 11 N
  const LoadCase weak = connected({.tension = limit}, {.tension = 1000});
  EXPECT_EQ(weak.check("dock_tension").status, CheckStatus::fail);
  EXPECT_EQ(weak.check("dock_tension").source, "chosen: no source stated");
  EXPECT_TRUE(contains(weak.check("dock_tension").text, "of what it holds by a chosen figure"));
  EXPECT_TRUE(contains(weak.check("dock_tension").text, "m5's dock is pulled apart")) << weak.check("dock_tension").text;
  const Verdict made = verdict(weak.scenario, weak.record, weak.summary(), overlaps(weak.scenario, weak.record));
  EXPECT_EQ(made.word, Word::infeasible);
}

TEST(LoadChecks, OfATensionOnlyThePullCounts) {
  LoadCase made = crawl();
  for (int m = 1; m < 8; ++m) {
    made.set(fmt::format("dock.{}.tension", m), -50);
    made.set(fmt::format("dock.{}.torsion", m), -50);
  }
  EXPECT_EQ(made.check("dock_tension").value, -50);
  EXPECT_TRUE(contains(made.check("dock_tension").text, "no dock is pulled apart"));
  EXPECT_EQ(made.check("dock_torsion").value, 50);
}

/// Loads of docks are judged in the whole run, because a dock that opens remains open.
TEST(LoadChecks, AreOfTheWholeRun) {
  ASSERT_GT(crawl().summary().judged.first_row, 1U);
  const auto with = [&](std::size_t row) {
    LoadCase made = crawl();
    made.set("dock.1.shear", 500, row);
    made.set("dock.1.shear", 1, row + 1);
    return made.check("dock_shear");
  };
  for (const std::size_t row : {std::size_t{0}, std::size_t{1}, crawl().last() - 1}) {
    EXPECT_EQ(with(row).value, 500) << row;
    EXPECT_EQ(with(row).from, crawl().record.loads.at(row, 0)) << row;
  }
}

TEST(LoadChecks, WarnOfFeetThatSlide) {
  const auto with = [&](double slip, double path, const char* foot = "foot.m3/active.slid") {
    LoadCase made = crawl();
    for (const Column& column : made.record.loads.columns) {
      if (glob("foot.*.slid", column.name)) made.set(column.name, 0);
    }
    for (const char* const sum : {"slip", "path"}) made.set(sum, 0);
    made.set("slip", slip, made.last());
    made.set("path", path, made.last());
    made.set(foot, 0.123, made.last());
    return made.check("slip");
  };
  EXPECT_EQ(with(0.019, 0.1).status, CheckStatus::pass);
  EXPECT_NEAR(with(0.019, 0.1).value, 0.19, 1e-12);
  EXPECT_EQ(with(0.021, 0.1).status, CheckStatus::warn);
  EXPECT_EQ(with(5, 0.1).status, CheckStatus::warn) << "it never fails";
  EXPECT_EQ(with(kUnknownLimit, 0.1).status, CheckStatus::warn) << "not a number is not a pass";
  EXPECT_EQ(with(0.001, 0.005).status, CheckStatus::not_judged) << "it goes nowhere";
  EXPECT_TRUE(contains(with(0.021, 0.1).text, "of the way of 100 mm; farthest foot m3/active, 123 mm"))
      << with(0.021, 0.1).text;
  LoadCase lenient = crawl();
  lenient.scenario.limits.slip = 1e-6;
  EXPECT_EQ(lenient.check("slip").status, CheckStatus::warn);
}

/// The text of a check names a foot by its leg, as figures and pages do.
TEST(LoadChecks, NameAFootByItsLeg) {
  LoadCase made{shipped("hexapod.yaml", {"duration=1", "physics.engine=articulated"})};
  for (const Column& column : made.record.loads.columns) {
    if (glob("foot.*.slid", column.name)) made.set(column.name, 0);
  }
  made.set("foot.m9/passive.slid", 0.123, made.last());
  const Check slip = made.check("slip");
  EXPECT_TRUE(contains(slip.text, "farthest foot front left, 123 mm")) << slip.text;
  EXPECT_EQ(slip.worst, "m9/passive");  // name of the body, by which the page finds the foot
}

TEST(LoadChecks, NoteWhatStandsAndWhatFalls) {
  LoadCase made = crawl();
  made.set("stability", 0.02);
  EXPECT_EQ(made.check("stability").status, CheckStatus::pass);
  EXPECT_EQ(made.check("stability").value, 0.02);
  EXPECT_TRUE(contains(made.check("stability").text, "stays 20 mm within"));
  made.set("stability", -0.03, made.last());
  EXPECT_EQ(made.check("stability").status, CheckStatus::pass) << "a note";
  EXPECT_EQ(made.check("stability").value, -0.03);
  EXPECT_EQ(made.check("stability").from, 4);
  EXPECT_TRUE(contains(made.check("stability").text, "leaves the support polygon by up to 30 mm"))
      << made.check("stability").text;
  made.set("stability", kUnknownLimit);
  EXPECT_EQ(made.check("stability").status, CheckStatus::not_judged);
  EXPECT_EQ(made.check("stability").text, "no foot bears a load");
  made.scenario.ground.shape = Boxes{};
  EXPECT_TRUE(contains(made.check("stability").text, "plane"));
}

TEST(LoadChecks, DoNotAssumeWhatTheyDoNotKnow) {
  constexpr const char* kIds[] = {"dock_tension", "dock_shear", "dock_bending", "dock_torsion", "slip", "stability"};
  LoadCase old = crawl();
  old.record.loads = {};
  LoadCase solver = crawl();
  solver.scenario.contact.law = ContactLaw::solver;
  for (const char* const id : kIds) {
    EXPECT_EQ(old.check(id).status, CheckStatus::not_judged) << id;
    EXPECT_TRUE(contains(old.check(id).text, "not recorded")) << id;
    EXPECT_EQ(solver.check(id).status, CheckStatus::not_judged) << id;
    EXPECT_TRUE(contains(solver.check(id).text, "contact.law: bullet")) << id;
  }
  LoadCase held = crawl();
  held.scenario.base = Base::fixed;
  EXPECT_EQ(held.check("slip").status, CheckStatus::not_judged);
  EXPECT_EQ(held.check("dock_shear").text, crawl().check("dock_shear").text);
}

}  // namespace
}  // namespace gaitlab::test
