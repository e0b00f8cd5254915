// Runs the tests once, or once with each of the mutants whose numbers are the arguments.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "mutants.h"
namespace {
/// Prints the first test that fails. With a mutant, this test also ends the process.
struct First : testing::EmptyTestEventListener {
  const char* mutant = "";
  bool told = false;
  std::string name;  // copy of the test's name, because current_test_info() would deadlock while a result is reported
  void OnTestStart(const testing::TestInfo& test) override { name = std::string(test.test_suite_name()) + "." + test.name(); }
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed() || told) return;
    std::fprintf(stderr, "%s red %s\n", mutant, name.c_str());
    told = true;
    if (*mutant != 0) _exit(1);
  }
};
}  // namespace
// Without arguments, runs the tests once. With numbers of mutants, first runs the tests without a mutant, which must pass and
// prepares the walks, and then each mutant in a separate process.
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
      const rlimit most{120, 120};  // limit of CPU time for endless loops, s
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
