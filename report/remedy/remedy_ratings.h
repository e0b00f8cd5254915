// Rated loads that a run exceeds, with the ratings that suffice.
#pragma once
#include <vector>

#include "report/remedy/remedy.h"

namespace gaitlab::report {

std::vector<RatingNeeded> ratings_needed(const RemedyTask& task, const RemedySettings& settings);

/// True if the run exceeds no other limits than ratings.
bool only_ratings(const Verdict& verdict);

}  // namespace gaitlab::report
