// Progress on stderr: on a terminal one line that changes, as wide as the terminal; elsewhere a line after 10 s, then every 30
// s.
#pragma once
#include <chrono>
#include <cstddef>
#include <string>

namespace gaitlab::app {

/// Columns of the terminal behind a file descriptor, from 40 to 200; `otherwise` without a terminal, or if its size is unknown.
std::size_t terminal_columns(int descriptor, std::size_t otherwise = 80);

/// Line of less than `columns` columns: a bar with the share that is done, of at most 40 columns, and the text. If the text
/// leaves less than 8 columns for the bar, the line does not have a bar. A longer text is cut.
std::string progress_line(double share, const std::string& text, std::size_t columns);

/// Writer of progress lines. The destructor clears the line on a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  [[nodiscard]] bool terminal() const { return terminal_; }
  /// True if it is time for the next line, which the caller then shows.
  bool due();
  void show(double share, const std::string& text);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool shown_, terminal_;
  std::size_t written_ = 0;  ///< columns of the line on the terminal
  Clock::time_point next_;
};

/// Time left of work, at the mean pace of the work done so far.
class TimeLeft {
 public:
  using Time = std::chrono::steady_clock::time_point;
  explicit TimeLeft(Time start) : start_(start) {}
  /// Text such as `12 s left`. `done` and `left` may be in any unit. The text is empty before a hundredth of the work is done.
  [[nodiscard]] std::string text(Time now, double done, double left) const;

 private:
  Time start_;
};

/// Progress of a command by the share that is done, with the remaining time.
class Progress {
 public:
  explicit Progress(bool quiet) : line_(quiet) {}
  void operator()(double share);

 private:
  ProgressLine line_;
  TimeLeft left_{std::chrono::steady_clock::now()};
};

}  // namespace gaitlab::app
