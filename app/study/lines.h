// Reader of lines of standard input as they arrive, which a flag can stop.
#pragma once
#include <atomic>
#include <optional>
#include <string>

namespace gaitlab::app {

class Lines {
 public:
  static constexpr std::size_t kLongest = 1 << 20;  ///< bytes of a line
  /// Returns the next line without its line end, or nothing at the end of the input or if `stop` is set. Throws InputError if
  /// the line is too long or cannot be read.
  std::optional<std::string> next(const std::atomic<bool>& stop);
  /// Reads the input that has arrived, without waiting.
  void take();
  /// True if the input has ended and all of its lines were returned.
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
