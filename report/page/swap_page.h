// swap.html, which shows a scenario under several CPGs, each with its verdict and a link to its page.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/numbers/swap_table.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

struct SwapEntry {
  NamedRun named;
  const Verdict& verdict;
  std::string page;  ///< file name of the run's page, in the folder of swap.html
};

/// HTML text in one file without scripts and network requests. It shows the robot at the end of the first run, and for each CPG
/// the verdict, a picture of the joints over time, and the numbers of the table of `swap`. No number is measured by the clock.
std::string swap_page(const std::string& name, const std::vector<SwapEntry>& entries);

}  // namespace gaitlab::report
