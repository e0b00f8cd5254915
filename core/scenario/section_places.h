// Places of the sections and keys of a scenario in its file, and the order in which problems are reported.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Place of a key's value, or nothing if the key is absent. If `key` is empty, the place of the section's name.
std::optional<SourceLocation> given(const Node& root, const std::string& section, const std::string& key = {});

/// Place of a key's value, or else of the section's name, or else of the whole map.
SourceLocation place_of(const Node& root, const std::string& section, const std::string& key);

/// Adds the place of every key of a map, under a path such as `physics.step`.
void note_places(const Node& map, const std::string& prefix, std::map<std::string, SourceLocation>& places);

/// Problems sorted by their places within the scenario file, so that they are reported in reading order. Equal places keep
/// their order.
std::vector<Problem> in_order(std::vector<Problem> problems, const std::string& file);

}  // namespace gaitlab
