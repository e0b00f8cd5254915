// Runs the tests, once or with each of the mutants whose numbers it is given.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "mutants.h"
namespace {
/// Tells the first test that is red; that of a mutant ends its process.
struct First : testing::EmptyTestEventListener {
  const char* mutant = "";
  bool told = false;
  std::string name;  // kept here: while a result is told, GoogleTest holds the lock that current_test_info() takes
  void OnTestStart(const testing::TestInfo& test) override { name = std::string(test.test_suite_name()) + "." + test.name(); }
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed() || told) return;
    std::fprintf(stderr, "%s red %s\n", mutant, name.c_str());
    told = true;
    if (*mutant != 0) _exit(1);
  }
};
}  // namespace
// Without numbers: the tests, once. With numbers: each in a process of its own, behind a run that is green and has made the
// walks.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  auto* first = new First;
  testing::UnitTest::GetInstance()->listeners().Append(first);
  if (RUN_ALL_TESTS() != 0) return 1;
  for (int i = 1; i < argc; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      gaitlab::mutants::current() = std::atoi(argv[i]);
      first->mutant = argv[i];
      const rlimit most{120, 120};  // s of CPU: a loop that does not end
      setrlimit(RLIMIT_CPU, &most);
      if (std::freopen("/dev/null", "w", stdout) == nullptr) _exit(2);
      _exit(RUN_ALL_TESTS());
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) std::fprintf(stderr, "%s red signal %d\n", argv[i], WTERMSIG(status));
    if (status == 0) std::fprintf(stderr, "%s green\n", argv[i]);
  }
  return 0;
}
