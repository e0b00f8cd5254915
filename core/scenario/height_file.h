// File with the heights of a heightfield, as text or as a table written by NumPy or an image editor.
#pragma once
#include <string>

#include "core/laws/heightfield.h"
#include "core/plugin/fields.h"
#include "core/settings/node.h"
#include "core/settings/wording.h"

namespace gaitlab {

inline constexpr Spec kHeights{"m", -1e6, 1e6, "Heights, one row for each y, the least y first; instead of `file`."};
/// Largest number of heights that a resolved scenario contains in full, because its size is limited to 1 MB.
inline constexpr std::size_t kMostWritten = 40000;
inline constexpr std::size_t kMostHeights = 4096UL * 4096UL;  ///< most heights in a file

/// Hash of the heights of a field, and the name, from this hash, of the file with the heights in a run folder.
std::string heights_hash(const Heightfield& field);
std::string heights_name(const Heightfield& field);

/// True if there are too many heights for a resolved scenario. It then contains the file name heights_name() instead.
inline bool needs_height_file(const Heightfield* field) { return field != nullptr && !field->source.file.empty(); }
/// The bytes of the file heights_name(): a float64 matrix in the format of numpy.save, compressed by gzip.
std::string packed_heights(const Heightfield& field);

/// Reads heights from a file and multiplies them by `field.source.scale`. `map` is the node of `ground.heightfield`, whose path
/// is relative to `folder`. Sets `field.source` to the file if there are more heights than kMostWritten. Returns the place of
/// the first height, for errors that concern all heights.
SourceLocation read_height_file(const Node& map, const std::string& folder, Heightfield& field, Problems& problems);

}  // namespace gaitlab
