// Files without a name, which the system deletes when their last descriptor is closed.
#pragma once
#include <filesystem>

namespace gaitlab {

/// Opens a new file without a name in a folder, for reading and writing. Returns its descriptor, or -1 with the reason in
/// errno.
[[nodiscard]] int unnamed_file(const std::filesystem::path& folder);

}  // namespace gaitlab
