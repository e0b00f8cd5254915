// Tables of several runs side by side, which `gaitlab swap` prints.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/numbers/numbers.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

struct NamedRun {
  std::string name;  ///< name of the CPG
  RunData run;
};

/// Table for the terminal: two header lines, then one row per run. The row of a run that ended early is the reason. Below the
/// table are the runs in which gears create more than 5 % of the energy drawn, which makes the cost of transport too low. Every
/// line ends in '\n'.
std::string swap_table(const std::vector<NamedRun>& runs);

/// CSV table: the header `cpg,KEY (UNIT),...`, then one row per run. The columns are the single numbers and texts of the
/// summary, without computing times. Empty cells are not known. Only `outcome` is filled in if the run ended early. Numbers are
/// the shortest text that is read back unchanged, as in write_csv; quoting follows RFC 4180.
std::string swap_csv(const std::vector<NamedRun>& runs);

/// JSON object that maps the name of each run to the content of its summary.json, without numbers measured by the clock.
/// Everything except `outcome` is null if the run ended early.
std::string swap_json(const std::vector<NamedRun>& runs);

/// A run of one scenario with one CPG, from a matrix of several scenarios and CPGs.
struct MatrixRun {
  NamedRun named;        ///< the run, with the name of the CPG
  std::string scenario;  ///< name of the scenario
  const Verdict& verdict;
};

/// Reason why the gait is not feasible, on one line: the reason of the verdict, or why the run ended early. Empty for
/// `feasible`.
std::string why_not(const MatrixRun& one);

/// Table for the terminal: two header lines, then one row per run with speed, cost of transport, feasible (y, n, or - if not
/// judged), and the reason. Below the table are the runs with created energy, as in swap_table.
std::string matrix_table(const std::vector<MatrixRun>& runs);
/// CSV table like that of swap_csv; its first columns are `cpg,scenario,verdict,why`.
std::string matrix_csv(const std::vector<MatrixRun>& runs);
/// JSON object by CPG, then by scenario. Each entry is the content that swap_json writes for a run, with `verdict` and `why`.
std::string matrix_json(const std::vector<MatrixRun>& runs);

}  // namespace gaitlab::report
