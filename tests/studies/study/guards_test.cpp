// Tests of the guards of studies: every check of the verdict as a guard, with margins that satisfy or violate it.
#include "studies/study/guards.h"

#include <fmt/format.h>

#include <cmath>

#include "app/study/study_quantities.h"
#include "report/verdict/verdict.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {
namespace {

using studies::Guard;
using studies::Guards;
using Asks = studies::Guard::Asks;

const studies::QuantityOffer& offered() {
  static const studies::QuantityOffer kOffer = app::quantity_offer();
  return kOffer;
}

/// Guards of a study, and a run whose margins tests set.
class Guarded {
 public:
  explicit Guarded(std::vector<Guard> guards, bool guarded = true, bool of_energy = false) {
    study_.guards = std::move(guards);
    study_.guarded = guarded;
    for (const studies::Quantity& column : studies::columns_of(study_, offered(), {})) columns_.push_back(column.name);
    guards_ = Guards(study_, columns_, offered().checks, of_energy, problems_);
    values_.assign(columns_.size(), std::nan(""));
  }
  Guarded& set(const std::string& column, double value) {
    const auto at = std::ranges::find(columns_, column);
    EXPECT_NE(at, columns_.end()) << column;
    if (at != columns_.end()) values_[static_cast<std::size_t>(at - columns_.begin())] = value;
    return *this;
  }
  [[nodiscard]] double violation(Word word) const { return guards_.violation(values_, word); }
  [[nodiscard]] std::vector<std::string> broken(Word word, const std::string& why = "") const {
    return guards_.broken(values_, word, why);
  }
  [[nodiscard]] std::vector<std::string> texts() const { return guards_.texts(); }
  [[nodiscard]] std::string problem() const { return problems_.empty() ? "" : problems_.list().front().text; }

 private:
  studies::Study study_;
  std::vector<std::string> columns_;
  Problems problems_;
  Guards guards_;
  std::vector<double> values_;
};

TEST(Guards, OfEveryCheckAreKeptFromTheirMarginOnAndBrokenBelow) {
  ASSERT_EQ(offered().checks.size(), report::check_kinds().size());
  for (const studies::CheckOffer& check : offered().checks) {
    SCOPED_TRACE(check.id);
    const std::string own = "margin." + check.id;
    Guarded kept({{check.id, Asks::kept}});
    EXPECT_EQ(kept.violation(Word::feasible), 0) << "the run does not have it";
    EXPECT_EQ(kept.set(own, 0).violation(Word::feasible), 0);
    EXPECT_EQ(kept.set(own, -0.25).violation(Word::feasible), 0.2);
    EXPECT_EQ(kept.broken(Word::feasible),
              std::vector{fmt::format("check {} has a margin of -0.25; the study requires 0", check.id)});
    Guarded margin({{check.id, Asks::margin, 0.5}});
    EXPECT_EQ(margin.set(own, 0.5).violation(Word::feasible), 0);
    EXPECT_EQ(margin.set(own, 0.25).violation(Word::feasible), 0.2);
    EXPECT_EQ(margin.broken(Word::feasible),
              std::vector{fmt::format("check {} has a margin of 0.25; the study requires 0.5", check.id)});
    Guarded dropped({{check.id, Asks::nothing}});
    EXPECT_EQ(dropped.set(own, -0.25).violation(check.can_fail ? Word::infeasible : Word::feasible), 0);
    if (!check.limited) continue;
    Guarded limit({{check.id, Asks::limit, 0.1}});
    EXPECT_EQ(limit.set(own, -9).set(own + "[0.1]", 0).violation(check.can_fail ? Word::infeasible : Word::feasible), 0);
    EXPECT_EQ(limit.set(own, 9).set(own + "[0.1]", -0.25).violation(Word::feasible), 0.2);
  }
}

/// The default guards of a study are the checks that can fail. Checks that only warn are not guards.
TEST(Guards, OfTheVerdictAreTheChecksThatCanFail) {
  for (const studies::CheckOffer& check : offered().checks) {
    SCOPED_TRACE(check.id);
    Guarded verdict({});
    verdict.set("margin." + check.id, -0.25);
    EXPECT_EQ(verdict.violation(Word::infeasible), check.can_fail ? 0.2 : 0.5);
    EXPECT_EQ(verdict.broken(Word::infeasible, "a sentence"), std::vector<std::string>{"infeasible: a sentence"});
    Guarded none({}, false);
    EXPECT_EQ(none.set("margin." + check.id, -0.25).violation(Word::infeasible), 0);
    EXPECT_TRUE(none.broken(Word::infeasible, "a sentence").empty());
  }
}

TEST(Guards, AskForTheWordFeasible) {
  EXPECT_EQ(Guarded({}).set("margin.stops", -1e-9).violation(Word::feasible), 0) << "the word decides";
  Guarded verdict({});
  EXPECT_EQ(verdict.violation(Word::feasible), 0);
  for (const Word word : {Word::not_judged, Word::infeasible}) {
    EXPECT_EQ(verdict.violation(word), 0.5) << "no margin is negative";
    EXPECT_EQ(verdict.broken(word, "why"), std::vector{std::string(name_of(word)) + ": why"});
  }
  verdict.set("margin.stops", -0.5).set("margin.voltage", -0.25).set("margin.slip", -3);
  EXPECT_EQ(verdict.violation(Word::infeasible), 0.5 / 1.5 + 0.2) << "slip only warns";
  EXPECT_EQ(verdict.texts().front(), "feasible >= 1");
}

/// A study may require less of a check than the verdict. A run that only fails this check in the verdict is then kept.
TEST(Guards, MayAskLessThanTheVerdict) {
  Guarded guards({{"stops", Asks::limit, 0.1}});
  guards.set("margin.stops", -0.5).set("margin.stops[0.1]", 0.2);
  EXPECT_EQ(guards.violation(Word::infeasible), 0);
  EXPECT_TRUE(guards.broken(Word::infeasible, "why").empty());
  EXPECT_EQ(guards.violation(Word::not_judged), 0.5) << "evidence is missing";
  guards.set("margin.voltage", -0.25);
  EXPECT_EQ(guards.violation(Word::infeasible), 0.2);
  EXPECT_EQ(guards.texts().front(), "verdict but for stops");
}

TEST(Guards, OfCreatedEnergyStandWhereElectricalEnergyIsTheObjective) {
  Guarded without({});
  EXPECT_EQ(without.set("margin.created", -0.25).violation(Word::feasible), 0);
  Guarded with({}, true, true);
  EXPECT_EQ(with.set("margin.created", -0.25).violation(Word::feasible), 0.2);
  Guarded dropped({{"created", Asks::nothing}}, true, true);
  EXPECT_EQ(dropped.set("margin.created", -0.25).violation(Word::feasible), 0);
}

/// The margin columns of a run equal the margins of its verdict, also for limits that the study changes.
TEST(Guards, MarginsAreThoseOfTheVerdict) {
  const Scenario scenario = shipped("caterpillar.yaml", {"physics.engine=articulated", "duration=4", "cpg.amplitude=1.2"});
  const Recording record = run(scenario);
  const report::Verdict verdict =
      report::verdict(scenario, record, report::summarise(scenario, record, 0), report::overlaps(scenario, record));
  std::vector<studies::Quantity> columns{{"feasible", "", ""}, {"margin", "", ""}};
  for (const report::Check& check : verdict.checks) {
    columns.push_back({"margin." + check.id, "", ""});
    columns.push_back({"margin." + check.id + "[0.25]", "", ""});
  }
  const studies::RunMeasured measured = app::quantity_measure(columns, scenario)(scenario, record);
  EXPECT_EQ(measured.verdict, verdict.word);
  EXPECT_EQ(measured.why, verdict.why());
  EXPECT_EQ(measured.quantities[0], verdict.word == Word::feasible ? 1 : 0);
  EXPECT_EQ(measured.quantities[1], verdict.tightest()->margin);
  std::size_t known = 0;
  for (std::size_t k = 0; k < verdict.checks.size(); ++k) {
    const report::Check& check = verdict.checks[k];
    SCOPED_TRACE(check.id);
    const double margin = measured.quantities[2 + 2 * k];
    if (check.status == report::CheckStatus::fail) {
      EXPECT_LT(margin, 0);
    }
    if (check.status == report::CheckStatus::pass && !std::isnan(margin)) {
      EXPECT_GE(margin, 0);
    }
    const double other = measured.quantities[3 + 2 * k];
    if (std::isnan(check.margin) || check.criteria.size() > 1) continue;
    ++known;
    EXPECT_EQ(other, (check.least ? check.value - 0.25 : 0.25 - check.value) / 0.25);
  }
  EXPECT_GT(known, 5U);
}

}  // namespace
}  // namespace gaitlab::test
