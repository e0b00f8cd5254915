// Hopeless runs, which have lost a check of the verdict before their end.
#pragma once
#include <span>
#include <string>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// A margin that the run needs at its end.
struct NeededMargin {
  std::string check;     ///< id
  std::string quantity;  ///< `margin.ID`, or `margin.ID[LIMIT]` for another limit than the scenario's
  double least = 0;
};

/// A lost check, and its worst part. Both are empty if no check is lost.
struct LostCheck {
  std::string check, part;
};

/// The first of these checks that is lost (Lost) in an incomplete recording, in a call of Simulation::watch. No check is lost
/// in the first two periods after the start of the gait (in the first 2 s if no period is stated), or in a call after which no
/// further period has ended. Checks of the judged window count from the third period on, which every judged window contains;
/// without a stated period they are never lost. A share of the time must also exceed its limit in the longest window that the
/// run can have, even if the rest of the run adds nothing. Poses of earlier calls are not compared again.
LostCheck lost_check(std::span<const NeededMargin> needed, const Scenario& scenario, const Recording& so_far);

}  // namespace gaitlab::report
