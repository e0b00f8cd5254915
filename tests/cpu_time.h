// CPU time of this process. The growth of the CPU time with the size of an input does not depend on the machine, on its load or
// on sanitizers.
#pragma once
#include <ctime>

namespace gaitlab::test {

/// CPU time that this process has used, s.
inline double cpu_time() {
  std::timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU time of one call, s. The call is repeated until the calls take at least 0.012 s. A kernel may count in ticks of 4 ms, so
/// that the error of the result is at most a third.
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
