// File with the heights of a heightfield: text, or a table written by NumPy or an image editor.
#pragma once
#include <string>

#include "core/laws/heightfield.h"
#include "core/plugin/fields.h"
#include "core/settings/node.h"
#include "core/settings/wording.h"

namespace gaitlab {

inline constexpr Spec kHeights{"m", -1e6, 1e6, "Heights, a row for each y, upwards; instead of `file`."};
inline constexpr std::size_t kMostWritten = 40000;  ///< heights that a resolved scenario, of at most 1 MB, holds in full
inline constexpr std::size_t kMostHeights = 4096UL * 4096UL;  ///< in a file

/// Reads the heights from the file that `map`, the node of `ground.heightfield`, names relative to `folder`, times
/// `field.source.scale`. Sets `field.source` to the file if there are more heights than kMostWritten. Returns the place of the
/// first height, for errors that concern all heights.
SourceLocation read_height_file(const Node& map, const std::string& folder, Heightfield& field, Problems& problems);

}  // namespace gaitlab
