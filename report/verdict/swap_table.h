// Tables of several runs side by side, by name: output of `gaitlab swap`.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/numbers.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

struct NamedRun {
  std::string name;  ///< of the CPG
  RunData run;
};

/// The table of the terminal: two header lines, then a row per run; for a run that ended early, the reason. Below: runs in
/// which gears create more than 5 % of the energy drawn, so that the cost of transport is too low. Lines end in '\n'.
std::string swap_table(const std::vector<NamedRun>& runs);

/// Header `cpg,KEY (UNIT),...`, then a row per run: every summary number that is a single number or text, except those of the
/// clock. Empty cells are not known; a run that ended early has only `outcome`. Format as in write_csv: the shortest text that
/// is read back unchanged, RFC 4180.
std::string swap_csv(const std::vector<NamedRun>& runs);

/// An object by name: the content of each run's summary.json without numbers of the clock; for a run that ended early all is
/// null except `outcome`.
std::string swap_json(const std::vector<NamedRun>& runs);

/// One of several scenarios, under one CPG.
struct MatrixRun {
  NamedRun named;        ///< named by the CPG
  std::string scenario;  ///< its name
  const Verdict& verdict;
};

/// Reason why the motors cannot do it, on one line: the first check that fails, or why the run ended early; empty: they can, or
/// it was not judged.
std::string why_not(const MatrixRun& one);

/// The table of the terminal: two header lines, then a row per run: speed, cost of transport, feasible (y, n, or - if it was
/// not judged), and the reason. Below: as in swap_table.
std::string matrix_table(const std::vector<MatrixRun>& runs);
/// As swap_csv, with the columns `cpg,scenario,verdict,why` first.
std::string matrix_csv(const std::vector<MatrixRun>& runs);
/// The content of swap_json by CPG, then by scenario, with `verdict` and `why`.
std::string matrix_json(const std::vector<MatrixRun>& runs);

}  // namespace gaitlab::report
