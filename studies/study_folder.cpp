#include "studies/study_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "core/errors.h"
#include "core/recording/run_folder.h"
#include "core/scenario/wording.h"
#include "studies/journal.h"

namespace gaitlab::studies {

namespace {

namespace fs = std::filesystem;

std::string reason() { return std::generic_category().message(errno); }

std::string first_line(int descriptor) {
  std::array<char, 200> bytes{};
  const ssize_t size = ::pread(descriptor, bytes.data(), bytes.size(), 0);
  std::string text(bytes.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  return clipped(text.substr(0, text.find('\n')));
}

}  // namespace

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

Lock::Lock(fs::path file) : file_(std::move(file)) {
  // Not followed where it is a link: what it leads to would be overwritten.
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor_ < 0) throw InputError(SourceLocation{file_.string()}, "cannot be opened: " + reason());
  // A killed process may not have ended yet where the next one begins: a batch system that starts a job anew.
  constexpr int kPatience = 50;  // times 20 ms
  int taken = ::flock(descriptor_, LOCK_EX | LOCK_NB);
  for (int k = 0; k < kPatience && taken != 0 && errno == EWOULDBLOCK; ++k) {
    ::usleep(20000);
    taken = ::flock(descriptor_, LOCK_EX | LOCK_NB);
  }
  if (taken != 0) {
    const int error = errno;
    const std::string who = first_line(descriptor_);
    ::close(descriptor_);
    if (error != EWOULDBLOCK)
      throw InputError(SourceLocation{file_.string()}, "cannot be locked: " + std::generic_category().message(error));
    throw InputError(SourceLocation{file_.string()},
                     (who.empty() ? "another process" : who) +
                         " is writing this study; wait for it, or look at what there is with `gaitlab study show`");
  }
  const std::string text = fmt::format("process {} on {}\n", ::getpid(), host());
  // For people: a study whose disk is full says so where it matters.
  if (::ftruncate(descriptor_, 0) == 0) (void)!::pwrite(descriptor_, text.data(), text.size(), 0);
}

Lock::~Lock() {
  if (::ftruncate(descriptor_, 0) != 0) errno = 0;
  ::close(descriptor_);
}

std::string Lock::holder(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return {};
  const bool held = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0;
  std::string who = held ? first_line(descriptor) : "";
  ::close(descriptor);
  return who;
}

Shards shards_in(const fs::path& folder) {
  Shards shards;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "shards", none)) {
    const std::string name = entry.path().filename().string();
    const std::size_t middle = name.find("-of-");
    if (!name.ends_with(".db") || middle == std::string::npos) continue;
    const std::string index = name.substr(0, middle);
    const std::string count = name.substr(middle + 4, name.size() - middle - 7);
    const auto number = [](const std::string& text) {
      return !text.empty() && text.size() < 8 && text.find_first_not_of("0123456789") == std::string::npos;
    };
    if (!number(index) || !number(count)) continue;
    const auto of = static_cast<std::uint64_t>(std::stoul(count));
    if (shards.count != 0 && of != shards.count)
      throw InputError(SourceLocation{(folder / "shards").string()},
                       fmt::format("holds shards of {} and of {}; expected those of one division", std::min(of, shards.count),
                                   std::max(of, shards.count)));
    shards.count = of;
    shards.indices.push_back(std::stoul(index));
  }
  std::ranges::sort(shards.indices);
  return shards;
}

fs::path study_folder(const std::optional<fs::path>& out, const std::string& name,
                      const std::function<bool(const fs::path&)>& is_it) {
  const auto has_study = [](const fs::path& folder) {
    std::error_code none;
    return fs::exists(folder / kJournalFile, none) || fs::exists(folder / "shards", none) || fs::exists(folder / "lock", none);
  };
  if (out && has_study(*out)) return *out;
  for (int k = 1; !out; ++k) {
    const fs::path folder = fs::path("runs") / (k == 1 ? name : fmt::format("{}-{}", name, k));
    std::error_code none;
    if (!fs::exists(folder, none)) break;
    if (has_study(folder) && is_it(folder)) return folder;
  }
  RunFolder folder(out, name);
  folder.keep();
  return folder.path();
}

fs::path journal_file(const fs::path& folder, const Shard& shard) {
  return shard.whole() ? folder / kJournalFile : folder / "shards" / fmt::format("{}-of-{}.db", shard.index, shard.count);
}

}  // namespace gaitlab::studies
