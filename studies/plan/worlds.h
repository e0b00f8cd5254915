// Worlds: variants of a scenario, with uncertain numbers changed within their usual errors.
#pragma once
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace gaitlab::studies {

/// A world (docs/decisions/0039-worlds.md). The gears of each world create no energy (`efficiency_model:
/// directional` of dc_motor; `load_friction` of servo always is).
struct World {
  std::string name;         ///< `supply -10 %`, or `draw 3`
  std::string number = {};  ///< the changed number, as in `6.66 V`, or `seed 4`; empty if it differs from part to part
  bool drawn = false;       ///< true if all numbers are drawn within tolerances
  bool applies = true;      ///< false if the scenario has no such number; only the gears then differ
  std::int64_t seed = 0;    ///< seed of the scenario, or of the draw
  std::vector<std::string> sets = {};  ///< settings in the form of --set
  /// Name and number: `supply -10 % (6.66 V)`.
  [[nodiscard]] std::string text() const;
};

/// The worlds of a scenario, in the same order for each. Each of worlds 1 to 13 changes one number to one end of its usual
/// error: friction by 25 %, R and Kt by 5 %, mass by 3 %, supply by -10 %; gear friction and rotor inertia, where they are
/// chosen (core/scenario/chosen_friction.h), to a half and to twice. The factors of `as_built`, stated or drawn, are multiplied
/// by this change. All numbers of worlds 14 to 20 are drawn: within the scenario's own `tolerances` or, if it has none, with
/// half of the lower errors above as standard deviations. Their seeds are the seven after the scenario's seed. Under
/// `contact.law: bullet`, the friction of the ground and its boxes changes, because this law does not have factors by part.
/// Throws PluginError.
std::vector<World> worlds(const Scenario& own);
inline constexpr std::size_t kWorlds = 20;

}  // namespace gaitlab::studies
