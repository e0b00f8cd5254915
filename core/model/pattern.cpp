#include "core/model/pattern.h"

namespace gaitlab {

bool is_pattern(const std::string& text) { return text.find_first_of("*?") != std::string::npos; }

bool glob(const std::string& pattern, const std::string& text) {
  constexpr std::size_t kNone = std::string::npos;
  std::size_t p = 0;
  std::size_t t = 0;
  std::size_t star = kNone;  // index of the last `*`, and end of the text that this `*` matches so far
  std::size_t swallowed = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      swallowed = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
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
