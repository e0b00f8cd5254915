#include "core/model/pattern.h"

#include <charconv>
#include <cstdint>
#include <string_view>

namespace gaitlab {

namespace {

/// Length and value of the whole number at the beginning of a text. The length is 0 if there is no number, or if the number is
/// too large.
struct Whole {
  std::size_t length = 0;
  std::uint64_t value = 0;
};
Whole whole_number(std::string_view text) {
  Whole number;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number.value);
  if (read.ec == std::errc()) number.length = static_cast<std::size_t>(read.ptr - text.data());
  return number;
}

/// The range at the beginning of a pattern; its length is 0 if there is none.
struct NumberRange {
  std::size_t length = 0;
  std::uint64_t from = 0, to = 0;
};
NumberRange number_range_of(std::string_view pattern) {
  if (pattern.empty() || pattern[0] != '[') return {};
  const Whole from = whole_number(pattern.substr(1));
  const std::size_t dash = 1 + from.length;
  if (from.length == 0 || dash >= pattern.size() || pattern[dash] != '-') return {};
  const Whole to = whole_number(pattern.substr(dash + 1));
  const std::size_t end = dash + 1 + to.length;
  if (to.length == 0 || end >= pattern.size() || pattern[end] != ']') return {};
  return {end + 1, from.value, to.value};
}

/// Number of characters of the text that match the first element of the pattern, or 0. That element must not be `*`. `element`
/// becomes its length.
std::size_t matched(std::string_view pattern, std::string_view text, std::size_t& element) {
  element = 1;
  if (pattern.empty() || text.empty()) return 0;
  if (const NumberRange range = number_range_of(pattern); range.length > 0) {
    element = range.length;
    const Whole number = whole_number(text);
    return number.value >= range.from && number.value <= range.to ? number.length : 0;
  }
  return pattern[0] == '?' || pattern[0] == text[0] ? 1 : 0;
}

}  // namespace

bool is_pattern(const std::string& text) {
  if (text.find_first_of("*?") != std::string::npos) return true;
  for (std::size_t at = text.find('['); at != std::string::npos; at = text.find('[', at + 1)) {
    if (number_range_of(std::string_view(text).substr(at)).length > 0) return true;
  }
  return false;
}

bool glob(const std::string& pattern, const std::string& text) {
  constexpr std::size_t kNone = std::string::npos;
  const std::string_view p_text(pattern);
  const std::string_view t_text(text);
  std::size_t p = 0;
  std::size_t t = 0;
  std::size_t star = kNone;  // index of the last `*`, and end of the text that this `*` matches so far
  std::size_t swallowed = 0;
  while (t < text.size()) {
    std::size_t element = 1;
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      swallowed = t;
    } else if (const std::size_t n = matched(p_text.substr(p), t_text.substr(t), element); n > 0) {
      p += element;
      t += n;
    } else if (star != kNone) {
      p = star + 1;
      t = ++swallowed;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace gaitlab
