// Reader of lines of standard input as they arrive, which a flag can stop.
#pragma once
#include <atomic>
#include <optional>
#include <string>

namespace gaitlab::app {

class Lines {
 public:
  static constexpr std::size_t kLongest = 1 << 20;  ///< bytes of a line, and of blank lines in a row
  /// Ends of the wait for a line besides `stop`.
  enum class Until { input_ends, output_is_closed };
  explicit Lines(Until until = Until::input_ends) : until_(until) {}

  /// Returns the next line without its line end, or nothing at the end of the input or if `stop` is set. With `Until
  /// output_is_closed` it returns nothing, too, if no input has arrived and the reader of standard output has closed it. Throws
  /// InputError if the line is too long, follows too many blank lines, or cannot be read.
  std::optional<std::string> next(const std::atomic<bool>& stop) { return next(&stop); }
  /// Returns the next line if all of it has arrived.
  std::optional<std::string> arrived() { return next(nullptr); }
  /// True if the input has ended and all of its lines were returned.
  [[nodiscard]] bool ended() const { return ended_ && at_ == text_.size(); }
  /// True if a wait has ended because the reader of standard output had closed it.
  [[nodiscard]] bool output_closed() const { return output_closed_; }
  /// Number of the line that was returned last, from 1.
  [[nodiscard]] int number() const { return number_; }

 private:
  std::optional<std::string> next(const std::atomic<bool>* stop);
  bool wait(const std::atomic<bool>& stop);
  bool read_more(const std::atomic<bool>* stop);
  std::string take(std::size_t size);

  Until until_;
  std::string text_;  ///< input read so far, at most one line and one read; lines before at_ were returned
  std::size_t at_ = 0;
  std::size_t blank_ = 0;  ///< bytes of blank lines since the last line that is not blank
  bool ended_ = false, output_closed_ = false;
  int number_ = 0;
};

/// True if a line contains only blanks.
bool is_blank(const std::string& line);

}  // namespace gaitlab::app
