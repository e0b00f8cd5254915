// The option `--set key.path=value`. It changes a scenario's tree before the tree is read, so that its values are checked like
// values in the file.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/settings/node.h"

namespace gaitlab {

/// A section (`cpg`, `controller`, `actuator`) whose key `type` was changed by --set.
struct Retyped {
  std::string section, from, to;
};

/// True if --set gave this node.
bool is_set(const Node& node);

/// Applies the settings to the tree: first settings of `type`, then all others in their order. The place of a changed node is
/// the option. Malformed settings are added to `problems`.
std::vector<Retyped> apply_sets(Node& root, const std::vector<std::string>& sets, Problems& problems);

/// Sets the value of a key such as `cpg.frequency`. New nodes on the path, and messages, have the place `place`; the value
/// keeps its place.
void overlay(Node& root, const std::string& path, Node value, const SourceLocation& place, Problems& problems);

/// Removes the key `source` of `actuator` if --set changes other keys of that section but not `source`, because the source does
/// not state the new values. Returns a message for the user, or "" if nothing was removed.
std::string drop_source(Node& root, const std::vector<std::string>& sets);

/// If --set names an engine, removes from `physics` the keys `accuracy` and `integrator` that this engine does not support,
/// unless --set gave them. Returns a message for the user, or "" if nothing was removed.
std::string drop_engine_keys(Node& root, const std::vector<std::string>& sets, const Catalog& catalog);

/// Removes keys of a retyped section that the new type lacks, and the whole `model` of the old CPG, unless --set gave them.
/// Returns a message for the user for each section that lost keys.
std::vector<std::string> drop_old_keys(Node& root, const std::vector<Retyped>& retyped, const Catalog& catalog);

}  // namespace gaitlab
