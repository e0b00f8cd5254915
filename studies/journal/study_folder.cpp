#include "studies/journal/study_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <system_error>
#include <thread>

#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/recording/run_folder.h"
#include "studies/journal/journal.h"
#include "studies/journal/journal_tables.h"

namespace gaitlab::studies {

namespace {

namespace fs = std::filesystem;

struct ShardName {
  std::string index, count;
};

/// The two numbers in a name I-of-N.db, even if such a shard is impossible.
std::optional<ShardName> shard_name(const std::string& name) {
  constexpr std::string_view kOf = "-of-";
  constexpr std::string_view kEnd = ".db";
  const std::size_t middle = name.find(kOf);
  if (!name.ends_with(kEnd) || middle == std::string::npos || middle + kOf.size() + kEnd.size() > name.size()) return {};
  const auto digits = [](const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  };
  ShardName found{name.substr(0, middle), name.substr(middle + kOf.size())};
  found.count.resize(found.count.size() - kEnd.size());
  if (!digits(found.index) || !digits(found.count)) return {};
  return found;
}

/// Shard with a given name; nothing if such a shard is impossible.
std::optional<Shard> shard_of(const ShardName& name) {
  constexpr std::size_t kDigits = 7;  // the same limit as for --shard
  for (const std::string& text : {name.index, name.count}) {
    if (text.size() > kDigits || (text.size() > 1 && text.front() == '0')) return {};
  }
  const Shard shard{std::stoul(name.index), std::stoul(name.count)};
  return shard.index < shard.count ? std::optional(shard) : std::nullopt;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    names.push_back(entry.path().filename().string());
  return names;
}

/// Kind of a file, by its first bytes.
enum class Content { journal, unborn, other };

/// Kind of a file. `unborn` is an empty file or a database without an application ID. A process that is killed while it creates
/// its journal leaves such a file.
Content content_of(const fs::path& file) {
  constexpr std::string_view kSqlite{"SQLite format 3\0", 16};
  constexpr std::size_t kPlace = 68;  // position of the application_id: four bytes, most significant first
  std::error_code none;
  if (fs::is_symlink(file, none)) return Content::other;
  std::string bytes;
  try {
    bytes = read_start(file, kPlace + 4);
  } catch (const InputError&) {
    return Content::other;
  }
  if (bytes.empty()) return Content::unborn;
  if (bytes.size() < kPlace + 4 || !bytes.starts_with(kSqlite)) return Content::other;
  std::uint32_t application = 0;
  for (std::size_t k = 0; k < 4; ++k) application = application << 8U | static_cast<unsigned char>(bytes[kPlace + k]);
  if (application == kApplication) return Content::journal;
  return application == 0 ? Content::unborn : Content::other;
}

/// True if a name is that of a journal, or of a file that SQLite keeps beside a journal.
bool is_journals(const std::string& name) {
  for (const char* behind : {"-wal", "-shm", "-journal"}) {
    if (name.ends_with(behind)) return is_journals(name.substr(0, name.size() - std::string_view(behind).size()));
  }
  return name == kJournalFile || shard_name(name).has_value();
}

/// True if the folder contains only the files of a study that was killed at its start.
bool holds_a_start(const fs::path& folder) {
  const std::vector<std::string> names = names_in(folder);
  return std::ranges::all_of(names, [&](const std::string& name) {
    const fs::path file = folder / name;
    if (name == "shards") return fs::is_directory(fs::symlink_status(file)) && holds_a_start(file);
    if (name == "lock" || name.ends_with(".lock")) return is_lock(file);
    return is_journals(name) && (!name.ends_with(".db") || content_of(file) == Content::unborn);
  });
}

bool holds_a_journal(const fs::path& folder) {
  if (content_of(folder / kJournalFile) == Content::journal) return true;
  const fs::path shards = folder / "shards";
  return std::ranges::any_of(names_in(shards), [&](const std::string& name) {
    return shard_name(name) && content_of(shards / name) == Content::journal;
  });
}

/// True if a folder belongs to a study; false for an empty folder. Throws InputError if its study.db is not a journal.
bool is_studys(const fs::path& folder) {
  std::error_code none;
  if (fs::is_empty(folder, none) || none) return false;
  if (holds_a_journal(folder) || holds_a_start(folder)) return true;
  if (!fs::exists(fs::symlink_status(folder / kJournalFile, none))) return false;
  const Journal there(folder / kJournalFile);  // throws if it is not a journal
  return true;
}

}  // namespace

Shards shards_in(const fs::path& folder) {
  Shards shards;
  for (const std::string& name : names_in(folder / "shards")) {
    const std::optional<ShardName> parts = shard_name(name);
    if (!parts) continue;
    const std::optional<Shard> shard = shard_of(*parts);
    if (!shard) {
      throw InputError(SourceLocation{(folder / "shards" / name).string()},
                       "is not a shard of a study; expected I-of-N.db with I from 0 to N - 1, without zeros in front");
    }
    if (shards.count != 0 && shard->count != shards.count) {
      throw InputError(SourceLocation{(folder / "shards").string()},
                       fmt::format("holds shards of a division into {} and of one into {}; expected the shards of one division",
                                   std::min(shard->count, shards.count), std::max(shard->count, shards.count)));
    }
    shards.count = shard->count;
    shards.indices.push_back(shard->index);
  }
  std::ranges::sort(shards.indices);
  return shards;
}

fs::path study_folder(const std::optional<fs::path>& out, const std::string& name,
                      const std::function<bool(const fs::path&)>& is_it) {
  for (int k = 1; !out; ++k) {
    fs::path folder = fs::path("runs") / (k == 1 ? name : fmt::format("{}-{}", name, k));
    std::error_code none;
    if (!fs::exists(folder, none)) break;
    if (is_it(folder)) return folder;
  }
  for (bool again = out.has_value();; again = false) {
    if (out && is_studys(*out)) return *out;
    try {
      RunFolder folder(out, name);
      folder.keep();
      return folder.path();
    } catch (const InputError&) {
      if (!again) throw;
    }
    constexpr std::chrono::milliseconds kPatience{20};  // another shard may be creating the folder
    std::this_thread::sleep_for(kPatience);
  }
}

fs::path shard_file(const fs::path& folder, const Shard& shard) {
  return folder / "shards" / fmt::format("{}-of-{}.db", shard.index, shard.count);
}

fs::path journal_file(const fs::path& folder, const Shard& shard) {
  return shard.whole() ? folder / kJournalFile : shard_file(folder, shard);
}

}  // namespace gaitlab::studies
