// Columns of the observations and of the truth of episodes.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::kit {

/// A number of a row of observations or of truth.
struct EpisodeColumn {
  std::string name, unit;
};

/// Columns of an observation: the values of Measured, in their order.
std::vector<EpisodeColumn> observed_columns(const Scenario& scenario);
/// Columns of truth: base, energy, time, and the loads of these legs.
std::vector<EpisodeColumn> columns_of_truth(const std::vector<Leg>& legs);

}  // namespace gaitlab::kit
