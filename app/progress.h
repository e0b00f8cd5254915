// A progress bar with the remaining time on a terminal; it prints nothing to a file or a pipe.
#pragma once
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>

namespace gaitlab::app {

class Progress {
 public:
  explicit Progress(bool quiet) : shown_(!quiet && isatty(fileno(stderr)) != 0) {}
  ~Progress() {
    if (shown_) fmt::print(stderr, "\r{:70}\r", "");
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void operator()(double share) const {
    if (!shown_) return;
    const auto filled = static_cast<std::size_t>(40 * share);
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - start_;
    const std::string left = share > 0.01 ? fmt::format("{:.0f} s left", since.count() * (1 - share) / share) : "";
    fmt::print(stderr, "\r[{:<40}] {:3.0f} % {:<16}", std::string(filled, '#'), 100 * share, left);
    (void)std::fflush(stderr);
  }

 private:
  bool shown_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace gaitlab::app
