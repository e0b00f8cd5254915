// The quantities of a run that studies offer: the summary numbers, and the margins of the checks of its verdict.
#pragma once
#include "studies/study/judge.h"

namespace gaitlab::app {

studies::QuantityOffer quantity_offer();

/// Whether a column of older journals is not computed any more.
bool is_gone(const std::string& quantity);

/// Whether a quantity is another one where the torque error was not estimated.
bool depends_on_estimate(const std::string& quantity);

/// Of these columns, and the verdict's word. InputError: a column is not known (of a journal of another program).
studies::Measure quantity_measure(const std::vector<studies::Quantity>& columns, const Scenario& scenario);

}  // namespace gaitlab::app
