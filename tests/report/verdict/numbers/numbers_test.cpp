// The list of summary numbers agrees with summary.json and docs/numbers.md.
#include "report/verdict/numbers/numbers.h"

#include <nlohmann/json.hpp>
#include <set>

#include "report/verdict/numbers/summary_text.h"
#include "tests/folders.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using namespace report;

using Json = nlohmann::ordered_json;

/// A log of rest of two joints, with every quantity.
std::shared_ptr<const MeasuredLog> log_of(const Scenario& scenario) {
  MeasuredLog log{{0, 0.1, 0.2}, {}, {}};
  for (const std::size_t joint : {std::size_t{0}, scenario.robot->joints.size() - 1}) {
    log.joints.push_back({joint, {}});
    for (std::vector<double>& values : log.joints.back().values) values = {0, 0, 0};
  }
  return std::make_shared<const MeasuredLog>(std::move(log));
}

struct Walk {
  Scenario scenario = [] {
    Scenario made =
        shipped("caterpillar.yaml", {"physics.engine=articulated", "duration=0.5", "supply.voltage=7.4", "supply.capacity=1"});
    made.measured.log = log_of(made);
    return made;
  }();
  Recording record = [this] {
    Recording made = run(scenario);
    for (const char* column : {"torque_peak", "torque_rms", "distance", "margin"})
      made.spread.columns.push_back({column, "", ""});
    made.spread.values = {1, 2, 3, 4};  // a predictable run has no spread, and the group is null
    return made;
  }();
  Summary summary = summarise(scenario, record, 1);
  Json json = Json::parse(to_json(summary, scenario, record));
};

/// Row of a summary number, as the table of docs/numbers.md must contain it.
std::string row(const SummaryNumber& number) {
  return fmt::format("| `{}` | {} | {} |\n", number.key, number.unit, number.definition);
}

TEST(Numbers, EveryEntryIsInTheSummaryAndInTheDocs) {
  const Walk walk;
  const std::string docs = read(std::string(gaitlab::test::source_folder()) + "/docs/numbers.md");
  std::string table;
  for (const SummaryNumber& number : summary_numbers()) {
    EXPECT_TRUE(std::string(number.definition).ends_with('.')) << number.key << ": a definition is a sentence";
    EXPECT_NE(number.value == nullptr, number.of_joint == nullptr) << number.key << ": of the run, or of every joint";
    for (const std::string joint : {"m0/active", "m7/passive"}) {
      const Json::json_pointer at(number.pointer(joint));
      EXPECT_TRUE(walk.json.contains(at)) << at;
    }
    table += row(number);
  }
  const std::string head = "| key | unit | definition |\n|---|---|---|\n";
  EXPECT_NE(docs.find(head + table + "\n"), std::string::npos)
      << "docs/numbers.md is stale; its table of summary numbers should be\n"
      << head << table;
}

/// No two entries have the same place in the order of display, and every displayed entry has a text.
TEST(Numbers, EveryPlaceIsTakenOnceAndHasItsText) {
  const auto once = [](const auto& shown, auto place) {
    std::set<int> places;
    for (const SummaryNumber* number : shown) EXPECT_TRUE(places.insert(place(*number)).second) << number->key;
    EXPECT_FALSE(places.empty());
  };
  once(placed(&SummaryNumber::line), [](const SummaryNumber& n) { return n.line.place; });
  once(placed(&SummaryNumber::compare), [](const SummaryNumber& n) { return n.compare.place; });
  once(placed(&SummaryNumber::golden), [](const SummaryNumber& n) { return n.golden.place; });
  once(placed(&SummaryNumber::swap), [](const SummaryNumber& n) { return n.swap.place; });
  for (const SummaryNumber& number : summary_numbers()) {
    EXPECT_EQ(number.line.place > 0, number.line.text != nullptr) << number.key;
    EXPECT_EQ(number.swap.place > 0, number.swap.cell != nullptr) << number.key;
  }
}

/// Every key of summary.json has an entry in the list.
TEST(Numbers, TheSummaryHoldsNothingElse) {
  const Walk walk;
  Json rest = walk.json.flatten();
  for (const SummaryNumber& number : summary_numbers()) {
    for (const Joint& joint : walk.scenario.robot->joints) {
      const std::string at = number.pointer(joint.name);
      std::vector<std::string> known;
      for (const auto& [key, value] : rest.items()) {
        if (key == at || key.starts_with(at + "/")) known.push_back(key);
      }
      for (const std::string& key : known) rest.erase(key);
    }
  }
  EXPECT_TRUE(rest.empty()) << rest.dump(2);
}

/// The time of the largest tracking error agrees with a trace with a row per step. Rows contain left limits, so that a row
/// contains the set point of the step before it, which starts at the previous row.
TEST(Numbers, TheWorstTrackingErrorIsWhereTheTraceHasIt) {
  const Scenario s = shipped("caterpillar.yaml", {"physics.step=2.5e-5", "duration=0.3", "trace.period=2.5e-5"});
  const Recording r = run(s);
  const Json worst = Json::parse(to_json(summarise(s, r, 1), s, r)).at("tracking_error");
  const double largest = worst.at("worst");
  const double h = s.physics.step;
  const Table table(r.trace);
  for (std::size_t j = 0; j < r.joints.size(); ++j) {
    const auto error = [&](std::size_t row) {
      return std::abs(table.at(row, fmt::format("joint.{}.setpoint", j)) - table.at(row, fmt::format("joint.{}.angle", j)));
    };
    const double moved = h * r.joints[j].speed_peak;  // largest motion of the joint during a step
    for (std::size_t row = 1; row < r.trace.rows(); row += 40) EXPECT_LE(error(row), largest + moved) << j;
    if (worst.at("joint") != s.robot->joints[j].name) continue;
    EXPECT_NEAR(error(static_cast<std::size_t>(std::llround(worst.at("time").get<double>() / h)) + 1), largest, moved);
  }
  EXPECT_GT(worst.at("time"), 0);  // the set points start at the angles
  EXPECT_GT(largest, 0.01);

  const Scenario still = shipped("pendulum.yaml", {"duration=0.1"});
  const Recording swings = run(still);
  EXPECT_TRUE(Json::parse(to_json(summarise(still, swings, 1), still, swings)).at("tracking_error").is_null());
}

/// The time of a torque peak is that of the largest torque in a trace that has a row per step, or one step earlier. A new
/// command acts from the start of a step, whose row contains the old command, and its torque decays with the back-EMF.
TEST(Numbers, TheTimeOfAPeakIsWhereTheTraceHasIt) {
  const Scenario s = shipped("caterpillar.yaml", {"physics.step=2.5e-5", "duration=0.1", "trace.period=2.5e-5"});
  const Recording r = run(s);
  const Table table(r.trace);
  for (std::size_t j = 0; j < r.joints.size(); ++j) {
    std::size_t largest = 0;
    const auto torque = [&](std::size_t k) { return std::abs(table.at(k, fmt::format("joint.{}.torque", j))); };
    for (std::size_t k = 1; k < r.trace.rows(); ++k) largest = torque(k) > torque(largest) ? k : largest;
    const std::int64_t start = std::llround(r.joints[j].torque_peak_time / s.physics.step);
    EXPECT_TRUE(start == static_cast<std::int64_t>(largest) || start + 1 == static_cast<std::int64_t>(largest)) << j;
    EXPECT_GE(r.joints[j].torque_peak, torque(largest)) << j;
    EXPECT_LT(r.joints[j].torque_peak, 1.3 * torque(largest)) << j;  // the torque of the lightest joint falls 19 % in a step
  }
}

TEST(Numbers, NamesAreMadeFromKeyAndUnit) {
  for (const SummaryNumber& number : summary_numbers()) {
    const std::string key = number.key;
    if (key == "displacement.x") {
      EXPECT_EQ(number.pointer(), "/displacement/0");
      EXPECT_EQ(number.name(), "displacement.x");
      EXPECT_EQ(number.row(), "displacement x, m");
    }
    if (key != "per_joint.J.torque.peak") continue;
    EXPECT_EQ(number.pointer("m0/active"), "/per_joint/m0~1active/torque/peak");
    EXPECT_EQ(number.name("m0/active"), "m0/active.torque.peak");
    EXPECT_EQ(number.row("m0/active"), "m0/active torque peak, N m");
  }
}

}  // namespace
}  // namespace gaitlab::test
