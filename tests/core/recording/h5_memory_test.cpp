// Files of traces in processes with little memory: an error, and never a crash.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <map>
#include <new>

#include "tests/core/recording/damaged_trace.h"
#include "tests/labels.h"

namespace gaitlab {
namespace {

const test::Label kLongH5Memory("H5Memory.TooLittleForReadingIsAnError:H5Memory.TooLittleForWritingIsAnError", "long");

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define GAITLAB_SANITIZED
#endif
#endif
#ifdef GAITLAB_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

constexpr int kWorked = 0, kTooLittle = 1, kOther = 2;

/// Numbers of processes by their ends, an exit code or 128 + the signal. Each process does `act` with 0 to 30 MB more memory
/// than this process has.
std::map<int, int> ends_with_little_memory(const std::function<void()>& act) {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  std::map<int, int> ends;
  constexpr rlim_t kStep = 200'000;
  for (rlim_t more = 0; more < 30'000'000; more += kStep) {
    const pid_t child = ::fork();
    if (child == 0) {
      const rlimit limit{pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + more, RLIM_INFINITY};
      ::setrlimit(RLIMIT_AS, &limit);
      try {
        act();
      } catch (const NoImage&) {
        ::_exit(kTooLittle);
      } catch (const std::bad_alloc&) {
        ::_exit(kTooLittle);
      } catch (...) {
        ::_exit(kOther);
      }
      ::_exit(kWorked);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ++ends[WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status)];
  }
  return ends;
}

class H5Memory : public testing::Test {
 protected:
  void expect_orderly(const std::function<void()>& act) {
    if (kSanitized) GTEST_SKIP() << "a sanitizer, which ends the process where memory is short";
    std::map<int, int> ends = ends_with_little_memory(act);
    EXPECT_GT(ends[kWorked], 0);
    EXPECT_GT(ends[kTooLittle], 0);
    for (const auto& [end, count] : ends) EXPECT_TRUE(end == kWorked || end == kTooLittle) << count << " ended with " << end;
  }

  const test::Folder folder_;
  const std::string file_ = folder_ / "trace.h5";
  const Trace trace_ = test::noisy_table(2000, 100),
              ticks_ = test::noisy_table(300, 50);  // its file needs more than kFileShare
};

TEST_F(H5Memory, TooLittleForWritingIsAnError) {
  const std::vector<BesideOf> beside{{"ticks", &ticks_}};
  expect_orderly([&] { write_h5(trace_, {std::string(20000, 'x'), 1, "build", "done"}, file_, beside); });
}

TEST_F(H5Memory, TooLittleForReadingIsAnError) {
  const std::vector<BesideOf> beside{{"ticks", &ticks_}};
  write_h5(trace_, {std::string(20000, 'x'), 1, "build", "done"}, file_, beside);
  expect_orderly([&] { static_cast<void>(read_h5(file_)); });
}

}  // namespace
}  // namespace gaitlab
