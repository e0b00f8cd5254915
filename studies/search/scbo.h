// Search by Gaussian processes within a trust region (scalable constrained Bayesian optimisation).
#pragma once
#include "studies/search/evolution.h"

namespace gaitlab::studies {

/// After Eriksson and Poloczek (2021), with one model of all constraints. A generation takes, for each of its points, one draw
/// of objective and violation from their posteriors at 400 candidates (at least two per point), and the best candidate of this
/// draw. Three candidates in ten lie in the trust region, a box of side L (in shares of the ranges) around the best point. The
/// others are one of the best 16 points each, moved by up to 1.5 times the difference of two others (as in differential
/// evolution; Storn and Price 1997), so that they follow a ridge that is oblique to the axes. L starts at 0.8, grows by 1.6
/// after two generations in a row with a gain above 0.3 %, and shrinks by 1.7 after two without; below 0.02 it starts again at
/// 0.6. The search never ends by itself. `settings.rated` must outlive the result.
std::unique_ptr<Evolution> scbo(const EvolutionSettings& settings);

}  // namespace gaitlab::studies
