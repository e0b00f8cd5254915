// Cost in CPU time of this process. Its growth with the size of an input is the same on every machine, under the sanitizers and
// under load.
#pragma once
#include <algorithm>
#include <ctime>

namespace gaitlab::test {

/// Seconds.
inline double cpu_time() {
  std::timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds that a call takes, the shortest of three: load makes a call longer, never shorter.
template <typename Call>
double cost_of(const Call& call) {
  double shortest = 1e9;
  for (int k = 0; k < 3; ++k) {
    const double start = cpu_time();
    call();
    shortest = std::min(shortest, cpu_time() - start);
  }
  return shortest;
}

}  // namespace gaitlab::test
