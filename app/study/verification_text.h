// Text on the verification of the best points of a search.
#pragma once
#include <string>

#include "studies/journal/journal.h"
#include "studies/search/world_trials.h"

namespace gaitlab::app {

/// Text with the result of the verification of each best point, the reasons if it failed, and the worlds where it falls. Empty
/// if no point was verified. A table of the winner with each joint dead in turn follows if `verify.faults` is `each`.
std::string verification_text(studies::Journal& journal);

/// Text with the worlds where a point falls, as in `falls by supply -10 % (6.66 V): voltage of m5/passive; and in 1 of 7
/// draws`. Empty if there are none.
std::string falls_text(const studies::WorldCount& count);

/// Sentence on the nearest point, with its worlds and remedies, for a search without a verified point. Empty if no point was
/// run in worlds.
std::string nearest_text(studies::Journal& journal);

}  // namespace gaitlab::app
