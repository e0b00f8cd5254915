// Where the sections and keys of a scenario were given, and in which order its problems are reported.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/settings/node.h"

namespace gaitlab {

/// SourceLocation of a key's value (`key` empty: of the section's name), or nothing where it is not given.
std::optional<SourceLocation> given(const Node& root, const std::string& section, const std::string& key = {});

/// The same, or the section's name, or the whole map.
SourceLocation place_of(const Node& root, const std::string& section, const std::string& key);

/// Notes where every key of a map was given, `physics.step` and so on.
void note_places(const Node& map, const std::string& prefix, std::map<std::string, SourceLocation>& places);

/// Stable by place within the scenario file, so that findings come in the order in which one reads.
std::vector<Problem> in_order(std::vector<Problem> problems, const std::string& file);

}  // namespace gaitlab
