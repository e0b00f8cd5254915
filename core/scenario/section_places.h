// Locations of the sections and keys of a scenario in its file, and the order in which its problems are reported.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Place of a key's value (`key` empty: of the section's name), or nothing if the key is absent.
std::optional<SourceLocation> given(const Node& root, const std::string& section, const std::string& key = {});

/// The same, or else the place of the section's name, or of the whole map.
SourceLocation place_of(const Node& root, const std::string& section, const std::string& key);

/// Notes the place of every key of a map under its path, `physics.step` and so on.
void note_places(const Node& map, const std::string& prefix, std::map<std::string, SourceLocation>& places);

/// Problems in stable order of their places within the scenario file, so that they are reported in reading order.
std::vector<Problem> in_order(std::vector<Problem> problems, const std::string& file);

}  // namespace gaitlab
