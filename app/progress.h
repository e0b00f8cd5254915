// A bar on a terminal, nothing elsewhere.
#pragma once
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace gaitlab::app {

class Progress {
 public:
  explicit Progress(bool quiet) : shown_(!quiet && isatty(fileno(stderr)) != 0) {}
  ~Progress() {
    if (shown_) fmt::print(stderr, "\r{:60}\r", "");
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void operator()(double share) const {
    if (!shown_) return;
    const auto filled = static_cast<std::size_t>(40 * share);
    fmt::print(stderr, "\r[{:<40}] {:3.0f} %", std::string(filled, '#'), 100 * share);
    (void)std::fflush(stderr);
  }

 private:
  bool shown_;
};

}  // namespace gaitlab::app
