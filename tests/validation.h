// Rows of docs/validation.md: a claim, the source of the required value, and the result of the program with its tolerance.
#pragma once
#include <string>

namespace gaitlab::test {

/// Row of the page. `id` is SUBJECT.NAME and sorts the rows. Subjects are closed, cpg, published, order, property, format,
/// ledger and limits (tests/tools/validation.sh).
struct Row {
  std::string id;
  std::string what;    ///< the claim in a few words
  std::string source;  ///< source of the required value
  std::string unit;    ///< "" for a pure number
};

/// Expects |measured - expected| <= tolerance * GAITLAB_TOL_SCALE. The default of this environment variable is 1. With 0 every
/// row fails, so that the output shows all residuals. `reason` is the reason for the size of the tolerance. With
/// GAITLAB_VALIDATION=FILE one line of JSON is appended to FILE. If a test validates several values under one id, the page
/// shows the value that is closest to its tolerance.
void validate(const Row& row, double measured, double expected, double tolerance, const std::string& reason);

/// Expects 0 <= measured <= limit * GAITLAB_TOL_SCALE, for a number that need only be small, such as a largest error.
void validate_below(const Row& row, double measured, double limit, const std::string& reason);

}  // namespace gaitlab::test
