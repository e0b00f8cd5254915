// The folder of a study, which one process at a time writes to.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gaitlab::studies {

/// A part of a study whose runs are done by a process of its own: those whose number is `index` modulo `count`.
struct Shard {
  std::uint64_t index = 0, count = 1;
  [[nodiscard]] bool whole() const { return count == 1; }
  [[nodiscard]] bool has(std::uint64_t run) const { return run % count == index; }
};

/// Holds the lock of a file for as long as it lives; the file says who.
class Lock {
 public:
  /// InputError: another process holds it and keeps it for a second, `PATH: error: process 12 on HOST is writing this study`.
  explicit Lock(std::filesystem::path file);
  ~Lock();
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  /// Who holds it, or "".
  static std::string holder(const std::filesystem::path& file);

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// Where a study is written. Without `out`: runs/NAME, or the first of NAME-2, NAME-3 ... that does not exist or `is_it` says
/// is of this study; with `out`: that folder. It is made if need be. InputError: it cannot be made; it is not empty, and holds
/// no study.
std::filesystem::path study_folder(const std::optional<std::filesystem::path>& out, const std::string& name,
                                   const std::function<bool(const std::filesystem::path&)>& is_it);

/// Where the journal of a shard is: study.db, or shards/I-of-N.db.
std::filesystem::path journal_file(const std::filesystem::path& folder, const Shard& shard);

/// What is in the folder shards: their numbers, and of how many they are.
struct Shards {
  std::uint64_t count = 0;             ///< 0: there are none
  std::vector<std::uint64_t> indices;  ///< ascending
};
/// InputError: shards of different numbers lie there.
Shards shards_in(const std::filesystem::path& folder);

/// Name of this machine.
std::string host();

}  // namespace gaitlab::studies
