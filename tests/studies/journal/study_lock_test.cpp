// The lock of a study: what counts as one, who holds it, and files that stay as they are.
#include "studies/journal/study_lock.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/folder.h"
#include "tests/messages.h"

namespace gaitlab::studies {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoLock =
    ": error: is not the lock of a study; expected a regular file without other links, empty or with the line 'process N on "
    "HOST'. Move it away, or take another folder (--out)";

class StudyLocks : public testing::Test {
 protected:
  /// Expects that the lock is refused, and that the file is unchanged.
  void expect_refused(const std::string& name) {
    const std::string file = folder_ / name;
    const std::string before = test::read(file);
    EXPECT_EQ(test::message_of([&] { const Lock lock(file); }), file + kNoLock);
    EXPECT_EQ(test::read(file), before);
    EXPECT_FALSE(is_lock(file));
  }

  const test::Folder folder_;
  const std::string file_ = folder_ / "lock";
};

TEST_F(StudyLocks, NameTheirHolderForAsLongAsTheyAreHeld) {
  const std::string own = "process " + std::to_string(::getpid()) + " on " + host();
  {
    const Lock lock(file_);
    EXPECT_EQ(test::read(file_), own + "\n");
    EXPECT_EQ(Lock::holder(file_), own);
    EXPECT_TRUE(is_lock(file_));
  }
  EXPECT_EQ(test::read(file_), "") << "empty, and still there";
  EXPECT_EQ(Lock::holder(file_), "");
  EXPECT_TRUE(is_lock(file_));
}

TEST_F(StudyLocks, AreTakenAgain) {
  for (int k = 0; k < 3; ++k) EXPECT_EQ(test::message_of([&] { const Lock lock(file_); }), test::kNoError) << k;
}

/// A killed process leaves its line; its lock ended with it.
TEST_F(StudyLocks, OfAKilledProcessAreFree) {
  folder_.write("lock", "process 4194999 on " + std::string(400 - 20, 'h') + "\n");
  expect_refused("lock");  // no host has such a long name
  folder_.write("lock", "process 4194999 on another-host\n");
  EXPECT_TRUE(is_lock(file_));
  EXPECT_EQ(Lock::holder(file_), "") << "nobody holds it";
  const Lock lock(file_);
  EXPECT_EQ(test::read(file_), "process " + std::to_string(::getpid()) + " on " + host() + "\n")
      << "and nothing of the old line";
}

TEST_F(StudyLocks, AreNoFilesOfAUser) {
  for (const char* text : {"notes\n", "process 12 on host", "process 12 on host\nand more\n", "process  on host\n",
                           "process 12\n", "Process 12 on host\n", "process 1x on host\n", "\n", "process 12 on host\n\n"}) {
    folder_.write("lock", text);
    expect_refused("lock");
  }
}

TEST_F(StudyLocks, AreNoLinksAndNothingButFiles) {
  folder_.write("target", "");
  fs::create_symlink("target", folder_ / "symbolic");
  expect_refused("symbolic");
  fs::create_symlink("nowhere", folder_ / "dangling");
  expect_refused("dangling");
  EXPECT_FALSE(fs::exists(folder_ / "nowhere")) << "nothing is made through a link";
  fs::create_hard_link(folder_ / "target", folder_ / "hard");
  expect_refused("hard");
  ASSERT_EQ(::mkfifo((folder_ / "fifo").c_str(), 0600), 0);
  EXPECT_EQ(test::message_of([&] { const Lock lock(folder_ / "fifo"); }), (folder_ / "fifo") + kNoLock) << "without waiting";
  EXPECT_FALSE(is_lock(folder_ / "fifo"));
  EXPECT_EQ(Lock::holder(folder_ / "fifo"), "");
}

TEST_F(StudyLocks, ThatCannotBeMadeSayWhy) {
  const std::string absent = folder_ / "no/lock";
  EXPECT_EQ(test::message_of([&] { const Lock lock(absent); }),
            absent + ": error: cannot be opened: No such file or directory");
  EXPECT_FALSE(is_lock(absent));
  EXPECT_EQ(Lock::holder(absent), "");
  fs::create_directory(folder_ / "folder");
  EXPECT_EQ(test::message_of([&] { const Lock lock(folder_ / "folder"); }),
            (folder_ / "folder") + ": error: cannot be opened: Is a directory");
}

}  // namespace
}  // namespace gaitlab::studies
