// Rows of numbers, all of one length: in the scenario, or as a file.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/fields.h"
#include "core/settings/node.h"

namespace gaitlab {

using Rows = std::vector<std::vector<double>>;

/// The rows of a list of lists named `what`; empty with problems where a row is not a list, is longer or shorter than the
/// first, or a number is wrong.
Rows read_rows(const Node& list, const std::string& what, const Spec& spec, Problems& problems);

/// A text with a row per line, numbers separated by commas or blanks, comments after #: as such a list, each with its place.
Node grid_node(const std::string& text, const std::string& file);

}  // namespace gaitlab
