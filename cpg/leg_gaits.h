// Gaits of legged robots by name: shares of the cycle in stance, and phases of the legs.
#pragma once
#include <vector>

#include "core/plugin/robot_info.h"

namespace gaitlab::cpg {

enum class Gait { trot, tripod, alternate, pace, bound, gallop, walk, crawl, wave, ripple };
inline constexpr const char* kGaitNames[] = {"trot",   "tripod", "alternate", "pace", "bound",
                                             "gallop", "walk",   "crawl",     "wave", "ripple"};

/// Usual share of the cycle in which a leg of this gait stands.
double duty_of(Gait gait, const std::vector<Leg>& legs);

/// Lead of each leg, share of the cycle: a leg with lead p begins its stance at the times (k - p) / f. Throws
/// std::invalid_argument for an odd number of legs in trot, tripod and alternate.
std::vector<double> phases_of(Gait gait, const std::vector<Leg>& legs);

/// True for gaits in which the body leans over the legs that stand.
inline bool leans(Gait gait) { return gait == Gait::walk || gait == Gait::crawl; }

}  // namespace gaitlab::cpg
