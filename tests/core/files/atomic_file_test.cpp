#include "core/files/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/errors.h"
#include "core/files/folder_lock.h"
#include "tests/folder.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

namespace fs = std::filesystem;

class AtomicFiles : public testing::Test {
 protected:
  [[nodiscard]] std::string text() const { return test::read(file_); }

  const test::Folder own_;
  const fs::path folder_ = own_.path();
  const fs::path file_ = folder_ / "trace.csv";

  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
};

// Simulates a disk that is full after `bytes`: the kernel refuses to enlarge a file beyond this size, with an error like
// ENOSPC.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_ = {};
};

/// An InputError or a RunError.
template <class Call>
std::string refusal(const Call& call) {
  return test::message_of<std::exception>(call);
}

TEST_F(AtomicFiles, AppearsAtCommit) {
  AtomicFile file(file_);
  file.write("one ");
  file.write("two");
  EXPECT_FALSE(fs::exists(file_));
  file.commit();
  EXPECT_EQ(files(), 1U);
  EXPECT_EQ(text(), "one two");
}

TEST_F(AtomicFiles, LeavesNothingWithoutCommit) {
  { AtomicFile(file_).write("half"); }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(AtomicFiles, ReplacesTheOldFile) {
  std::ofstream(file_) << "old, and longer than the new text";
  write_file(file_, "new");
  EXPECT_EQ(text(), "new");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFiles, OfTwoWritersTheLastOnesBytesAreThereWhole) {
  AtomicFile first(file_);
  AtomicFile second(file_);
  first.write("first");
  second.write("second");
  first.write(", whole");
  second.commit();
  EXPECT_EQ(text(), "second");
  first.commit();
  EXPECT_EQ(text(), "first, whole");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFiles, OfTwoWritersOfANewFileTheSecondOneIsTold) {
  AtomicFile first(file_, Existing::refused);
  AtomicFile second(file_, Existing::refused);
  first.write("first");
  second.write("second");
  second.commit();
  EXPECT_EQ(refusal([&] { first.commit(); }), file_.string() + ": error: exists; nothing was written");
  EXPECT_EQ(text(), "second");
  EXPECT_EQ(refusal([&] { AtomicFile(file_, Existing::refused); }), file_.string() + ": error: exists; nothing was written");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFiles, NeverFollowsALinkNorReplacesIt) {
  const fs::path victim = folder_ / "victim";
  std::ofstream(victim) << "precious";
  fs::create_symlink(victim, file_);
  const std::string told = file_.string() + ": cannot be written: is a link; name the file that it leads to";
  EXPECT_EQ(refusal([&] { write_file(file_, "x"); }), told);
  EXPECT_TRUE(fs::is_symlink(file_));
  EXPECT_EQ(test::read(victim), "precious");
  fs::remove(victim);
  EXPECT_EQ(refusal([&] { write_file(file_, "x"); }), told) << "to nothing";
}

TEST_F(AtomicFiles, DevicesAndFifosAreWrittenIntoAndStay) {
  write_file("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_EQ(refusal([&] { write_file(file_, "x"); }), file_.string() + ": cannot be written: no process reads this FIFO");
  const int reader = ::open(file_.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  write_file(file_, "to a reader", Existing::refused);
  std::string got(64, ' ');
  got.resize(static_cast<std::size_t>(::read(reader, got.data(), got.size())));
  ::close(reader);
  EXPECT_EQ(got, "to a reader");
  EXPECT_TRUE(fs::is_fifo(file_));
}

/// A file that is already open, such as the target of /dev/stdout, is written in place.
TEST_F(AtomicFiles, WhatIsOpenIsWrittenInto) {
  const int open = ::open(file_.c_str(), O_RDWR | O_CREAT, 0600);
  struct stat before {};
  ::fstat(open, &before);
  const fs::path link = folder_ / "stdout";
  fs::create_symlink("/proc/self/fd/" + std::to_string(open), link);
  write_file(link, "through");
  struct stat after {};
  ::stat(file_.c_str(), &after);
  ::close(open);
  EXPECT_EQ(before.st_ino, after.st_ino);
  EXPECT_EQ(text(), "through");
  EXPECT_TRUE(fs::is_symlink(link));
}

TEST_F(AtomicFiles, TheLongestNameIsWritten) {
  const fs::path longest = folder_ / std::string(255, 'n');
  write_file(longest, "x");
  EXPECT_EQ(test::read(longest), "x");
}

TEST_F(AtomicFiles, OnlyRegularFilesAreReadAndOnlySoMuch) {
  std::ofstream(file_) << "12345";
  EXPECT_EQ(read_file(file_, 5), "12345");
  EXPECT_EQ(read_start(file_, 3), "123");
  EXPECT_EQ(size_of(file_), 5U);
  EXPECT_EQ(refusal([&] { (void)read_file(file_, 4); }),
            file_.string() + ": error: cannot be read: it has 5 bytes; expected at most 4");
  EXPECT_EQ(refusal([&] { (void)read_file("/dev/zero", 4); }), "/dev/zero: error: cannot be read: not a regular file");
  EXPECT_EQ(refusal([&] { (void)read_file(folder_, 4); }), folder_.string() + ": error: cannot be read: Is a directory");
  const fs::path fifo = folder_ / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(refusal([&] { (void)read_file(fifo, 4); }), fifo.string() + ": error: cannot be read: not a regular file");
}

/// A refused write closes its files, so that many refusals (as in `test` of many goldens) do not exhaust the file descriptors.
TEST_F(AtomicFiles, WhatIsRefusedIsClosed) {
  const auto open_files = [] { return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()); };
  const auto before = open_files();
  EXPECT_NE(refusal([&] { (void)read_file("/dev/zero", 4); }), test::kNoError);
  EXPECT_NE(refusal([&] { (void)read_file(folder_, 4); }), test::kNoError);
  EXPECT_NE(refusal([&] { (void)read_file(folder_ / "absent", 4); }), test::kNoError);
  std::ofstream(file_) << "12345";
  EXPECT_NE(refusal([&] { (void)read_file(file_, 4); }), test::kNoError);
  EXPECT_NE(refusal([&] { AtomicFile(file_, Existing::refused); }), test::kNoError);
  {
    FolderLock first;
    FolderLock second;
    EXPECT_TRUE(first.take(folder_));
    EXPECT_FALSE(second.take(folder_));
    EXPECT_FALSE(second.take(folder_));
  }
  EXPECT_EQ(open_files(), before);
}

TEST_F(AtomicFiles, FullDiskLeavesTheOldFileAndNoPart) {
  write_file(file_, "old");
  std::string message = "none";
  {
    const FullDisk full(10000);
    try {
      write_file(file_, std::string(20000, 'x'));
    } catch (const RunError& error) {
      message = error.what();
    }
  }
  EXPECT_EQ(message, file_.string() + ": cannot be written: File too large");
  EXPECT_EQ(text(), "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFiles, FullDeviceIsNamedToo) {
  fs::create_symlink("/dev/full", file_);
  EXPECT_EQ(refusal([&] { write_file(file_, "x"); }), file_.string() + ": cannot be written: No space left on device");
  EXPECT_TRUE(fs::is_symlink(file_));
}

TEST_F(AtomicFiles, NamesPathAndReason) {
  try {
    write_file(folder_ / "absent" / "f", "x");
    FAIL();
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()), (folder_ / "absent/f").string() + ": cannot be written: No such file or directory");
  }
  fs::create_directory(file_);  // a folder at the path of the file makes the rename fail
  EXPECT_THROW(write_file(file_, "x"), RunError);
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFiles, WorksInTheWorkingFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  write_file("trace.csv", "here");
  fs::current_path(before);
  EXPECT_EQ(text(), "here");
}

}  // namespace
}  // namespace gaitlab
