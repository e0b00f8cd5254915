// CMA-ES whose offspring are preselected by Gaussian processes.
#pragma once
#include "studies/search/evolution.h"

namespace gaitlab::studies {

/// CMA-ES (Hansen 2016, with its default weights and rates) that draws six times as many offspring as the generation has
/// points. Models of objective and violation (point_models.h) rank the offspring. The best ranked fill three quarters of the
/// generation; the rest is drawn at random from the others, because the models may be wrong. pagmo's cmaes is not used: it
/// draws and evaluates in one step, so that offspring cannot be preselected. `settings.rated` must outlive the result.
std::unique_ptr<Evolution> cma_gp(const EvolutionSettings& settings);

}  // namespace gaitlab::studies
