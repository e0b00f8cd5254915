#include "core/errors.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <numeric>

namespace gaitlab {

std::string to_string(const SourceLocation& place) {
  if (place.line == 0) return place.file;
  return place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

namespace {

constexpr std::size_t kMostProblems = 200;  // largest number of problems in a message
constexpr std::size_t kMostBytes =
    500;  // largest length of a problem, as a second safeguard; texts of users are clipped earlier

/// Number of bytes of the control character in UTF-8 that begins at `i`; 0 for other characters. Control characters are those
/// of ASCII, the second set (U+0080 to U+009F), line separators (U+2028, U+2029), bidirectional marks, because they display a
/// text in another order than its bytes, and U+FFFE and U+FFFF, which no text may contain.
std::size_t control_at(std::string_view text, std::size_t i) noexcept {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const unsigned second = byte(i + 1);
  const unsigned third = byte(i + 2);
  if (byte(i) < 0x20 || byte(i) == 0x7F) return 1;
  if (byte(i) == 0xC2) return second >= 0x80 && second < 0xA0 ? 2 : 0;
  if (byte(i) == 0xD8) return second == 0x9C ? 2 : 0;  // U+061C
  if (byte(i) == 0xEF) return second == 0xBF && (third == 0xBE || third == 0xBF) ? 3 : 0;
  if (byte(i) != 0xE2) return 0;
  const bool marks =
      second == 0x80 && (third == 0x8E || third == 0x8F || (third >= 0xA8 && third <= 0xAE));  // U+200E, 2028 ...
  const bool isolates = second == 0x81 && third >= 0xA6 && third <= 0xA9;                      // U+2066 ...
  return marks || isolates ? 3 : 0;
}

/// Passes the text to `put` in pieces. Each control character except `kept` becomes \xHH.
template <class Put>
void escape(std::string_view text, char kept, const Put& put) {
  constexpr std::string_view kHex = "0123456789abcdef";
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t control = text[i] == kept ? 0 : control_at(text, i);
    if (control == 0) put(text.substr(i++, 1));
    for (const std::size_t end = i + control; i < end; ++i) {
      const auto byte = static_cast<unsigned char>(text[i]);
      const std::array<char, 4> shown{'\\', 'x', kHex[byte >> 4U], kHex[byte & 15U]};
      put({shown.data(), shown.size()});
    }
  }
}

std::string escaped_but(char kept, const std::string& text) {
  std::string out;
  escape(text, kept, [&](std::string_view piece) { out += piece; });
  return out;
}

/// Clips a text to kMostBytes, between two characters.
std::string cut(const std::string& text) {
  if (text.size() <= kMostBytes) return text;
  std::size_t end = kMostBytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80) --end;
  return text.substr(0, end) + "... (" + std::to_string(text.size() - end) + " bytes more)";
}

std::string line(const SourceLocation& place, const char* kind, const std::string& text) {
  return one_line(to_string(place)) + ": " + kind + ": " + cut(escaped_but('\n', text));
}

std::string report(const std::vector<Problem>& problems) {
  std::string text;
  for (std::size_t i = 0; i < std::min(problems.size(), kMostProblems); ++i) {
    if (!text.empty()) text += '\n';
    text += line(problems[i].place, "error", problems[i].text);
    for (const auto& [place, note] : problems[i].notes) text += "\n" + line(place, "note", note);
  }
  if (problems.size() > kMostProblems) {
    text += "\n" + one_line(problems.front().place.file) + ": error: " + std::to_string(problems.size() - kMostProblems) +
            " more errors";
  }
  return text;
}

// Levenshtein distance, in which a swap of neighbours, the most common typing error, counts as one. If the distance is at least
// `enough`, the result may be any number of at least `enough`, because the caller then discards the name.
std::size_t distance(const std::string& a, const std::string& b, std::size_t enough) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::vector<std::size_t> next(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  std::size_t least_before = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    next[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      next[j + 1] = std::min({row[j + 1] + 1, next[j] + 1, row[j] + (a[i] == b[j] ? 0U : 1U)});
      if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j]) next[j + 1] = std::min(next[j + 1], before[j - 1] + 1);
    }
    const std::size_t least = *std::min_element(next.begin(), next.end());
    if (std::min(least, least_before) >= enough) return enough;
    least_before = least;
    before = std::exchange(row, std::exchange(next, std::move(before)));
  }
  return row.back();
}

}  // namespace

std::string one_line(const std::string& name) { return escaped_but(' ', name); }

namespace {

std::atomic<void (*)(std::string_view) noexcept> said_to = nullptr;

}  // namespace

void say_to(void (*receiver)(std::string_view text) noexcept) noexcept { said_to = receiver; }

void say(std::string_view text) noexcept {
  if (const auto receiver = said_to.load()) {
    receiver(text);
    return;
  }
  std::array<char, 1024> piece{};
  std::size_t used = 0;
  const auto flush = [&] { (void)std::fwrite(piece.data(), 1, std::exchange(used, 0), stderr); };
  escape(text, '\n', [&](std::string_view part) {
    if (used + part.size() > piece.size()) flush();
    used += part.copy(piece.data() + used, part.size());
  });
  flush();
}

void say(const std::string& name, const char* kind, const std::string& text) {
  say(one_line(name) + ": " + kind + ": " + text + "\n");
}

void Problems::order(std::size_t first) {
  std::stable_sort(list_.begin() + static_cast<std::ptrdiff_t>(first), list_.end(), [](const Problem& a, const Problem& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
}

void Problems::raise() const {
  if (!list_.empty()) throw InputError(list_);
}

InputError::InputError(std::vector<Problem> problems) : std::runtime_error(report(problems)), problems_(std::move(problems)) {}

InputError::InputError(SourceLocation place, std::string text)
    : InputError(std::vector<Problem>{{std::move(place), std::move(text), {}}}) {}

namespace {

/// Number of equal characters at the beginning of two names. Among equally similar names, the one with the most such characters
/// is suggested, because users misspell the end of a word more often.
std::size_t alike(const std::string& a, const std::string& b) {
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

}  // namespace

std::string nearest(const std::string& found, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 200;  // a longer text is not similar to any name, and its distances would take seconds
  if (found.size() > kLongest) return {};
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, found.size() / 3) + 1;
  for (const std::string& name : known) {
    // Each additional or missing letter adds one to the distance.
    if (std::max(name.size(), found.size()) - std::min(name.size(), found.size()) > best_distance) continue;
    const std::size_t d = distance(found, name, best_distance + 1);
    const bool closer = d == best_distance && !best.empty() && alike(found, name) > alike(found, best);
    if (d < best_distance || closer) {
      best = name;
      best_distance = d;
    }
  }
  if (!best.empty() || found.size() < 3) return best;
  // `found` may be an abbreviation: the only name that begins with it is the result.
  for (const std::string& name : known) {
    if (!name.starts_with(found)) continue;
    if (!best.empty()) return {};
    best = name;
  }
  if (!best.empty()) return best;
  // If `found` is too long, the result is the longest name that `found` begins with.
  constexpr std::size_t kShortest = 4;
  for (const std::string& name : known) {
    if (name.size() >= kShortest && name.size() > best.size() && found.starts_with(name)) best = name;
  }
  return best;
}

}  // namespace gaitlab
