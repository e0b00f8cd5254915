// A small study in a separate folder, and executors that answer without a simulation.
#pragma once
#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/study/study_quantities.h"
#include "studies/plan/definition.h"
#include "studies/run/executor.h"
#include "studies/study/study_file.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {

/// A study of two M-TRAN modules, a run of which takes 20 ms of simulated time.
class SmallStudy {
 public:
  static constexpr std::int64_t kMostAskedRuns = 8;

  /// `lines` are the lines of the study that follow its scenario.
  explicit SmallStudy(const std::string& lines, studies::Purpose purpose = studies::Purpose::sweep, Catalog& of = catalog()) {
    std::filesystem::create_directory_symlink(kScenarios + "modules", folder / "modules");
    folder.write("two.yaml",
                 "gaitlab: 1\nrobot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nphysics: {engine: articulated}\n"
                 "cpg: {type: phase_oscillator, frequency: 1}\nduration: 0.02\n");
    const std::string head = lines.find("scenario") == std::string::npos ? "scenario: two.yaml\n" : "";
    studies::Study study = studies::read_study(folder.write("s.yaml", "gaitlab_study: 1\n" + head + lines), purpose);
    if (purpose == studies::Purpose::evaluate) study.runs = kMostAskedRuns;
    plan = std::make_unique<studies::Plan>(std::move(study), app::quantity_offer(), of);
  }

  /// A new or existing journal of the study.
  [[nodiscard]] studies::Journal journal(const std::string& name = "study.db", const std::string& build = "a build") const {
    studies::JournalHead head = studies::journal_head(*plan);
    head.build = build;
    return {folder / name, head, studies::Journal::Build::same};
  }
  [[nodiscard]] std::size_t column(const std::string& quantity) const {
    const auto at = std::ranges::find(plan->columns(), quantity, &studies::Quantity::name);
    EXPECT_NE(at, plan->columns().end()) << quantity;
    return static_cast<std::size_t>(at - plan->columns().begin());
  }
  /// Row of a run that ended, feasible, with this value of a quantity and without the others.
  [[nodiscard]] studies::Row done(studies::Row row, const std::string& quantity, double value) const {
    row.outcome = "done";
    row.verdict = Word::feasible;
    row.simulated = 0.02;
    row.quantities.assign(plan->columns().size(), std::nan(""));
    row.quantities[column(quantity)] = value;
    row.score = plan->scorer().score(row.quantities, row.verdict);
    return row;
  }
  [[nodiscard]] studies::Job job(std::uint64_t run) const {
    return {plan->row(run), plan->sets(run), plan->points().scenario(run)};
  }

  Folder folder;
  std::unique_ptr<studies::Plan> plan;
};

/// An executor that takes `side` jobs at a time and ends each by `answer`.
inline studies::Executor answering(std::function<studies::Row(const studies::Job&)> answer, std::size_t side = 1) {
  return [answer = std::move(answer), side](const studies::Work& work, std::atomic<bool>& stop) {
    while (!stop) {
      std::vector<studies::Job> jobs;
      std::vector<std::uint64_t> runs;
      std::vector<studies::Row> rows;
      while (jobs.size() < side) {
        std::optional<studies::Job> job = work.next();
        if (!job) break;
        runs.push_back(job->row.run);
        jobs.push_back(std::move(*job));
      }
      if (jobs.empty()) return true;
      work.begin(runs);
      rows.reserve(jobs.size());
      for (const studies::Job& job : jobs) rows.push_back(answer(job));
      work.end(std::move(rows));
    }
    return false;
  };
}

}  // namespace gaitlab::test
