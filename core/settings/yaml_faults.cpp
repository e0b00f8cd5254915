#include "core/settings/yaml_faults.h"

#include <fmt/format.h>
#include <yaml-cpp/exceptions.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/settings/wording.h"

namespace gaitlab {
namespace {

/// A {, [ or quote with its place.
struct Bracket {
  char open = '{';
  int line = 0, column = 0;
  [[nodiscard]] char close() const { return open == '{' ? '}' : open == '[' ? ']' : open; }
};

/// A fault within a line, with its place.
struct LineFault {
  int line = 0, column = 0;
  std::string text = {};
};

/// Scanner of a text for brackets and quotes outside of comments. A bracket or quote within a text in block style is part of
/// that text; it counts only at the beginning of a value.
class Brackets {
 public:
  /// Reads the next line. Returns its first fault: a closing bracket that does not fit, a quote that is closed in a later line,
  /// or, if the parser refused this line, text behind a value.
  std::optional<LineFault> read(std::string_view line, int number, bool refused) {
    char before = ':';  // the last character that is not blank; a line begins with a value
    ended_ = {};
    for (std::size_t i = 0; i < line.size(); ++i) {
      const char c = line[i];
      const Bracket here{c, number, static_cast<int>(i) + 1};
      if (quote.line > 0) {
        i += read_quoted(line, i, number);
        before = c;
        continue;
      }
      if (c == '#' && (i == 0 || line[i - 1] == ' ')) break;
      if (c == ' ' || c == '\r') continue;
      const bool begins = std::string_view(":-,[{").find(before) != std::string_view::npos;
      if (std::optional<LineFault> fault = after_value(here, line.substr(i), refused)) return fault;
      if (std::optional<LineFault> fault = read_bracket(here, begins, refused)) return fault;
      before = c;
    }
    return {};
  }
  [[nodiscard]] bool within() const { return !open.empty() || quote.line > 0; }

  std::vector<Bracket> open;
  Bracket quote;  ///< the open quote; its line is 0 if there is none

 private:
  /// Reads a character within quotes. Returns the number of further characters that belong to it.
  std::size_t read_quoted(std::string_view line, std::size_t i, int number) {
    const char next = i + 1 < line.size() ? line[i + 1] : '\0';
    if (quote.open == '"' && line[i] == '\\') return 1;
    if (line[i] != quote.open) return 0;
    if (quote.open == '\'' && next == '\'') return 1;
    ended_ = quote;
    spans_ = number > quote.line;
    quote = {};
    return 0;
  }

  /// Fault of a character that follows the end of a value in quotes or brackets.
  std::optional<LineFault> after_value(const Bracket& here, std::string_view rest, bool refused) {
    const Bracket value = ended_;
    const bool fits = here.open == ':' || (!open.empty() && std::string_view(",}]").find(here.open) != std::string_view::npos);
    ended_ = {};
    if (value.line == 0 || fits) return {};
    if (std::exchange(spans_, false))
      return LineFault{value.line, value.column, fmt::format("the {0} opened here is not closed; expected {0}", value.open)};
    if (!refused) return {};
    const bool closes = here.open == '}' || here.open == ']';
    return LineFault{here.line, here.column,
                     fmt::format("found {} after the {} that ends the value; expected {}",
                                 closes ? std::string(1, here.open) : in_quotes(std::string(rest.substr(0, rest.find(' ')))),
                                 value.close(), open.empty() ? "the end of the line" : "a comma or a closing bracket")};
  }

  std::optional<LineFault> read_bracket(const Bracket& here, bool begins, bool refused) {
    const char c = here.open;
    if ((c == '"' || c == '\'') && begins) {
      quote = here;
    } else if ((c == '{' || c == '[') && (begins || !open.empty())) {
      open.push_back(here);
    } else if ((c == '}' || c == ']') && !open.empty()) {
      const Bracket of = open.back();
      if (of.close() != c) {
        return LineFault{here.line, here.column,
                         fmt::format("found {}, but the {} opened in {}:{} is not closed; expected {}", c, of.open, of.line,
                                     of.column, of.close())};
      }
      ended_ = of;
      spans_ = false;
      open.pop_back();
    } else if ((c == '}' || c == ']') && begins && refused) {
      return LineFault{here.line, here.column,
                       fmt::format("found {0}, but no {1} is open; expected {1} before it", c, c == '}' ? '{' : '[')};
    }
    return {};
  }

  Bracket ended_;       ///< the bracket or quote of a value that ended before the next character
  bool spans_ = false;  ///< true if that value is a text in quotes of several lines
};

/// A depth of indentation of keys or list items.
struct Level {
  int indent = 0;
  bool list = false;
  int line = 0;
  std::string key = {};
};

std::string key_at(std::string_view line, std::size_t begin) {
  const std::size_t colon = line.find(':', begin);
  const bool ends = colon != std::string_view::npos && (colon + 1 == line.size() || line[colon + 1] == ' ');
  return ends ? std::string(line.substr(begin, colon - begin)) : "";
}

/// Levels of a line: one for each dash, and one for its key.
std::vector<Level> levels_in(std::string_view line, int number) {
  std::vector<Level> levels;
  std::size_t at = line.find_first_not_of(' ');
  while (at + 1 < line.size() && line[at] == '-' && line[at + 1] == ' ') {
    levels.push_back({static_cast<int>(at), true, number, "-"});
    at = std::min(line.find_first_not_of(' ', at + 1), line.size());
  }
  if (std::string key = key_at(line, at); !key.empty()) levels.push_back({static_cast<int>(at), false, number, std::move(key)});
  return levels;
}

std::string blanks(int n) { return counted(static_cast<std::size_t>(n), "blank"); }

/// Message if the first level of a line does not fit the open levels of earlier lines, or "".
std::string misfit(const Level& own, const std::vector<Level>& open) {
  const auto same = std::ranges::find(open, own.indent, &Level::indent);
  const std::string what = own.list ? "an item of a list (-)" : in_quotes(own.key);
  if (same != open.end() && same->list != own.list) {
    return own.list
               ? fmt::format("found an item of a list (-) among keys; {} of line {} has the same indentation",
                             in_quotes(same->key), same->line)
               : fmt::format("found the key {} among items of a list (-), which begins in line {} with the same indentation",
                             what, same->line);
  }
  if (same != open.end()) return "";
  const auto more = std::ranges::find_if(open, [&](const Level& one) { return one.indent > own.indent; });
  const Level& near = more != open.end() ? *more : open.back();
  return fmt::format("{} is indented by {}, {} of line {} by {}", what, blanks(own.indent),
                     near.list ? "the item" : in_quotes(near.key), near.line, near.indent);
}

}  // namespace

Problem yaml_fault(const std::string& text, const std::string& file, int line) {
  Brackets brackets;
  std::vector<Level> open;
  Problem misplaced;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view one(text.data() + begin, end - begin);
    begin = end + 1;
    ++number;
    const std::size_t first = one.find_first_not_of(" \r");
    if (!brackets.within() && first != std::string_view::npos && one[first] != '#' && number <= line) {
      const std::vector<Level> own = levels_in(one, number);
      if (number == line && !own.empty() && !open.empty())
        misplaced = {{file, number, own.front().indent + 1}, misfit(own.front(), open)};
      std::erase_if(open, [&](const Level& level) { return level.indent >= static_cast<int>(first); });
      open.insert(open.end(), own.begin(), own.end());
    }
    if (const std::optional<LineFault> wrong = brackets.read(one, number, number == line))
      return {{file, wrong->line, wrong->column}, wrong->text};
  }
  const Bracket of = brackets.quote.line > 0 ? brackets.quote : brackets.open.empty() ? Bracket{} : brackets.open.back();
  if (of.line > 0)
    return {{file, of.line, of.column}, fmt::format("the {} opened here is not closed; expected {}", of.open, of.close())};
  return misplaced;
}

bool is_closed(const std::string& text, std::size_t position) {
  const char quote = position < text.size() ? text[position] : '\0';
  if (quote != '"' && quote != '\'') return true;
  for (std::size_t i = position + 1; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == quote) {
      const bool doubled = quote == '\'' && i + 1 < text.size() && text[i + 1] == quote;
      if (!doubled) return true;
      ++i;
    }
  }
  return false;
}

std::string yaml_fault_in_words(const std::string& parser, const std::string& line, std::size_t column) {
  if (parser == YAML::ErrorMsg::MAP_VALUE) {
    const std::size_t colon = line.find(": ");
    std::string value = colon == std::string::npos ? "" : line.substr(colon + 2, line.find(" #", colon) - colon - 2);
    value.erase(value.find_last_not_of(' ') + 1);
    return fmt::format("found a second colon in {}; expected braces, {{{}}}, a text in quotes, or a line for each key",
                       in_quotes(value), clipped(value));
  }
  const bool alias = parser.starts_with(YAML::ErrorMsg::UNKNOWN_ANCHOR);
  if ((alias || parser == YAML::ErrorMsg::UNKNOWN_TOKEN) && column < line.size()) {
    const bool pattern = line[column] == '?' || line[column] == '*';  // the caller adds a remedy
    return fmt::format("found {} outside of quotes{}", line[column], pattern ? "" : "; expected the text in quotes");
  }
  if (parser == YAML::ErrorMsg::CHAR_IN_BLOCK)
    return "found a text after | or >, which begin a text of several lines; expected this text in the lines below, or quotes";
  if (parser.starts_with(YAML::ErrorMsg::INVALID_ESCAPE)) {
    return "found a backslash in double quotes that begins no escape sequence; expected two backslashes, or single quotes";
  }
  return parser;
}

}  // namespace gaitlab
