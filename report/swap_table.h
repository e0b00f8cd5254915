// Several runs side by side, by name: what `gaitlab swap` prints and writes.
#pragma once
#include <string>
#include <vector>

#include "report/numbers.h"

namespace gaitlab::report {

struct NamedRun {
  std::string name;  ///< of the CPG
  RunData run;
};

/// The table of the terminal: two lines of head, then a row per run; of one that broke off, why. Lines end in '\n'.
std::string swap_table(const std::vector<NamedRun>& runs);

/// Head `cpg,KEY (UNIT),...`, then a row per run: every summary number that is one number or text, but none of the clock. Empty
/// cells are not known; of a run that broke off only `outcome` is. As write_csv: the shortest text that reads back, RFC 4180.
std::string swap_csv(const std::vector<NamedRun>& runs);

/// An object by name: what summary.json of each run holds, but nothing of the clock; of a run that broke off, all is null but
/// `outcome`.
std::string swap_json(const std::vector<NamedRun>& runs);

}  // namespace gaitlab::report
