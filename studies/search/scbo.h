// Search by Gaussian processes within a trust region (scalable constrained Bayesian optimisation).
#pragma once
#include "studies/search/evolution.h"

namespace gaitlab::studies {

/// Method of Eriksson and Poloczek (2021) with one model for all constraints. For each point of a generation, objective and
/// violation are drawn from their posteriors at 400 candidates (at least two per point); the point is the best remaining
/// candidate of its draw. Three candidates in ten lie in the trust region, a box of side L (in shares of the ranges) around the
/// best point. Each of the others is one of the best 16 points, moved by up to 1.5 times the difference of two such points (as
/// in differential evolution; Storn and Price 1997), so that candidates follow a ridge that is oblique to the axes. L starts at
/// 0.8. It is multiplied by 1.6 (up to 1.2) after two generations in a row with a gain above 0.3 %, and divided by 1.7 after
/// two without. Below 0.02 it starts again at 0.6. The search never ends by itself. `settings.rated` must outlive the result.
std::unique_ptr<Evolution> scbo(const EvolutionSettings& settings);

}  // namespace gaitlab::studies
