// Places of the sections and keys of a scenario in its file, and the order of reported problems.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/laws/contact_model.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Place of a key's value, or nothing if the key is absent. If `key` is empty, the place of the section's name.
std::optional<SourceLocation> given(const Node& root, const std::string& section, const std::string& key = {});

/// Place of a key's value, or else of the section's name, or else of the whole map.
SourceLocation place_of(const Node& root, const std::string& section, const std::string& key);

/// Place of a fault that a plugin reports about the settings of its section as a whole. It is the option --set that gave `key`,
/// which the plugin names (PluginError), or else the section's `type`.
SourceLocation place_of_fault(const Node& root, const std::string& section, const std::string& key);

/// Contact law of a scenario, searched before the section `contact` is read, because the default step depends on the law.
ContactLaw wanted_law(const Node& root);

/// Adds the place of every key of a map, under a path such as `physics.step`.
void note_places(const Node& map, const std::string& prefix, std::map<std::string, SourceLocation>& places);

/// Adds the places of the keys in the sections that `reads` names, if they differ from the places in `common`.
void note_own_places(const Node& root, const std::function<bool(const std::string& section)>& reads,
                     const std::map<std::string, SourceLocation>& common, std::map<std::string, SourceLocation>& own);

/// Problems sorted by their places within the scenario file, so that they are reported in reading order. Equal places keep
/// their order.
std::vector<Problem> in_order(std::vector<Problem> problems, const std::string& file);

}  // namespace gaitlab
