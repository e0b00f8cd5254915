// Cost in CPU time of this process. Its growth with the size of an input is the same on every machine, under the sanitizers and
// under load.
#pragma once
#include <ctime>

namespace gaitlab::test {

/// Seconds.
inline double cpu_time() {
  std::timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds that a call takes, of so many calls that they take at least 0.012 s: a kernel may count in ticks of 4 ms, so that
/// this is right to a third.
template <typename Call>
double cost_of(const Call& call) {
  constexpr double kEnough = 0.012;
  for (int calls = 1;; calls *= 2) {
    const double start = cpu_time();
    for (int k = 0; k < calls; ++k) call();
    const double took = cpu_time() - start;
    if (took >= kEnough) return took / calls;
  }
}

}  // namespace gaitlab::test
