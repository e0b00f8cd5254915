// Reader of lines of standard input as they arrive, until a flag is set.
#pragma once
#include <atomic>
#include <optional>
#include <string>

namespace gaitlab::app {

class Lines {
 public:
  static constexpr std::size_t kLongest = 1 << 20;  ///< bytes of a line
  /// The next line without its end; nothing: there is none, or `stop` was set. Throws InputError if it is too long, or cannot
  /// be read.
  std::optional<std::string> next(const std::atomic<bool>& stop);
  /// Whether the input has ended and all of its lines were returned.
  [[nodiscard]] bool ended() const { return ended_ && at_ == text_.size(); }
  /// Number of the line that was returned last, from 1.
  [[nodiscard]] int number() const { return number_; }

 private:
  bool read_more(const std::atomic<bool>& stop);

  std::string text_;  ///< input read so far; lines before at_ were returned
  std::size_t at_ = 0;
  bool ended_ = false;
  int number_ = 0;
};

}  // namespace gaitlab::app
