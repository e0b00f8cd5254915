// A walk whose recording tests of the verdict change by hand.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "report/verdict/verdict.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {

using namespace report;

/// A caterpillar of 4 s, which is one period, changed by hand.
struct Case {
  Scenario scenario = shipped("caterpillar.yaml", {"duration=4", "physics.engine=articulated"});
  Recording record = run(scenario);

  [[nodiscard]] Verdict judged() const {
    return verdict(scenario, record, summarise(scenario, record, 0), overlaps(scenario, record));
  }
  [[nodiscard]] Check check(const std::string& id) const {
    const Verdict made = judged();
    const auto found = std::ranges::find(made.checks, id, &Check::id);
    return found != made.checks.end() ? *found : Check();
  }
  [[nodiscard]] CheckStatus status(const std::string& id) const { return check(id).status; }
  /// A joint's cell in one row of ticks.
  double& tick(std::size_t row, std::size_t joint, TickColumn column) {
    return record.ticks.values.at(row * record.ticks.columns.size() + 1 + joint * kTickColumns + column);
  }
  [[nodiscard]] std::size_t last_tick() const { return record.ticks.rows() - 1; }
};

inline Case& walk() {
  static Case made;
  return made;
}

/// Three periods, which are evidence of a gait.
inline Case& gait() {
  static Case made{shipped("caterpillar.yaml", {"duration=12", "physics.engine=articulated"})};
  return made;
}

/// Joint 3 is at the limit in each of the last `rows` ticks but every one whose number `every` divides.
inline Case at_limit(TickColumn column, std::size_t rows, std::size_t every = 0) {
  Case made = walk();
  double total = 0;
  for (std::size_t k = made.last_tick() - rows + 1; k <= made.last_tick(); ++k) {
    const bool gap = every > 0 && k % every == 0;
    const auto t = [&](std::size_t row) { return made.record.ticks.values[row * made.record.ticks.columns.size()]; };
    if (!gap) total += t(k) - t(k - 1);
    made.tick(k, 3, column) = total;
  }
  return made;
}

}  // namespace gaitlab::test
