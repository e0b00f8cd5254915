// Folder of a study, written by one process at a time.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/journal/study_lock.h"

namespace gaitlab::studies {

/// A part of a study whose runs are done by a separate process: those whose number is `index` modulo `count`.
struct Shard {
  std::uint64_t index = 0, count = 1;
  [[nodiscard]] bool whole() const { return count == 1; }
  [[nodiscard]] bool has(std::uint64_t run) const { return run % count == index; }
};

/// Folder of a study. Without `out`: runs/NAME, or the first of NAME-2, NAME-3 ... that does not exist or for which `is_it`
/// returns true; with `out`: that folder. It is created if needed. Throws InputError if it cannot be created, or if it is not
/// empty and not a study's: neither study.db nor a shard is a journal, and it has files that a sweep killed at its start does
/// not leave.
std::filesystem::path study_folder(const std::optional<std::filesystem::path>& out, const std::string& name,
                                   const std::function<bool(const std::filesystem::path&)>& is_it);

/// Path of a shard's journal: study.db, or shards/I-of-N.db.
std::filesystem::path journal_file(const std::filesystem::path& folder, const Shard& shard);
/// shards/I-of-N.db, even if N is 1.
std::filesystem::path shard_file(const std::filesystem::path& folder, const Shard& shard);

/// Shards in the folder shards: their indices and count.
struct Shards {
  std::uint64_t count = 0;             ///< 0: there are none
  std::vector<std::uint64_t> indices;  ///< ascending
};
/// Throws InputError if there are shards of different counts, or one with an impossible name, such as 7-of-4.db and 03-of-4.db.
Shards shards_in(const std::filesystem::path& folder);

}  // namespace gaitlab::studies
