// Execution of independent pieces of work in several threads.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "core/errors.h"

namespace gaitlab {

/// Prints, once per process, that fewer threads run than requested. The results are the same.
inline void say_no_room(std::size_t started, std::size_t wanted, const std::error_code& why) {
  static std::atomic<bool> said = false;
  if (said.exchange(true)) return;
  say("gaitlab", "warning",
      "thread " + std::to_string(started + 1) + " of " + std::to_string(wanted) + " cannot be started (" + why.message() +
          "); the work continues with " + std::to_string(started) +
          "; take fewer threads with -j, or raise the limits of memory or processes (ulimit -v, ulimit -u, a container's)");
}

/// Calls work(i) once for every i < count, with up to `jobs` calls at a time. Each call must write to separate data, so that
/// the result does not depend on `jobs`. If the system refuses threads, fewer are used. If calls throw, the exception with the
/// least i is thrown after all calls have returned.
template <class Work>
void parallel(std::size_t count, int jobs, Work&& work) {
  std::vector<std::exception_ptr> errors(count);
  std::atomic<std::size_t> next = 0;
  const auto loop = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> others;  // joined at the end of the block
    const std::size_t wanted = std::min(count, static_cast<std::size_t>(std::max(1, jobs)));
    try {
      for (std::size_t i = 1; i < wanted; ++i) others.emplace_back(loop);
    } catch (const std::system_error& error) {
      say_no_room(others.size() + 1, wanted, error.code());
    }
    loop();
  }
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace gaitlab
