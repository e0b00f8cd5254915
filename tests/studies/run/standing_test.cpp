// Tests of the progress of a study: each run counts by its verdict and its outcome.
#include <gtest/gtest.h>

#include "studies/run/runner.h"

namespace gaitlab::studies {
namespace {

TEST(Standing, CountsRunsByVerdictAndOutcome) {
  Standing standing;
  standing.add({.run = 0, .outcome = "done", .verdict = Word::feasible}, false);
  standing.add({.run = 1, .outcome = "done", .verdict = Word::infeasible}, false);
  standing.add({.run = 2, .outcome = "diverged at step 3", .verdict = Word::failed}, false);
  EXPECT_EQ(standing.ended, 3U);
  EXPECT_EQ(standing.feasible, 1U);
  EXPECT_EQ(standing.failed, 1U);
  EXPECT_EQ(standing.kept, 0U) << "no run has a score";
}

}  // namespace
}  // namespace gaitlab::studies
