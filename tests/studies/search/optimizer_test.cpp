// The loop of a search on a function instead of runs: its points, its budget, and the same requests after a restart.
#include "studies/search/optimizer.h"

#include <gtest/gtest.h>

#include <set>

#include "studies/study/number.h"
#include "tests/messages.h"
#include "tests/studies/small_study.h"

namespace gaitlab::test {
namespace {

using studies::Generation;
using studies::Job;
using studies::Journal;
using studies::Row;
using studies::SearchEnd;

const std::string kBox =
    "parameters: {cpg.frequency: {low: 0.5, high: 1.5}, cpg.amplitude: {low: 0.2, high: 1}}\nguards: none\n";

/// A search whose runs have the speed 1 - (frequency - 0.7)^2 - (amplitude - 0.9)^2.
class FunctionSearch {
 public:
  explicit FunctionSearch(const std::string& lines) : study(lines, studies::Purpose::optimize) {}

  static double speed(const std::vector<std::string>& values) {
    return 1 - std::pow(studies::number_of(values[0]) - 0.7, 2) - std::pow(studies::number_of(values[1]) - 0.9, 2);
  }
  /// Runs the searches, and stops them after `most` runs.
  SearchEnd run(Journal& journal, std::size_t most = 100000) {
    run_now.clear();
    std::atomic<bool> stop = false;
    studies::RunnerSettings settings;
    settings.executor = answering(
        [&](const Job& job) {
          run_now.push_back(job.row);
          if (run_now.size() == most) stop = true;
          return study.done(job.row, "speed", speed(job.row.values));
        },
        8);
    return studies::run_searches(
        *study.plan, journal, std::move(settings), [&](const studies::SearchPlace& place) { places.push_back(place); }, stop);
  }
  SmallStudy study;
  std::vector<Row> run_now;
  std::vector<studies::SearchPlace> places;
};

/// `run number: values` of all rows.
std::vector<std::string> runs_in(Journal& journal) {
  std::vector<std::string> all;
  journal.each_row({"run", journal.columns().parameters[0], journal.columns().parameters[1]},
                   [&](const std::vector<std::string>& row) { all.push_back(row[0] + ": " + row[1] + " " + row[2]); });
  return all;
}

/// The mean speed of evenly spread points is 0.68.
TEST(Searches, EndWithTheirBudgetCloseToTheBest) {
  FunctionSearch search(kBox + "budget: {runs: 300}\n");
  Journal journal = search.study.journal();
  EXPECT_EQ(search.run(journal), SearchEnd::budget);
  EXPECT_EQ(journal.rows(), 300U);
  std::set<std::vector<std::string>> points;
  for (const Row& row : search.run_now) {
    const double frequency = studies::number_of(row.values[0]);
    const double amplitude = studies::number_of(row.values[1]);
    EXPECT_TRUE(frequency >= 0.5 && frequency <= 1.5 && amplitude >= 0.2 && amplitude <= 1) << frequency << " " << amplitude;
    points.insert(row.values);
  }
  EXPECT_EQ(points.size(), 300U) << "no point twice";
  double best = 0;
  for (const Generation& one : journal.generations()) best = std::max(best, one.best);
  EXPECT_GT(best, 1 - 1e-4) << "a hundredth of the box from the best";
}

TEST(Searches, WriteEachGenerationThatIsWhole) {
  FunctionSearch search(kBox + "budget: {runs: 100}\nmethod: {type: cma, population: 16}\n");
  Journal journal = search.study.journal();
  ASSERT_EQ(search.run(journal), SearchEnd::budget);
  const std::vector<Generation> all = journal.generations();
  ASSERT_EQ(all.size(), 6U) << "six times 16 of 100 runs";
  for (std::size_t g = 0; g < all.size(); ++g) {
    EXPECT_EQ(all[g].generation, g);
    EXPECT_EQ(all[g].first_run, 16 * g);
    EXPECT_EQ(all[g].runs, 16U);
    EXPECT_EQ(all[g].points, 16U);
    EXPECT_EQ(all[g].kept, 16U);
    double best = -9;
    std::vector<double> speeds;
    for (std::size_t k = 16 * g; k < 16 * (g + 1); ++k) speeds.push_back(FunctionSearch::speed(search.run_now[k].values));
    for (const double one : speeds) best = std::max(best, one);
    std::ranges::sort(speeds);
    EXPECT_EQ(all[g].best, best);
    EXPECT_EQ(all[g].median, (speeds[7] + speeds[8]) / 2);
  }
  EXPECT_EQ(search.places.back().generation, 7U);
  EXPECT_EQ(search.places.back().asked, 4U) << "the rest of the budget";
}

TEST(Searches, GoOnWhereTheyWereStopped) {
  const std::string lines = kBox + "budget: {runs: 56}\n";
  FunctionSearch whole(lines);
  Journal once = whole.study.journal();
  ASSERT_EQ(whole.run(once), SearchEnd::budget);
  const std::vector<std::string> expected = runs_in(once);

  FunctionSearch first(lines);
  Journal journal = first.study.journal();
  EXPECT_EQ(first.run(journal, 21), SearchEnd::stopped) << "within a generation";
  FunctionSearch second(lines);
  EXPECT_EQ(second.run(journal), SearchEnd::budget);
  EXPECT_EQ(second.run_now.size(), 56 - first.run_now.size()) << "each run once";
  EXPECT_EQ(runs_in(journal), expected);
  EXPECT_EQ(journal.generations().size(), once.generations().size());
  FunctionSearch third(lines);
  EXPECT_EQ(third.run(journal), SearchEnd::budget);
  EXPECT_TRUE(third.run_now.empty()) << "nothing is left";
}

/// Each combination of listed values is searched by itself, with all of its runs.
TEST(Searches, HaveOneForEachCombinationOfListedValues) {
  FunctionSearch search(
      "parameters: {cpg.frequency: {low: 0.5, high: 1.5}, cpg.amplitude: {values: [0.4, 0.9]}, cpg.type: {values: [hopf, "
      "phase_oscillator]}}\nguards: none\nbudget: {runs: 64}\nmethod: {type: cma, population: 16}\n");
  Journal journal = search.study.journal();
  ASSERT_EQ(search.run(journal), SearchEnd::budget);
  std::map<std::vector<std::string>, int> combinations;
  for (const Row& row : search.run_now) ++combinations[{row.values[1], row.values[2]}];
  ASSERT_EQ(combinations.size(), 4U);
  for (const auto& [values, count] : combinations) EXPECT_EQ(count, 16) << values[0] << " " << values[1];
  EXPECT_EQ(search.places.front().searches, 4U);
}

TEST(Searches, ConvergeBeforeTheirBudget) {
  FunctionSearch search(kBox + "budget: {runs: 5000}\nmethod: {type: cma, restarts: 0}\n");
  Journal journal = search.study.journal();
  EXPECT_EQ(search.run(journal), SearchEnd::converged);
  EXPECT_LT(journal.rows(), 1000U);
  EXPECT_EQ(journal.generations().back().runs, journal.rows() - journal.generations().back().first_run);
}

/// A box that contains only four values of 12 digits. Each value is run once, however often it is requested.
TEST(Searches, RunNoPointTwice) {
  FunctionSearch search(
      "parameters: {cpg.frequency: {low: 1, high: 1.00000000003}, cpg.amplitude: {values: [0.5]}}\nguards: none\nbudget: "
      "{runs: "
      "100}\nmethod: {type: cma, population: 8, restarts: 0}\n");
  Journal journal = search.study.journal();
  EXPECT_EQ(search.run(journal), SearchEnd::converged);
  std::set<std::string> points;
  for (const Row& row : search.run_now) EXPECT_TRUE(points.insert(row.values[0]).second) << row.values[0];
  EXPECT_EQ(journal.rows(), points.size());
  EXPECT_LE(points.size(), 4U);
  std::uint64_t runs = 0;
  for (const Generation& one : journal.generations()) {
    EXPECT_GE(one.points, 8U);
    runs += one.runs;
  }
  EXPECT_EQ(runs, points.size()) << "of all generations";
}

/// The journal of another build contains other points.
TEST(Searches, RefuseAJournalOfOtherPoints) {
  FunctionSearch search(kBox + "budget: {runs: 100}\n");
  Journal journal = search.study.journal();
  Row other;
  other.point = "0123";
  other.values = {"0.5", "0.5"};
  const std::vector<Row> rows{search.study.done(other, "speed", 1)};
  journal.write(rows, {});
  const std::string text = message_of([&] { search.run(journal); });
  EXPECT_TRUE(text.starts_with("study.db: error: run 0 is at another point than method scbo of this build requires")) << text;
  EXPECT_TRUE(search.run_now.empty());
}

/// A search begins with the scenario's own values, digit for digit, then with the study's start points in their order.
TEST(Searches, BeginWithTheScenariosOwnValuesAndTheStudysPoints) {
  FunctionSearch search(kBox + "budget: {runs: 16}\nstart: [{cpg.frequency: 0.7}, {cpg.amplitude: 0.9, cpg.frequency: 1.1}]\n");
  Journal journal = search.study.journal();
  ASSERT_EQ(search.run(journal), SearchEnd::budget);
  const std::vector<std::string>& own = search.study.plan->bound().starts().front();
  EXPECT_EQ(search.run_now[0].values, own);
  EXPECT_EQ(search.run_now[1].values, (std::vector<std::string>{"0.7", own[1]}));
  EXPECT_EQ(search.run_now[2].values, (std::vector<std::string>{"1.1", "0.9"}));
  EXPECT_EQ(journal.rows(), 16U);
}

/// The spread of a single point is 0, although nothing has converged.
TEST(Searches, MayHaveGenerationsOfOnePoint) {
  FunctionSearch search(kBox + "budget: {runs: 40}\nmethod: {type: scbo, population: 1}\n");
  Journal journal = search.study.journal();
  ASSERT_EQ(search.run(journal), SearchEnd::budget);
  const std::vector<Generation> all = journal.generations();
  ASSERT_EQ(all.size(), 26U) << "a block of 15, then 25 of one point";
  EXPECT_EQ(all.back().restart, 0U);
}

/// Each word has a search. All of them contain the scenario's own numbers. A start point with a word is only in the search of
/// this word.
TEST(Searches, BeginWithTheStartPointsOfTheirWords) {
  FunctionSearch search(
      "parameters: {cpg.frequency: {low: 0.5, high: 1.5}, cpg.type: {values: [hopf, phase_oscillator]}}\nguards: none\n"
      "budget: {runs: 32}\nmethod: {type: cma, population: 16}\nstart: [{cpg.frequency: 0.77, cpg.type: hopf}]\n");
  Journal journal = search.study.journal();
  ASSERT_EQ(search.run(journal), SearchEnd::budget);
  std::map<std::string, std::set<std::string>> frequencies;
  for (const Row& row : search.run_now) frequencies[row.values[1]].insert(row.values[0]);
  const std::string own = search.study.plan->bound().starts().front()[0];
  EXPECT_TRUE(frequencies["hopf"].contains(own) && frequencies["phase_oscillator"].contains(own));
  EXPECT_TRUE(frequencies["hopf"].contains("0.77"));
  EXPECT_FALSE(frequencies["phase_oscillator"].contains("0.77"));
}

/// A word that the scenario refuses costs a block, not half of the budget.
TEST(Searches, EndWhereTheScenarioRefusesTheFirstBlock) {
  const std::string lines =
      "parameters: {cpg.frequency: {low: 0.5, high: 1.5}, cpg.type: {values: [hopf, phase_oscillator]}}\nguards: none\n"
      "budget: {runs: 160}\nmethod: {type: cma, population: 16}\n";
  for (const bool all : {false, true}) {
    SmallStudy study(lines, studies::Purpose::optimize);
    Journal journal = study.journal();
    std::map<std::string, int> runs;
    studies::RunnerSettings settings;
    settings.executor = answering([&](const Job& job) {
      Row row = job.row;
      ++runs[row.values[1]];
      if (!all && row.values[1] != "hopf") return study.done(row, "speed", studies::number_of(row.values[0]));
      row.outcome = "refused";
      row.message = "no";
      return row;
    });
    std::atomic<bool> stop = false;
    const SearchEnd end = run_searches(
        *study.plan, journal, std::move(settings), [](const studies::SearchPlace&) {}, stop);
    EXPECT_EQ(end, all ? SearchEnd::refused : SearchEnd::budget);
    EXPECT_EQ(runs["hopf"], 16);
    EXPECT_EQ(runs["phase_oscillator"], all ? 16 : 144);
  }
}

}  // namespace
}  // namespace gaitlab::test
