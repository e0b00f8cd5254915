// A search whose points and speeds are given, with the rows of its runs.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "studies/search/candidates.h"
#include "studies/search/verify.h"
#include "tests/studies/small_study.h"

namespace gaitlab::test {

/// A search over the frequency, 0.5 to 1.5 Hz, with given points and speeds.
class SearchedStudy {
 public:
  explicit SearchedStudy(const std::vector<std::pair<std::string, double>>& points, const std::string& lines = "",
                         const std::string& parameters = "cpg.frequency: {low: 0.5, high: 1.5}",
                         const std::string& guards = "guards: none\n")
      : study("parameters: {" + parameters + "}\nbudget: {runs: 64}\n" + guards + lines, studies::Purpose::optimize) {
    for (const auto& [value, speed] : points) {
      study.plan->add(study.plan->study().parameters.size() == 1 ? std::vector<std::string>{value}
                                                                 : std::vector<std::string>{value, "hopf"});
      for (std::uint64_t r = 0; r < study.plan->points().runs_of_point(); ++r)
        rows.push_back(study.done(study.plan->row(rows.size()), "speed", speed));
    }
  }
  void write() {
    if (journal.rows() == 0) journal.write(rows, {});
  }
  /// Frequencies of the candidates that follow `tried`.
  std::vector<std::string> candidates(const std::vector<std::size_t>& tried = {}) {
    write();
    const studies::Results found = results(journal);
    std::vector<std::string> values;
    for (const std::size_t k : studies::candidates(*study.plan, found, tried))
      values.push_back(study.plan->row(found.points[k].first_run).values[0]);
    return values;
  }
  /// Verifications of all points, with rows by `answer`.
  std::vector<studies::Verification> verify(const std::function<studies::Row(const studies::Job&)>& answer) {
    write();
    const studies::Results found = results(journal);
    std::vector<std::size_t> all(found.points.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    std::atomic<bool> stop = false;
    return studies::verify(
               *study.plan, journal, found, all, answering(answer), [](std::size_t, std::size_t) {}, stop)
        .value();
  }
  SmallStudy study;
  studies::Journal journal = study.journal();
  std::vector<studies::Row> rows;
};

}  // namespace gaitlab::test
