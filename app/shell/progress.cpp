#include "app/shell/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "core/errors.h"

namespace gaitlab::app {

namespace {

constexpr std::chrono::milliseconds kOften{100};  // between updates, on a terminal
constexpr std::chrono::seconds kFirst{10};        // before the first line, elsewhere
constexpr std::chrono::seconds kSeldom{30};       // between further lines

}  // namespace

std::size_t terminal_columns(int descriptor, std::size_t otherwise) {
  constexpr std::size_t kLeast = 40, kMost = 200;
  winsize size{};
  if (isatty(descriptor) == 0 || ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return otherwise;
  return std::clamp<std::size_t>(size.ws_col, kLeast, kMost);
}

std::string progress_line(double share, const std::string& text, std::size_t columns) {
  constexpr std::size_t kLeastBar = 8, kMostBar = 40, kFrame = 3;  // brackets and a blank
  const std::size_t room = columns - 1;                            // one column less, because a terminal wraps a full line
  if (text.size() + kFrame + kLeastBar > room) return text.substr(0, room);
  const std::size_t bar = std::min(kMostBar, room - kFrame - text.size());
  const auto filled = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(bar));
  return fmt::format("[{:<{}}] {}", std::string(filled, '#'), bar, text);
}

ProgressLine::ProgressLine(bool quiet)
    : shown_(!quiet), terminal_(isatty(STDERR_FILENO) != 0), next_(Clock::now() + (terminal_ ? Clock::duration{} : kFirst)) {}

ProgressLine::~ProgressLine() { clear(); }

bool ProgressLine::due() {
  const Clock::time_point now = Clock::now();
  if (!shown_ || now < next_) return false;
  next_ = now + (terminal_ ? Clock::duration(kOften) : Clock::duration(kSeldom));
  return true;
}

void ProgressLine::show(double share, const std::string& text) {
  if (!terminal_) return say(text + "\n");
  const std::string line = progress_line(share, text, terminal_columns(STDERR_FILENO));
  fmt::print(stderr, "\r{:<{}}", line, written_);
  (void)std::fflush(stderr);
  written_ = line.size();
}

void ProgressLine::clear() {
  if (written_ == 0) return;
  fmt::print(stderr, "\r{:{}}\r", "", written_);
  (void)std::fflush(stderr);
  written_ = 0;
}

std::string TimeLeft::text(Time now, double done, double left) const {
  constexpr double kLeast = 0.01;
  if (!(done > kLeast * (done + left))) return "";
  return fmt::format("{:.0f} s left", std::chrono::duration<double>(now - start_).count() * left / done);
}

void Progress::operator()(double share) {
  if (!line_.due()) return;
  const std::string left = left_.text(std::chrono::steady_clock::now(), share, 1 - share);
  line_.show(share, fmt::format("{:.0f} % done{}{}", 100 * share, left.empty() ? "" : ", ", left));
}

}  // namespace gaitlab::app
