// Rated loads that a run exceeds, with the ratings that suffice.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "report/remedy/remedy_keys.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// A rated load without effect on the motion, and a sufficient rating.
struct RatingNeeded {
  std::string check, part;  ///< the part that exceeds its rating most; "" for the supply
  std::string setting;      ///< the key, without its section for a motor or dock: `i_continuous`, `supply.current`
  double rating = 0, now = 0;
  std::string unit;
  std::size_t parts = 1;  ///< number of parts beyond their ratings
  bool same = true;       ///< true if all parts have the same rating; otherwise only the factor rating / now suffices for all
};

std::vector<RatingNeeded> ratings_needed(const Scenario& scenario, const Verdict& verdict, const RemedySettings& settings);

/// True if the run exceeds no other limits than ratings.
bool only_ratings(const Verdict& verdict);

}  // namespace gaitlab::report
