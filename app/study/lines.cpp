#include "app/study/lines.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "core/errors.h"

namespace gaitlab::app {

std::optional<std::string> Lines::next(const std::atomic<bool>& stop) {
  std::size_t end = text_.find('\n', at_);
  while (end == std::string::npos && text_.size() - at_ <= kLongest && read_more(stop)) end = text_.find('\n', at_);
  if (stop || (end == std::string::npos && at_ == text_.size())) return {};
  ++number_;
  const std::size_t size = std::min(end, text_.size()) - at_;
  if (size > kLongest) {
    throw InputError(SourceLocation{"stdin", number_, 1},
                     fmt::format("is longer than {} bytes; expected a shorter one", kLongest));
  }
  std::string line = text_.substr(at_, size);
  at_ = std::min(at_ + size + 1, text_.size());
  return line;
}

void Lines::take() {
  const std::atomic<bool> never = false;
  for (pollfd input{STDIN_FILENO, POLLIN, 0}; !ended_ && ::poll(&input, 1, 0) > 0;) (void)read_more(never);
}

/// Waits for more input. Returns false if the input has ended or `stop` is set.
bool Lines::read_more(const std::atomic<bool>& stop) {
  constexpr int kOften = 100;  // ms between checks of `stop`, which a signal may set just before the call
  text_.erase(0, std::exchange(at_, 0));
  while (!ended_ && !stop) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, kOften) <= 0) continue;
    std::array<char, 1 << 16> bytes{};
    const ssize_t size = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (size < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (size < 0) throw InputError(SourceLocation{"stdin"}, "cannot be read: " + std::generic_category().message(errno));
    ended_ = size == 0;
    text_.append(bytes.data(), static_cast<std::size_t>(size));
    return !ended_;
  }
  return false;
}

}  // namespace gaitlab::app
