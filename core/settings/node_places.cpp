// Places within scalars. yaml-cpp gives only the start of a scalar (the position of `|` for a block scalar). These functions
// therefore read the source again.
#include "core/settings/node_places.h"

#include <fmt/format.h>

#include <algorithm>

namespace gaitlab {
namespace {

/// Number of bytes of the source at `at` that represent the character c of a text. 0 if the source has another character there.
std::size_t length_of(const std::string& source, std::size_t at, char quote, char c) {
  if (at >= source.size() || source[at] == '\n') return 0;
  if (quote == '\'' && c == '\'') return source.compare(at, 2, "''") == 0 ? 2 : 0;
  if (quote == '"' && source[at] == '\\') {
    const char escaped = c == '\n' ? 'n' : c == '\t' ? 't' : c;
    return at + 1 < source.size() && source[at + 1] == escaped ? 2 : 0;
  }
  return source[at] == c ? 1 : 0;
}

/// Place in a scalar on one line, with or without quotes.
SourceLocation in_line(const Node& scalar, std::size_t offset) {
  const std::string& source = *scalar.source;
  const char first = source[scalar.position];
  const char quote = scalar.quoted && (first == '"' || first == '\'') ? first : '\0';
  std::size_t at = scalar.position + (quote != '\0' ? 1 : 0);
  for (std::size_t i = 0; i < offset; ++i) {
    const std::size_t length = length_of(source, at, quote, scalar.text[i]);
    if (length == 0) return scalar.place;
    at += length;
  }
  SourceLocation place = scalar.place;
  place.column += static_cast<int>(at - scalar.position);
  return place;
}

std::size_t leading_spaces(const std::string& text, std::size_t line) {
  return std::min(text.find_first_not_of(' ', line), text.size()) - line;
}

/// Start of the first line that is not empty, or npos.
std::size_t first_content(const std::string& text, std::size_t line) {
  while (line < text.size()) {
    const std::size_t at = text.find_first_not_of(" \r", line);
    if (at == std::string::npos) return at;
    if (text[at] != '\n') return line;
    line = at + 1;
  }
  return std::string::npos;
}

/// Place in a block after `|`. Every line of the block is a line of the source, indented.
SourceLocation in_block(const Node& scalar, std::size_t offset) {
  const std::string& source = *scalar.source;
  const std::size_t end_of_header = source.find('\n', scalar.position);
  const std::size_t in_text = first_content(scalar.text, 0);
  if (end_of_header == std::string::npos || in_text == std::string::npos) return scalar.place;
  const std::size_t in_source = first_content(source, end_of_header + 1);
  if (in_source == std::string::npos) return scalar.place;
  const std::size_t indent = leading_spaces(source, in_source) - leading_spaces(scalar.text, in_text);
  const auto before = scalar.text.begin() + static_cast<std::ptrdiff_t>(offset);
  const auto lines = std::count(scalar.text.begin(), before, '\n');
  const std::size_t line_start = offset == 0 ? std::string::npos : scalar.text.rfind('\n', offset - 1);
  const std::size_t column = line_start == std::string::npos ? offset : offset - line_start - 1;
  return {scalar.place.file, scalar.place.line + 1 + static_cast<int>(lines), static_cast<int>(indent + column) + 1};
}

}  // namespace

SourceLocation place_in(const Node& scalar, std::size_t offset) {
  if (scalar.kind != Node::Kind::scalar || scalar.source == nullptr || scalar.position >= scalar.source->size()) {
    return scalar.place;
  }
  offset = std::min(offset, scalar.text.size());
  const char first = (*scalar.source)[scalar.position];
  if (scalar.quoted && first == '|') return in_block(scalar, offset);
  if (scalar.quoted && first == '>') return scalar.place;
  return in_line(scalar, offset);
}

void add_in(const Node& scalar, std::size_t offset, std::string_view what, Problems& problems) {
  const SourceLocation place = place_in(scalar, offset);
  const bool followed = offset == 0 || to_string(place) != to_string(scalar.place);
  problems.add(place, followed ? std::string(what) : fmt::format("{} (at character {} of the text)", what, offset + 1));
}

}  // namespace gaitlab
