#include "core/files/child_process.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <new>
#include <string>

#include "core/files/folder_lock.h"
#include "tests/folder.h"

namespace gaitlab {
namespace {

// 'Z', an ended process that nobody has asked for yet, or 0, none: a process that has ended, whoever its parent is now.
bool has_ended(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t name = text.rfind(')');
  return name == std::string::npos || text.at(name + 2) == 'Z';
}

TEST(ChildProcess, EndsWithTheCodeOfItsWork) {
  int status = 0;
  ASSERT_GT(::waitpid(begin_child([] { return 7; }), &status, 0), 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

// A study that was killed while such a process of its own ran could not go on before that had ended: its lock lived there.
TEST(ChildProcess, NeitherOutlivesAKilledParentNorHoldsItsLock) {
  struct Shared {
    std::atomic<pid_t> grandchild = 0;
  };
  void* memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  auto* shared = new (memory) Shared;
  const test::Folder folder;

  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    FolderLock lock;
    if (!lock.take(folder.path())) ::_exit(1);
    (void)begin_child([&] {
      shared->grandchild = ::getpid();
      for (;;) ::pause();
      return 0;
    });
    for (;;) ::pause();
  }
  for (int k = 0; k < 10000 && shared->grandchild == 0; ++k) ::usleep(1000);
  ASSERT_NE(shared->grandchild, 0);
  EXPECT_FALSE(FolderLock().take(folder.path()));

  ::kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(FolderLock().take(folder.path()));
  for (int k = 0; k < 10000 && !has_ended(shared->grandchild); ++k) ::usleep(1000);
  EXPECT_TRUE(has_ended(shared->grandchild));
  if (!has_ended(shared->grandchild)) ::kill(shared->grandchild, SIGKILL);
  ::munmap(memory, sizeof(Shared));
}

}  // namespace
}  // namespace gaitlab
