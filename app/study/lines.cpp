#include "app/study/lines.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/errors.h"

namespace gaitlab::app {

bool is_blank(const std::string& line) { return line.find_first_not_of(" \t\r") == std::string::npos; }

/// With `stop`, waits for the line. Without `stop`, the line must have arrived.
std::optional<std::string> Lines::next(const std::atomic<bool>* stop) {
  std::size_t end = text_.find('\n', at_);
  while (end == std::string::npos && text_.size() - at_ <= kLongest && read_more(stop)) end = text_.find('\n', at_);
  if (stop != nullptr && *stop) return {};
  const std::size_t size = std::min(end, text_.size()) - at_;
  if (end == std::string::npos && size <= kLongest && (size == 0 || !ended_)) return {};  // the line is not complete
  return take(size);
}

/// The next `size` bytes as a line.
std::string Lines::take(std::size_t size) {
  ++number_;
  if (size > kLongest) {
    throw InputError(SourceLocation{"stdin", number_, 1},
                     fmt::format("the line is longer than {} bytes; expected a shorter line", kLongest));
  }
  std::string line = text_.substr(at_, size);
  at_ = std::min(at_ + size + 1, text_.size());
  blank_ = is_blank(line) ? blank_ + size + 1 : 0;
  if (blank_ > kLongest) {
    throw InputError(SourceLocation{"stdin", number_, 1},
                     fmt::format("the line follows {} bytes of blank lines; expected the end of the input", kLongest));
  }
  return line;
}

/// Waits for input or for its end. Returns false if `stop` is set, or the output is closed.
bool Lines::wait(const std::atomic<bool>& stop) {
  constexpr int kOften = 100;  // ms between checks of `stop`, which a signal may set just before the call
  std::array<pollfd, 2> ends{pollfd{STDIN_FILENO, POLLIN, 0}, pollfd{STDOUT_FILENO, 0, 0}};
  while (!stop) {
    if (::poll(ends.data(), until_ == Until::output_is_closed ? 2 : 1, kOften) <= 0) continue;
    if (ends[0].revents != 0) return true;  // results that have arrived count, even if nothing reads further questions
    output_closed_ = true;
    return false;
  }
  return false;
}

/// Reads more input. With `stop`, waits for the input; without `stop`, the input must have arrived. Returns false if there is
/// none.
bool Lines::read_more(const std::atomic<bool>* stop) {
  text_.erase(0, std::exchange(at_, 0));
  while (!ended_) {
    if (pollfd input{STDIN_FILENO, POLLIN, 0}; stop != nullptr ? !wait(*stop) : ::poll(&input, 1, 0) <= 0) return false;
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
