// Rows of numbers of equal length: in the scenario, or in a file.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/fields.h"
#include "core/settings/node.h"

namespace gaitlab {

using Rows = std::vector<std::vector<double>>;

/// Rows of a list of lists named `what`; empty with problems if a row is not a list, its length differs from the first row's,
/// or a number is wrong.
Rows read_rows(const Node& list, const std::string& what, const Spec& spec, Problems& problems);

/// Node of a text with one row per line, numbers separated by commas or blanks, comments after #: a list of lists, each with
/// its place.
Node grid_node(const std::string& text, const std::string& file);

}  // namespace gaitlab
