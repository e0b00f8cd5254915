// Search by Gaussian processes within a trust region (scalable constrained Bayesian optimisation).
#pragma once
#include "studies/search/evolution.h"

namespace gaitlab::studies {

/// Eriksson and Poloczek (2021), with one model of all constraints. The trust region is a box around the best point, of side L
/// in shares of the parameter ranges. A generation takes, for each of its points, one draw of objective and violation from
/// the posteriors at candidates within the region, and the best candidate of this draw. L starts at 0.8, grows by 1.6 after two
/// generations in a row with a gain above 0.3 %, and shrinks by 1.7 after three without; below 0.02 it starts again at 0.6. The
/// search has no end of its own. `settings.rated` must outlive the result.
std::unique_ptr<Evolution> scbo(const EvolutionSettings& settings);

}  // namespace gaitlab::studies
