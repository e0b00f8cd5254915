// Independent pieces of work side by side in threads.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace gaitlab {

/// Calls work(i) for every i < count, up to `jobs` at once, each i once. Every piece writes only what is its own, so that the
/// result does not depend on `jobs`. All are done before the first exception, in the order of i, is thrown.
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
    for (std::size_t i = 1; i < std::min(count, static_cast<std::size_t>(std::max(1, jobs))); ++i) others.emplace_back(loop);
    loop();
  }
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace gaitlab
