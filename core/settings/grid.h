// Reader of rows of numbers with equal lengths, in the scenario or in a file.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/fields.h"
#include "core/settings/node.h"

namespace gaitlab {

using Rows = std::vector<std::vector<double>>;

/// Rows of a list of lists; `what` is the name of the list in messages. Adds problems and returns an empty result if a row is
/// not a list or differs in length from the first row, or if a number is invalid.
Rows read_rows(const Node& list, const std::string& what, const Spec& spec, Problems& problems);

/// Node of a text with one row per line. Numbers are separated by commas or blanks, and comments follow #. The node is a list
/// of lists, each with its place in the file.
Node grid_node(const std::string& text, const std::string& file);

}  // namespace gaitlab
