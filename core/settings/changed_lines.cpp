#include "core/settings/changed_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "core/settings/wording.h"

namespace gaitlab {

namespace {

constexpr std::size_t kMostPairs = 4'000'000;  // largest number of compared pairs of lines, with 2 bytes each

using Lines = std::vector<std::string_view>;

Lines lines_of(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Lengths of the longest common subsequences, for the remainders of two texts from each pair of lines on.
class CommonLines {
 public:
  CommonLines(const Lines& a, const Lines& b) : a_(a), b_(b), width_(b.size() + 1) {
    if (a.size() * b.size() > kMostPairs) return;
    length_.resize((a.size() + 1) * width_);
    for (std::size_t i = a.size(); i-- > 0;) {
      for (std::size_t j = b.size(); j-- > 0;) {
        const int both = at(i + 1, j + 1) + 1;
        length_[i * width_ + j] = static_cast<std::uint16_t>(a[i] == b[j] ? both : std::max(at(i + 1, j), at(i, j + 1)));
      }
    }
  }

  /// True if line i of the first text is kept as line j of the second.
  [[nodiscard]] bool kept(std::size_t i, std::size_t j) const {
    return !length_.empty() && i < a_.size() && j < b_.size() && a_[i] == b_[j];
  }
  /// True if some longest common subsequence of the remainders omits line i of the first text.
  [[nodiscard]] bool gone(std::size_t i, std::size_t j) const {
    if (i == a_.size() || j == b_.size()) return j == b_.size();
    return length_.empty() || at(i + 1, j) >= at(i, j + 1);
  }

 private:
  [[nodiscard]] int at(std::size_t i, std::size_t j) const { return length_[i * width_ + j]; }

  const Lines& a_;
  const Lines& b_;
  std::size_t width_;
  std::vector<std::uint16_t> length_;  // empty if there are too many lines to compare
};

/// Rest of a long line, without most of the beginning that both lines share.
std::string_view from_the_change(std::string_view line, std::string_view other) {
  constexpr std::size_t kShort = 60;
  constexpr std::size_t kBefore = 20;
  const auto same =
      static_cast<std::size_t>(std::mismatch(line.begin(), line.end(), other.begin(), other.end()).first - line.begin());
  return line.size() > kShort && same > kBefore ? line.substr(same - kBefore) : line;
}

/// Sentence such as `line 136: "Kp: 97", was "Kp: 100"`. Null means that the text lacks the line.
std::string sentence(std::size_t number, const std::string_view* now, const std::string_view* then) {
  const auto quoted = [](const std::string_view* line, const std::string_view* other) -> std::string {
    if (line == nullptr) return "nothing";
    const std::string_view shown = other == nullptr ? *line : from_the_change(*line, *other);
    return fmt::format("{}\"{}\"", shown.size() < line->size() ? "..." : "", clipped(std::string(shown)));
  };
  return fmt::format("line {}: {}, was {}", number, quoted(now, then), quoted(then, now));
}

}  // namespace

std::vector<std::string> changed_lines(const std::string& then, const std::string& now, std::size_t most) {
  Lines a = lines_of(then);
  Lines b = lines_of(now);
  const auto same = static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
  const auto same_end = std::mismatch(a.rbegin(), a.rend() - static_cast<std::ptrdiff_t>(same), b.rbegin(),
                                      b.rend() - static_cast<std::ptrdiff_t>(same))
                            .first -
                        a.rbegin();
  for (Lines* lines : {&a, &b}) {
    lines->erase(lines->end() - same_end, lines->end());
    lines->erase(lines->begin(), lines->begin() + static_cast<std::ptrdiff_t>(same));
  }
  const CommonLines common(a, b);
  std::vector<std::string> changed;
  std::size_t more = 0;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    if (common.kept(i, j)) {
      ++i, ++j;
      continue;
    }
    std::size_t end_i = i;
    std::size_t end_j = j;
    while ((end_i < a.size() || end_j < b.size()) && !common.kept(end_i, end_j)) ++(common.gone(end_i, end_j) ? end_i : end_j);
    for (; i < end_i || j < end_j; i = std::min(i + 1, end_i), j = std::min(j + 1, end_j)) {
      if (i < end_i && j < end_j && a[i] == b[j]) continue;  // unchanged; occurs only if there are too many lines to compare
      if (changed.size() == most) {
        ++more;
      } else {
        changed.push_back(sentence(same + j + 1, j < end_j ? &b[j] : nullptr, i < end_i ? &a[i] : nullptr));
      }
    }
  }
  if (more > 0) changed.push_back(fmt::format("... and {}", counted(more, "more line")));
  return changed;
}

}  // namespace gaitlab
