// Quantities of a run for studies: the summary numbers, and the margins of the verdict's checks.
#pragma once
#include "studies/study/scorer.h"

namespace gaitlab::app {

studies::QuantityOffer quantity_offer();

/// True if the value of a quantity depends on the estimate of the torque error.
bool depends_on_estimate(const std::string& quantity);

/// Function that computes these columns and the verdict of a run. Throws InputError for an unknown column (of a journal that
/// another program wrote).
studies::Measure quantity_measure(const std::vector<studies::Quantity>& columns, const Scenario& scenario);

}  // namespace gaitlab::app
