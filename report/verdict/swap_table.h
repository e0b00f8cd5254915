// Several runs side by side, by name: what `gaitlab swap` prints and writes.
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

/// The table of the terminal: two lines of head, then a row per run; of one that broke off, why. Lines end in '\n'.
std::string swap_table(const std::vector<NamedRun>& runs);

/// Head `cpg,KEY (UNIT),...`, then a row per run: every summary number that is one number or text, but none of the clock. Empty
/// cells are not known; of a run that broke off only `outcome` is. As write_csv: the shortest text that reads back, RFC 4180.
std::string swap_csv(const std::vector<NamedRun>& runs);

/// An object by name: what summary.json of each run holds, but nothing of the clock; of a run that broke off, all is null but
/// `outcome`.
std::string swap_json(const std::vector<NamedRun>& runs);

/// Of several scenarios: one of them under a CPG.
struct MatrixRun {
  NamedRun named;        ///< by the CPG
  std::string scenario;  ///< its name
  const Verdict& verdict;
};

/// Why the motors cannot do it, in one line: the first check that fails, or why the run ended early; empty: they can, or it was
/// not judged.
std::string why_not(const MatrixRun& one);

/// The table of the terminal: two lines of head, then a row per run: speed, cost of transport, feasible (y, n, or - where it
/// was not judged), and why not.
std::string matrix_table(const std::vector<MatrixRun>& runs);
/// As swap_csv, with the columns `cpg,scenario,verdict,why` first.
std::string matrix_csv(const std::vector<MatrixRun>& runs);
/// By CPG, then by scenario what swap_json holds, `verdict` and `why`.
std::string matrix_json(const std::vector<MatrixRun>& runs);

}  // namespace gaitlab::report
