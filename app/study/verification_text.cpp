#include "app/study/verification_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "app/study/study_text.h"
#include "core/settings/wording.h"
#include "studies/search/verify.h"

namespace gaitlab::app {

namespace {

/// Table of the winner with each joint dead in turn; "" if the study has not asked for it.
std::string faults_text(const std::vector<studies::Verification>& faults, const std::string& objective) {
  if (faults.empty()) return "";
  std::vector<std::vector<std::string>> rows{{"joint", objective, "verdict"}};
  for (const studies::Verification& v : faults) {
    std::string cells =
        v.objectives.empty() || std::isnan(v.objectives.front()) ? "-" : fmt::format("{:.4g}", v.objectives.front());
    rows.push_back({clipped(v.what), std::move(cells), v.verdict.empty() ? "-" : v.verdict});
  }
  return fmt::format("run {} with a joint dead from t = 0:\n{}", faults.front().run, aligned(rows, 2));
}

}  // namespace

std::string verification_text(studies::Journal& journal) {
  std::vector<studies::Verification> all = journal.verifications();
  std::vector<studies::Verification> faults;
  std::ranges::copy_if(all, std::back_inserter(faults), studies::is_fault);
  std::erase_if(all, studies::is_fault);
  std::string text;
  std::uint64_t run = 0;
  for (std::size_t k = 0; k < all.size();) {
    run = all[k].run;
    std::string ways;
    std::string reasons;
    for (; k < all.size() && all[k].run == run; ++k) {
      const studies::Verification& v = all[k];
      const double objective = v.objectives.front();
      ways += fmt::format("{}{} {}", ways.empty() ? "" : ", ", clipped(v.what),
                          std::isnan(objective) ? "-" : fmt::format("{:.4g}", objective));
      if (!v.reason.empty())
        reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", clipped(v.what), one_line(v.reason));
    }
    text += fmt::format("run {} {} ({}){}\n", run, reasons.empty() ? "verified" : "not verified", ways,
                        reasons.empty() ? "" : "\n  " + reasons);
  }
  const std::string objective = objective_text(journal.head());
  return text.empty() ? "" : "verification of the best points (" + objective + "):\n" + text + faults_text(faults, objective);
}

}  // namespace gaitlab::app
