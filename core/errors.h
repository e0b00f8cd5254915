// Errors, each with its location: bad input (exit code 2) and a failed run (exit code 1).
#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gaitlab {

/// A position in a text that the user wrote; line and column count from 1, 0 means "the whole file".
struct SourceLocation {
  std::string file = {};
  int line = 0;
  int column = 0;
  bool operator==(const SourceLocation&) const = default;
};

/// `FILE:LINE:COL`, or `FILE` alone without a line.
std::string to_string(const SourceLocation& place);

/// One finding: its place, the value found and the value expected, and notes with other places or a remedy.
struct Problem {
  SourceLocation place;
  std::string text;
  std::vector<std::pair<SourceLocation, std::string>> notes = {};
};

/// Collects findings, so that a user sees all of them at once.
class Problems {
 public:
  Problem& add(SourceLocation place, std::string text) {
    return list_.emplace_back(Problem{std::move(place), std::move(text), {}});
  }
  [[nodiscard]] bool empty() const { return list_.empty(); }
  [[nodiscard]] std::size_t size() const { return list_.size(); }
  [[nodiscard]] const std::vector<Problem>& list() const { return list_; }
  /// Throws InputError with all findings so far; does nothing without findings.
  void raise() const;

 private:
  std::vector<Problem> list_;
};

/// A name in one line, its control characters as \x1b.
std::string one_line(const std::string& name);

/// Prints a text on stderr, by its length and without allocating. Control characters (also NUL, but not newlines) are printed
/// as \x1b, because messages contain names of files and texts from unknown sources. Every message of the program is printed
/// here. If stderr cannot be written, the message is lost.
void say(std::string_view text) noexcept;
/// `NAME: KIND: TEXT` on a line; KIND is error, warning or note.
void say(const std::string& name, const char* kind, const std::string& text);

/// Bad input: exit code 2. what() is the whole text for stderr, one `FILE:LINE:COL: error: TEXT` per finding: at most 200, each
/// of at most 500 bytes behind its place, and the number of further ones; without control characters.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  InputError(SourceLocation place, std::string text);
  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// A run that failed (diverged, disk full): exit code 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The known name nearest to `found` (edit distance, at most a third of its length), or the only one that begins with it, or
/// empty.
std::string nearest(const std::string& found, const std::vector<std::string>& known);

}  // namespace gaitlab
