// Errors with their locations, for bad input (exit code 2) and failed runs (exit code 1).
#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gaitlab {

/// A position in a text that the user wrote. Line and column are counted from 1; line 0 means the whole file.
struct SourceLocation {
  std::string file = {};
  int line = 0;
  int column = 0;
  bool operator==(const SourceLocation&) const = default;
};

/// Text `FILE:LINE:COL`, or `FILE` if the line is 0.
std::string to_string(const SourceLocation& place);

/// A problem of the input: its place, a text with the value found and the value expected, and notes with other places or a
/// remedy.
struct Problem {
  SourceLocation place;
  std::string text;
  std::vector<std::pair<SourceLocation, std::string>> notes = {};
  std::string unknown_key = {};  ///< the key, if the problem is an unknown key
};

/// Collection of problems, so that a user sees all of them at once.
class Problems {
 public:
  Problem& add(Problem problem) { return list_.emplace_back(std::move(problem)); }
  Problem& add(SourceLocation place, std::string text) { return add(Problem{std::move(place), std::move(text)}); }
  /// Replaces a problem by another one.
  void replace(std::size_t number, Problem problem) { list_[number] = std::move(problem); }
  /// Orders the problems from number `first` on by their places in the file.
  void order(std::size_t first);
  [[nodiscard]] bool empty() const { return list_.empty(); }
  [[nodiscard]] std::size_t size() const { return list_.size(); }
  [[nodiscard]] const std::vector<Problem>& list() const { return list_; }
  /// Throws InputError with all problems so far. Has no effect if there are none.
  void raise() const;

 private:
  std::vector<Problem> list_;
};

/// A name on one line, with control characters escaped as in \x1b.
std::string one_line(const std::string& name);

/// Prints a text on stderr without allocating memory. Control characters (also NUL, but not newlines) are escaped as in \x1b,
/// because messages contain file names and texts from unknown sources. All messages of the program are printed by this
/// function. If stderr cannot be written, the message is lost.
void say(std::string_view text) noexcept;
/// Sets a receiver that gets the texts of say() instead of stderr; null restores stderr. For a library inside another program,
/// which owns stderr. The texts are passed unchanged and may have control characters.
void say_to(void (*receiver)(std::string_view text) noexcept) noexcept;
/// Prints `NAME: KIND: TEXT` on a line. KIND is error, warning or note.
void say(const std::string& name, const char* kind, const std::string& text);

/// Bad input, with exit code 2. what() is the whole text for stderr, with a line `FILE:LINE:COL: error: TEXT` for each of at
/// most 200 problems, and the number of further ones. A text has at most 500 bytes and no control characters.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  InputError(SourceLocation place, std::string text);
  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// A run that failed, for example because it diverged or the disk is full. The exit code is 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The known name most similar to `found`, by edit distance; else the only name that begins with `found`; else the longest name
/// that `found` begins with. Empty if there is no such name.
std::string nearest(const std::string& found, const std::vector<std::string>& known);

}  // namespace gaitlab
