// Folder of a study, which only one process at a time writes.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/journal/study_lock.h"

namespace gaitlab::studies {

/// A part of a study that a separate process simulates: the runs with run number modulo `count` equal to `index`.
struct Shard {
  std::uint64_t index = 0, count = 1;
  [[nodiscard]] bool whole() const { return count == 1; }
  [[nodiscard]] bool has(std::uint64_t run) const { return run % count == index; }
};

/// Folder of a study, created if needed. It is the folder `out` if `out` is given. Without `out`, it is runs/NAME, or else the
/// first of NAME-2, NAME-3 ... that does not exist or for which `is_it` returns true. Throws InputError if the folder cannot be
/// created. Throws InputError also if it contains foreign files: neither study.db nor a shard is a journal, and the files are
/// not those that a sweep leaves when it is killed at its start.
std::filesystem::path study_folder(const std::optional<std::filesystem::path>& out, const std::string& name,
                                   const std::function<bool(const std::filesystem::path&)>& is_it);

/// Path of a shard's journal: study.db, or shards/I-of-N.db.
std::filesystem::path journal_file(const std::filesystem::path& folder, const Shard& shard);
/// Path shards/I-of-N.db of a shard, also if N is 1.
std::filesystem::path shard_file(const std::filesystem::path& folder, const Shard& shard);

/// Shards in the folder `shards`: their indices and the count in their names.
struct Shards {
  std::uint64_t count = 0;             ///< 0 if the folder contains no shards
  std::vector<std::uint64_t> indices;  ///< ascending
};
/// Throws InputError if shards have different counts, or if a name is impossible, such as 7-of-4.db or 03-of-4.db.
Shards shards_in(const std::filesystem::path& folder);

}  // namespace gaitlab::studies
