// Text of a table with cells.
#pragma once
#include <string>
#include <vector>

namespace gaitlab::app {

using Cells = std::vector<std::string>;

/// Table text with columns as wide as their widest cell, indented and separated by two blanks. Cells are flush left. All rows
/// have as many cells as the first one.
std::string cells_text(const std::vector<Cells>& rows);

}  // namespace gaitlab::app
