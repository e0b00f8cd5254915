#include "core/recording/run_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "core/errors.h"
#include "tests/folder.h"
#include "tests/messages.h"

namespace gaitlab {
namespace {

namespace fs = std::filesystem;

class RunFolders : public testing::Test {
 protected:
  void SetUp() override { fs::current_path(folder_); }
  void TearDown() override { fs::current_path(before_); }
  static std::string complaint(const std::optional<fs::path>& out, const std::string& name = "walk") {
    return test::message_of([&] { const RunFolder folder(out, name); });
  }

  const test::Folder own_;
  const fs::path folder_ = own_.path(), before_ = fs::current_path();
};

TEST_F(RunFolders, AreNumbered) {
  for (const std::string expected : {"runs/walk", "runs/walk-2", "runs/walk-3"}) {
    RunFolder folder({}, "walk");
    folder.keep();
    EXPECT_EQ(folder.path(), expected);
    EXPECT_TRUE(fs::is_directory(expected));
  }
}

TEST_F(RunFolders, StepOverAFileOfThatName) {
  fs::create_directory("runs");
  std::ofstream("runs/walk") << "mine";
  RunFolder folder({}, "walk");
  EXPECT_EQ(folder.path(), "runs/walk-2");
}

TEST_F(RunFolders, VanishWithAllTheyMadeUnlessKept) {
  { const RunFolder folder({}, "walk"); }
  { const RunFolder folder("a/b/c", "walk"); }
  EXPECT_TRUE(fs::is_empty("."));
  fs::create_directory("a");
  { const RunFolder folder("a/b/c", "walk"); }
  EXPECT_TRUE(fs::exists("a"));
  EXPECT_TRUE(fs::is_empty("a"));
}

TEST_F(RunFolders, StayIfSomethingWasWritten) {
  {
    const RunFolder folder("a/b", "walk");
    std::ofstream(folder.path() / "trace.csv") << "t\n";
  }
  EXPECT_TRUE(fs::exists("a/b/trace.csv"));
}

TEST_F(RunFolders, AnEmptyFolderOfTheUserIsUsedAndStays) {
  fs::create_directory("mine");
  { const RunFolder folder("mine", "walk"); }
  EXPECT_TRUE(fs::is_directory("mine"));
}

TEST_F(RunFolders, OutMayEndInASlashOrBeAbsolute) {
  RunFolder relative("x/y/", "walk");
  EXPECT_EQ(relative.path(), "x/y");
  EXPECT_TRUE(fs::is_directory("x/y"));
  const RunFolder absolute(folder_ / "z", "walk");
  EXPECT_TRUE(fs::is_directory(folder_ / "z"));
  fs::create_directory("here");
  fs::current_path("here");
  { const RunFolder dot(".", "walk"); }
  fs::current_path("..");
  EXPECT_TRUE(fs::is_directory("here"));
}

TEST_F(RunFolders, AFullFolderIsRefusedAndUntouched) {
  fs::create_directory("full");
  std::ofstream("full/notes.txt") << "mine";
  EXPECT_EQ(complaint("full"), "--out full: error: exists and is not empty");
  EXPECT_TRUE(fs::exists("full/notes.txt"));
  EXPECT_EQ(std::distance(fs::directory_iterator("full"), {}), 1);
}

/// A run that was killed leaves such files, which `ls` does not show; the same command can be given again.
TEST_F(RunFolders, PartFilesAreNoContent) {
  const std::string part = ".trace.h5.a9c7b9f8ca80226b.part";
  fs::create_directory("killed");
  std::ofstream("killed/" + part) << "half";
  EXPECT_EQ(complaint("killed"), test::kNoError);
  EXPECT_TRUE(fs::exists("killed/" + part));  // on a file system without locks another process could be writing it
  std::ofstream("killed/trace.h5") << "whole";
  EXPECT_EQ(complaint("killed"), "--out killed: error: exists and is not empty");
  for (const std::string name : {"mine.part", ".mine.part", ".mine.a9c7b9f8ca80226.part", ".mine.A9C7B9F8CA80226B.part",
                                 "..a9c7b9f8ca80226b.part", ".mine.a9c7b9f8ca80226b.part2"}) {
    fs::create_directory("other");
    std::ofstream("other/" + name) << "mine";
    EXPECT_EQ(complaint("other"), "--out other: error: exists and is not empty") << name;
    fs::remove_all("other");
  }
  fs::create_directories("folder/" + part);
  EXPECT_EQ(complaint("folder"), "--out folder: error: exists and is not empty");
  fs::create_directory("link");
  fs::create_symlink("../killed/trace.h5", "link/" + part);
  EXPECT_EQ(complaint("link"), "--out link: error: exists and is not empty");
}

TEST_F(RunFolders, AFileIsRefused) {
  std::ofstream("file") << "mine";
  EXPECT_EQ(complaint("file"), "--out file: error: exists and is not a folder");
  EXPECT_EQ(complaint("file/run"), "--out file/run: error: cannot be made: Not a directory");
  EXPECT_EQ(complaint(""), "--out : error: is not a folder");
}

TEST_F(RunFolders, LinksToNowhereAreRefused) {
  fs::create_symlink("nowhere", "link");
  EXPECT_EQ(complaint("link"), "--out link: error: exists and is not a folder");
  fs::create_symlink("nowhere", "runs");
  EXPECT_EQ(complaint({}), "runs/walk: error: cannot be made: No such file or directory");
}

TEST_F(RunFolders, NoRightToWriteNamesPathAndReason) {
  fs::create_directory("locked");
  fs::create_directory("runs");
  constexpr auto kReadOnly = static_cast<fs::perms>(0555);
  fs::permissions("locked", kReadOnly);
  fs::permissions("runs", kReadOnly);
  fs::permissions(".", static_cast<fs::perms>(0755));
  const uid_t user = geteuid();
  if (user == 0) {
    ASSERT_EQ(seteuid(65534), 0);  // because root may write into any folder
  }
  const std::string used = complaint("locked");
  const std::string made = complaint("locked/new/run");
  const std::string numbered = complaint({});
  if (user == 0) {
    ASSERT_EQ(seteuid(0), 0);
  }
  EXPECT_EQ(used, "--out locked: error: cannot be written: Permission denied");
  EXPECT_EQ(made, "--out locked/new/run: error: cannot be made: Permission denied");
  EXPECT_EQ(numbered, "runs/walk: error: cannot be made: Permission denied");
  EXPECT_TRUE(fs::is_empty("locked"));
}

TEST_F(RunFolders, ANameThatIsNoFolderNameIsRefused) {
  for (const std::string name : {"", ".", "..", "a/b"})
    EXPECT_EQ(complaint({}, name), "name: error: \"" + name + "\" cannot name a run folder");
  EXPECT_TRUE(fs::is_empty("."));
}

TEST_F(RunFolders, ProcessesAtOnceGetDifferentOnes) {
  constexpr int kProcesses = 8;
  constexpr int kEach = 20;
  std::vector<pid_t> children;
  for (int k = 0; k < kProcesses; ++k) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      int made = 0;
      for (int run = 0; run < kEach; ++run) {
        RunFolder folder({}, "walk");
        if (fs::is_empty(folder.path())) ++made;
        std::ofstream(folder.path() / "mine") << run;
        folder.keep();
        { const RunFolder vanishing({}, "other"); }
      }
      _exit(made == kEach ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator("runs"), {}), kProcesses * kEach);
}

}  // namespace
}  // namespace gaitlab
