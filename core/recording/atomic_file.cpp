#include "core/recording/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/errors.h"

namespace gaitlab {

namespace {

constexpr std::size_t kReadPiece = std::size_t{1} << 20;  // bytes; keeps the number of system calls small

// 0 or errno; a signal that only interrupts is not a failure.
int sync(int descriptor) {
  while (::fsync(descriptor) != 0) {
    if (errno != EINTR) return errno;
  }
  return 0;
}

// Makes a rename in `folder` survive a power cut.
int sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  int error = sync(descriptor);
  if (error == EINVAL || error == ENOTSUP) error = 0;  // file systems that cannot sync a folder say so in this way
  if (::close(descriptor) != 0 && error == 0 && errno != EINTR) error = errno;
  return error;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
  part_ += ".part";
  descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(errno);
  pending_ = true;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      fail(errno);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  if (const int error = sync(descriptor_); error != 0) fail(error);
  // On Linux the descriptor is gone even if close fails; EINTR says nothing about the data, which is synced.
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail(errno);
  if (::rename(part_.c_str(), path_.c_str()) != 0) fail(errno);
  pending_ = false;
  const std::filesystem::path folder = path_.parent_path();
  if (const int error = sync_folder(folder.empty() ? "." : folder); error != 0) fail(error);
}

void AtomicFile::fail(int error) {
  discard();
  throw RunError(fmt::format("{}: cannot be written: {}", path_.string(), std::generic_category().message(error)));
}

void AtomicFile::discard() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (std::exchange(pending_, false)) ::unlink(part_.c_str());
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

std::filesystem::file_type kind_of(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(path, error).type();
  if (type == std::filesystem::file_type::none)
    throw InputError(SourceLocation{path.string()}, "cannot be read: " + std::generic_category().message(error.value()));
  return type;
}

std::string read_file(const std::filesystem::path& path) {
  const auto fail = [&](int error) -> InputError {
    return {SourceLocation{path.string()}, "cannot be read: " + std::generic_category().message(error)};
  };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw fail(errno);
  std::string text;
  ssize_t got = 0;
  do {
    const std::size_t size = text.size();
    text.resize(size + kReadPiece);
    got = ::read(descriptor, text.data() + size, kReadPiece);
    const int error = errno;
    text.resize(size + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got < 0 && error != EINTR) {
      ::close(descriptor);
      throw fail(error);
    }
  } while (got != 0);
  ::close(descriptor);
  return text;
}

}  // namespace gaitlab
