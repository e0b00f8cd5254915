// What studies can ask of a run: the one list of summary numbers, and the verdict.
#pragma once
#include "studies/study/judge.h"

namespace gaitlab::app {

studies::FigureOffer figure_offer();

/// Of these columns, and the verdict's word. InputError: a column is not known (of a journal of another program).
studies::Measure figure_measure(const std::vector<studies::FigureName>& columns, const Scenario& scenario);

}  // namespace gaitlab::app
