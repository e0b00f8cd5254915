// A run folder, read and judged: for the commands that print, draw or search without simulating the run again.
#pragma once
#include <string>
#include <vector>

#include "app/app.h"
#include "kit/judged_run.h"

namespace gaitlab::app {

/// Reads and judges a run. `joints` are the joints in the figure. `catalog` must outlive the result. Results of an earlier
/// --demand and of an earlier remedy are read from the folder. Throws the InputErrors of read_run and draw_joints.
JudgedRun judged_run(const std::string& name, Catalog& catalog, const std::vector<std::string>& joints,
                     const SummaryOptions& shown);

/// Prints notes and warnings on a run on stderr.
void warn(const JudgedRun& run);

}  // namespace gaitlab::app
