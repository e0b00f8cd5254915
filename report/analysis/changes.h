// Changes of a run (section `at`) in words.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// A change that took effect, in words: `cpg.phase_lag -1.2, m3/active dead`.
struct ToldChange {
  double t = 0;  ///< s
  std::string text;
};

/// Changes before `end`, s, in their order.
std::vector<ToldChange> told_changes(const Scenario& scenario, double end);

}  // namespace gaitlab::report
