#include "report/remedy/remedy_run.h"

#include <algorithm>
#include <limits>

#include "report/analysis/collisions.h"
#include "report/verdict/numbers/number_texts.h"

namespace gaitlab::report {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string name(const Check& check) { return texts::spaced(check.id) + (check.worst.empty() ? "" : " of " + check.worst); }

/// Deciding check of a verdict and its part; for a feasible run the check with the least margin.
std::string weakest(const Verdict& verdict) {
  const std::vector<const Check*> failures = verdict.failures();
  if (verdict.word == Word::not_judged) {
    if (!failures.empty() || verdict.reason.code != ReasonCode::too_close) return verdict.reason.text;
    return name(*std::ranges::find(verdict.checks, verdict.reason.check, &Check::id)) + " is too close to its limit";
  }
  const Check* const check = failures.empty() ? verdict.tightest() : failures.front();
  return check == nullptr ? "" : name(*check);
}

}  // namespace

RemedyRun judged(const Scenario& scenario, const Recording& recording) {
  const Summary summary = summarise(scenario, recording, 0);
  const Verdict made = verdict(scenario, recording, summary, overlaps(scenario, recording));
  const Check* const tightest = made.tightest();
  const auto progress = std::ranges::find(made.checks, "progress", &Check::id);
  const bool still = progress != made.checks.end() && progress->status == CheckStatus::warn;
  return {made.word, tightest == nullptr ? kNone : tightest->margin, summary.speed, weakest(made), still, true};
}

RemedyRun refused_run(const std::vector<Problem>& problems) {
  return {.margin = kNone, .speed = kNone, .refused = problems.front().text};
}

}  // namespace gaitlab::report
