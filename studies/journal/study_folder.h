// The folder of a study, which one process at a time writes to.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/journal/study_lock.h"

namespace gaitlab::studies {

/// A part of a study whose runs are done by a process of its own: those whose number is `index` modulo `count`.
struct Shard {
  std::uint64_t index = 0, count = 1;
  [[nodiscard]] bool whole() const { return count == 1; }
  [[nodiscard]] bool has(std::uint64_t run) const { return run % count == index; }
};

/// Where a study is written. Without `out`: runs/NAME, or the first of NAME-2, NAME-3 ... that does not exist or `is_it` says
/// is of this study; with `out`: that folder. It is made if need be. InputError: it cannot be made; it is not empty, and
/// nothing proves that it is a study's: neither study.db nor a shard is a journal, and something is there that a sweep which
/// was killed at its start does not leave.
std::filesystem::path study_folder(const std::optional<std::filesystem::path>& out, const std::string& name,
                                   const std::function<bool(const std::filesystem::path&)>& is_it);

/// Where the journal of a shard is: study.db, or shards/I-of-N.db.
std::filesystem::path journal_file(const std::filesystem::path& folder, const Shard& shard);
/// shards/I-of-N.db, also of the only one.
std::filesystem::path shard_file(const std::filesystem::path& folder, const Shard& shard);

/// What is in the folder shards: their numbers, and of how many they are.
struct Shards {
  std::uint64_t count = 0;             ///< 0: there are none
  std::vector<std::uint64_t> indices;  ///< ascending
};
/// InputError: shards of different numbers lie there, or one that no division has, as 7-of-4.db and 03-of-4.db.
Shards shards_in(const std::filesystem::path& folder);

}  // namespace gaitlab::studies
