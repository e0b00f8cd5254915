// A row of docs/validation.md: what is claimed, against which source, and how far inside its tolerance the program is.
#pragma once
#include <string>

namespace gaitlab::test {

/// `id` is SUBJECT.NAME and sorts the page; subjects: closed, cpg, published, order, property, format, ledger, limits
/// (tests/tools/validation.sh).
struct Row {
  std::string id;
  std::string what;    ///< the claim, a few words
  std::string source;  ///< where the required value comes from
  std::string unit;    ///< "" for a pure number
};

/// Expects |measured - expected| <= tolerance * GAITLAB_TOL_SCALE. The environment variable is 1 where it is not set; 0 fails
/// every row, so that the output shows all residuals. `reason`: why the tolerance is what it is. With
/// GAITLAB_VALIDATION=FILE one line of JSON is appended to FILE. A test may validate many values under one id: the page shows
/// the one that is least far inside.
void validate(const Row& row, double measured, double expected, double tolerance, const std::string& reason);

/// The same for a figure that need only be small, such as a worst error: 0 <= measured <= limit * GAITLAB_TOL_SCALE.
void validate_below(const Row& row, double measured, double limit, const std::string& reason);

}  // namespace gaitlab::test
