#include "core/recording/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/errors.h"
#include "tests/folder.h"

namespace gaitlab {
namespace {

namespace fs = std::filesystem;

class AtomicFiles : public testing::Test {
 protected:
  [[nodiscard]] std::string text() const { return test::read(file_); }

  const test::Folder own_;
  const fs::path folder_ = own_.path();
  const fs::path file_ = folder_ / "trace.csv", part_ = folder_ / "trace.csv.part";
};

// The disk is full after `bytes`: the kernel refuses to grow a file beyond it, with an error as for ENOSPC.
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

TEST_F(AtomicFiles, AppearsAtCommit) {
  AtomicFile file(file_);
  file.write("one ");
  file.write("two");
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_TRUE(fs::exists(part_));
  file.commit();
  EXPECT_FALSE(fs::exists(part_));
  EXPECT_EQ(text(), "one two");
}

TEST_F(AtomicFiles, LeavesNothingWithoutCommit) {
  { AtomicFile(file_).write("half"); }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(AtomicFiles, ReplacesTheOldFileAndAStalePart) {
  std::ofstream(file_) << "old";
  std::ofstream(part_) << "left by a killed run, longer than the new text";
  write_file(file_, "new");
  EXPECT_EQ(text(), "new");
  EXPECT_FALSE(fs::exists(part_));
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
  EXPECT_FALSE(fs::exists(part_));
}

TEST_F(AtomicFiles, FullDeviceIsNamedToo) {
  // /dev/full answers ENOSPC; its .part is a link to it.
  fs::create_symlink("/dev/full", part_);
  try {
    write_file(file_, "x");
    FAIL();
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()), file_.string() + ": cannot be written: No space left on device");
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(AtomicFiles, NamesPathAndReason) {
  try {
    write_file(folder_ / "absent" / "f", "x");
    FAIL();
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()), (folder_ / "absent/f").string() + ": cannot be written: No such file or directory");
  }
  fs::create_directory(file_);  // a folder where the file should go: the rename fails
  EXPECT_THROW(write_file(file_, "x"), RunError);
  EXPECT_FALSE(fs::exists(part_));
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
