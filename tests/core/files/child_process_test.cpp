#include "core/files/child_process.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "core/files/folder_lock.h"
#include "tests/folder.h"

namespace gaitlab {
namespace {

TEST(ChildProcess, EndsWithTheCodeOfItsWork) {
  int status = 0;
  ASSERT_GT(::waitpid(begin_child([] { return 7; }), &status, 0), 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

// A child process ends if its parent is killed, and does not hold the parent's lock. (A killed study once could not be
// continued before its child process had ended, because the child held the lock.)
TEST(ChildProcess, NeitherOutlivesAKilledParentNorHoldsItsLock) {
  // The pipe is the standard output of both processes, so that its end is reached when both have ended.
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  const test::Folder folder;

  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    FolderLock lock;
    if (!lock.take(folder.path()) || ::dup2(pipe[1], STDOUT_FILENO) < 0) ::_exit(1);
    ::close(pipe[1]);
    (void)begin_child([&] {
      const pid_t self = ::getpid();
      if (::write(STDOUT_FILENO, &self, sizeof self) < 0) return 1;
      for (;;) ::pause();
      return 0;
    });
    for (;;) ::pause();
  }
  ::close(pipe[1]);
  pid_t grandchild = 0;
  ASSERT_EQ(::read(pipe[0], &grandchild, sizeof grandchild), static_cast<ssize_t>(sizeof grandchild));
  EXPECT_FALSE(FolderLock().take(folder.path()));

  ::kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(FolderLock().take(folder.path()));
  pollfd end{.fd = pipe[0], .events = POLLIN, .revents = 0};
  constexpr int kTenMinutes = 600'000;  // ms; time limit for a process that does not end
  if (::poll(&end, 1, kTenMinutes) != 1) {
    ADD_FAILURE() << "it outlives its parent";
    ::kill(grandchild, SIGKILL);
  }
  ::close(pipe[0]);
}

}  // namespace
}  // namespace gaitlab
