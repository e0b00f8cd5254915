// Searches of one study with several seeds, one after another, and their results side by side.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace gaitlab::app {

struct SeedSearches {
  std::int64_t first = 1, count = 2;  ///< seeds first, first + 1 ...
  std::filesystem::path folder;       ///< folder of the folders seed-N
  std::string command;                ///< command line that continues the searches
  bool quiet = false;
  /// Searches with a seed in a folder, and returns the exit code of `gaitlab optimize`.
  std::function<int(std::int64_t seed, const std::filesystem::path& folder)> search;
};

/// Runs the searches and prints a line for each, the median of their best values, and the least and the largest. Returns 0 if
/// at least one verified a point, 3 if none did, and 1 if interrupted.
int search_seeds(const SeedSearches& searches);

/// Folder of one seed.
std::filesystem::path folder_of_seed(const std::filesystem::path& folder, std::int64_t seed);

/// Folder that contains the folders of all seeds. With `out` it is that folder, which must not exist, or contain only folders
/// seed-N. Without `out` it is runs/NAME, or else the first of NAME-2, NAME-3 ... that does not exist or whose folder of the
/// first seed satisfies `is_it`. Throws InputError for another folder, or if it cannot be created.
std::filesystem::path seeds_folder(const std::optional<std::string>& out, const std::string& name, std::int64_t first,
                                   const std::function<bool(const std::filesystem::path&)>& is_it);

}  // namespace gaitlab::app
