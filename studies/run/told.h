// Result of a point that another program gives, as a line of JSON.
#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "core/recording/word.h"
#include "studies/journal/results.h"

namespace gaitlab::studies {

/// Result of a point. A failed point has an outcome other than `done`, and no score.
struct Told {
  std::uint64_t point = 0;  ///< id of the question
  std::string outcome = "done", message = {};
  double simulated = 0;  ///< time until the failure, s
  Score score = {};
  Word verdict = Word::not_judged;
  std::map<std::string, double> quantities = {};  ///< by name; NaN if not known
};

/// Reads a result from `line` at `place`: `{"id": 7, "objective": 0.031, "violation": 0}`, or an answer of answer(). An unknown
/// objective (null) adds 1 to the violation. A text that is null or empty counts as missing, because tables are filled in this
/// way. Throws InputError with every problem found: no JSON, an unknown key, a value of the wrong type, the outcome `not run`,
/// or another number of objectives than `objectives`.
Told read_told(const std::string& line, const SourceLocation& place, std::size_t objectives);

}  // namespace gaitlab::studies
