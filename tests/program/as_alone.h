// Test of rollouts in lanes and threads: each has the bits of the rollout alone.
#pragma once
#include <gtest/gtest.h>

#include <mutex>

#include "core/simulation/batch.h"
#include "tests/program/bits.h"

namespace gaitlab::test {

/// Expects that every rollout of a batch has the bits that it has alone, in lane groups of 1, 4 and 8. Returns the texts of
/// alone().
inline std::vector<std::string> expect_as_alone(const std::vector<Scenario>& all, int threads) {
  std::vector<std::string> expected;
  for (const Scenario& one : all) expected.push_back(alone(one));
  for (const std::size_t lanes : {1U, 4U, 8U}) {
    std::mutex lock;
    std::vector<std::string> ends(all.size());
    run_batch(all, {threads, lanes}, [&](std::size_t i, Recording&& end) {
      const std::lock_guard hold(lock);
      ends[i] = bits(end, end.outcome.text());
    });
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(ends[i], expected[i]) << i << ", " << lanes << " lanes";
  }
  return expected;
}

}  // namespace gaitlab::test
