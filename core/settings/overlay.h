// `--set key.path=value`: changes to a scenario's tree before it is read, so that they are checked like the file itself.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/settings/node.h"

namespace gaitlab {

/// A section (`cpg`, `controller`, `actuator`) whose `type` was changed by --set.
struct Retyped {
  std::string section, from, to;
};

/// Applies the texts in order (types first, so that the order of the options does not matter). The place of a changed node is
/// the option. Malformed texts are added to `problems`.
std::vector<Retyped> apply_sets(Node& root, const std::vector<std::string>& sets, Problems& problems);

/// Removes the `source` of `actuator` if --set changes other keys of that section and not the source: the source does not state
/// the new values. Returns a message for the user; empty: nothing was removed.
std::string drop_source(Node& root, const std::vector<std::string>& sets);

/// Removes keys of a retyped section that the new type does not have, unless --set gave them: keys of the old type, and all of
/// the old CPG's `model`. Returns a message for the user per section that lost keys.
std::vector<std::string> drop_old_keys(Node& root, const std::vector<Retyped>& retyped, const Catalog& catalog);

}  // namespace gaitlab
