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

/// Applies the texts in order (types first, so that the order of the options does not matter). A changed node's place is the
/// option itself. Malformed texts go to `problems`.
std::vector<Retyped> apply_sets(Node& root, const std::vector<std::string>& sets, Problems& problems);

/// Takes a source of `actuator` that --set gives no word of out where --set gives other keys of that section: the source does
/// not say these. Returns a line for the user; empty: there is nothing to take out.
std::string drop_source(Node& root, const std::vector<std::string>& sets);

/// What of a retyped section the new type does not know is taken out, unless it was itself given by --set: keys of the old
/// type, and all of the old CPG's `model`. Returns a line for the user per section that lost something.
std::vector<std::string> drop_old_keys(Node& root, const std::vector<Retyped>& retyped, const Catalog& catalog);

}  // namespace gaitlab
