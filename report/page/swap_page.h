// swap.html: a scenario under several CPGs side by side, each with its verdict and its page.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/swap_table.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

struct SwapEntry {
  NamedRun named;
  const Verdict& verdict;
  std::string page;  ///< file of the run's page, beside this one
};

/// A page in one file without scripts and requests: the robot at the end of the first run, and a row per CPG with its verdict,
/// a picture of joints over time, and the numbers of `swap`'s table. No number is of the clock.
std::string swap_page(const std::string& name, const std::vector<SwapEntry>& entries);

}  // namespace gaitlab::report
