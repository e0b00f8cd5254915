// CMA-ES whose offspring are preselected by Gaussian processes.
#pragma once
#include "studies/search/evolution.h"

namespace gaitlab::studies {

/// CMA-ES (Hansen 2016, with its default weights and rates) that draws six times as many offspring as the generation has
/// points. Models of objective and violation (point_models.h) choose three quarters of the generation, the best of their order;
/// the rest is drawn from the remaining offspring, so that the models can err. pagmo's cmaes draws and evaluates in one step,
/// which leaves no place for a choice. `settings.rated` must outlive the result.
std::unique_ptr<Evolution> cma_gp(const EvolutionSettings& settings);

}  // namespace gaitlab::studies
