#include "interchange/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/settings/text_file.h"

namespace gaitlab::interchange {

namespace {

/// Checks the number of elements, because the XML parser of urdfdom and of libmujoco calls itself for nested ones: 50 000
/// overflow its stack.
void check_elements(const std::string& text, const std::string& file) {
  constexpr std::size_t kMost = 10000;
  std::size_t number = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) number += text[i] == '<' && text[i + 1] != '/' ? 1 : 0;
  if (number > kMost)
    throw InputError(SourceLocation{file}, fmt::format("has {} elements; expected at most {}", number, kMost));
}

/// Offset after the first `end` at or after `at`; the end of the text if there is none.
std::size_t behind(const std::string& text, std::string_view end, std::size_t at) {
  const std::size_t found = text.find(end, at);
  return found == std::string::npos ? text.size() : found + end.size();
}

/// Offset of the first element with too many attributes, or npos. The XML parser of urdfdom and of libmujoco compares each
/// attribute of an element with all before it: 60 000 take 12 s. Every attribute has an equals sign outside quotes.
std::size_t crowded_element(const std::string& text, std::size_t most) {
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::string_view from = std::string_view(text).substr(at);
    if (from.starts_with("<!") || from.starts_with("<?")) {
      at = behind(text, from.starts_with("<!--") ? "-->" : from.starts_with("<![CDATA[") ? "]]>" : ">", at);
      continue;
    }
    const std::size_t start = at;
    std::size_t number = 0;
    for (char quote = 0; at < text.size() && (quote != 0 || text[at] != '>'); ++at) {
      const char c = text[at];
      if (quote == 0) number += c == '=' ? 1 : 0;
      if (quote == c) {
        quote = 0;
      } else if (quote == 0 && (c == '"' || c == '\'')) {
        quote = c;
      }
    }
    if (number > most) return start;
  }
  return std::string::npos;
}

}  // namespace

void check_xml(const std::string& text, const std::string& file) {
  constexpr std::size_t kMostAttributes = 100;
  check_text(text, file);
  check_elements(text, file);
  if (const std::size_t crowded = crowded_element(text, kMostAttributes); crowded != std::string::npos) {
    throw InputError(
        place_in_text(text, crowded, file),
        fmt::format("has more than {} attributes; expected an element of a robot file, which has fewer", kMostAttributes));
  }
}

std::string without_comments(std::string text) {
  for (std::size_t at = text.find("<!--"); at != std::string::npos; at = text.find("<!--", at + 1)) {
    const std::size_t close = text.find("-->", at + 4);
    const std::size_t end = close == std::string::npos ? text.size() : close + 3;
    for (std::size_t i = at; i < end; ++i) text[i] = text[i] == '\n' ? '\n' : ' ';
  }
  return text;
}

SourceLocation place_in_text(std::string_view text, std::size_t offset, const std::string& file) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t start = before.rfind('\n') + 1;  // 0 in the first line
  return {file, static_cast<int>(std::ranges::count(before, '\n')) + 1, static_cast<int>(offset - start) + 1};
}

}  // namespace gaitlab::interchange
