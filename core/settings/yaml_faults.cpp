#include "core/settings/yaml_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "core/settings/wording.h"

namespace gaitlab {
namespace {

/// A { or [ with its place.
struct Bracket {
  char open = '{';
  int line = 0, column = 0;
  [[nodiscard]] char close() const { return open == '{' ? '}' : ']'; }
};

/// Scanner of a text for brackets outside of quotes and comments. In block style, a bracket or quote within a text is part of
/// that text, and only one at the beginning of a value counts.
class Brackets {
 public:
  /// Reads the next line. Returns the first closing bracket that does not fit, if any.
  std::optional<Bracket> read(std::string_view line, int number) {
    char before = ':';  // the last character that is not blank; a line begins with a value
    for (std::size_t i = 0; i < line.size(); ++i) {
      const char c = line[i];
      const bool begins = std::string_view(":-,[{").find(before) != std::string_view::npos;
      if (quote_ != '\0') {
        if (c == quote_) quote_ = '\0';
      } else if (c == '#' && (i == 0 || line[i - 1] == ' ')) {
        break;
      } else if ((c == '"' || c == '\'') && begins) {
        quote_ = c;
      } else if ((c == '{' || c == '[') && (begins || !open.empty())) {
        open.push_back({c, number, static_cast<int>(i) + 1});
      } else if ((c == '}' || c == ']') && !open.empty()) {
        if (open.back().close() != c) return Bracket{c, number, static_cast<int>(i) + 1};
        open.pop_back();
      }
      if (c != ' ') before = c;
    }
    return {};
  }
  [[nodiscard]] bool within() const { return !open.empty() || quote_ != '\0'; }

  std::vector<Bracket> open;

 private:
  char quote_ = '\0';
};

/// A depth of indentation at which keys or items of a list stand.
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

/// Levels of a line: those of its dashes, and that of its key.
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

/// Fault of the first level of a line against the open levels of the lines before, or "".
std::string misfit(const Level& own, const std::vector<Level>& open) {
  const auto same = std::ranges::find(open, own.indent, &Level::indent);
  const std::string what = own.list ? "an item of a list (-)" : in_quotes(own.key);
  if (same != open.end() && same->list != own.list) {
    return own.list ? fmt::format("found an item of a list (-) among keys; {} of line {} is indented as much",
                                  in_quotes(same->key), same->line)
                    : fmt::format("found the key {} among items of a list (-), which begins in line {} and is indented as much",
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
    if (const std::optional<Bracket> wrong = brackets.read(one, number)) {
      const Bracket& of = brackets.open.back();
      return {{file, wrong->line, wrong->column},
              fmt::format("found {}, but the {} opened in {}:{} is not closed; expected {}", wrong->open, of.open, of.line,
                          of.column, of.close())};
    }
  }
  if (!brackets.open.empty()) {
    const Bracket& of = brackets.open.back();
    return {{file, of.line, of.column}, fmt::format("the {} opened here is not closed; expected {}", of.open, of.close())};
  }
  return misplaced;
}

}  // namespace gaitlab
