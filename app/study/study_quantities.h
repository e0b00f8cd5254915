// Quantities of a run for studies: the summary numbers, and the margins of the verdict's checks.
#pragma once
#include "studies/study/judge.h"

namespace gaitlab::app {

studies::QuantityOffer quantity_offer();

/// Whether a column of older journals is no longer computed.
bool is_gone(const std::string& quantity);

/// Whether a quantity has another value without an estimate of the torque error.
bool depends_on_estimate(const std::string& quantity);

/// Function that computes these columns and the verdict's word. Throws InputError for an unknown column (in a journal of
/// another program).
studies::Measure quantity_measure(const std::vector<studies::Quantity>& columns, const Scenario& scenario);

}  // namespace gaitlab::app
