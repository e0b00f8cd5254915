#include "core/settings/changed_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "core/settings/changed_lines.h"
#include "core/settings/node.h"
#include "core/settings/wording.h"

namespace gaitlab {

namespace {

constexpr std::size_t kShortValue = 30;      // characters; a longer value is shown only around the change
constexpr std::size_t kBeforeTheChange = 8;  // characters shown before the change
// Most elements of a list that counts as one value, such as an inertia; longer lists are compared element by element.
constexpr std::size_t kLongestVector = 6;
constexpr std::string_view kNotSet = "not set";

bool is_scalar(const Node& node) { return node.kind == Node::Kind::scalar || node.kind == Node::Kind::null; }

/// True if a list counts as one value, such as a vector or a dock.
bool is_vector(const Node& node) {
  return node.kind == Node::Kind::list && node.items.size() <= kLongestVector &&
         std::all_of(node.items.begin(), node.items.end(), is_scalar);
}

/// Value of a node on one line.
std::string value_text(Node node) {
  node.flow = true;
  std::string text = print_yaml(node);
  text.pop_back();
  return text;
}

/// Part of a long value around the change. The first `same` characters are equal in both values.
std::string around(const std::string& text, std::size_t same) {
  const auto inside = [&](std::size_t at) {  // true if the byte is inside a character of several bytes
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80;
  };
  std::size_t from = text.size() > kShortValue && same > kBeforeTheChange ? same - kBeforeTheChange : 0;
  while (inside(from)) ++from;
  std::size_t end = std::min(text.size(), from + kShortValue);
  while (inside(end)) --end;
  return (from > 0 ? "..." : "") + clipped(text.substr(from, end - from)) + (end < text.size() ? "..." : "");
}

class SettingsDifference {
 public:
  std::vector<std::string> of(const Node& then, const Node& now) {
    visit("", then, now);
    return std::move(found_);
  }

 private:
  static std::string path(const std::string& section, const std::string& key) {
    return section.empty() ? key : section + "." + key;
  }

  void add(const std::string& key, const std::string& then, const std::string& now) {
    const auto same =
        static_cast<std::size_t>(std::mismatch(then.begin(), then.end(), now.begin(), now.end()).first - then.begin());
    found_.push_back(fmt::format("{}: {} -> {}", clipped(key), around(then, same), around(now, same)));
  }
  void added(const std::string& key, const Node& now) {
    found_.push_back(fmt::format("{}: {} -> {}", clipped(key), kNotSet, around(value_text(now), 0)));
  }
  void removed(const std::string& key, const Node& then) {
    found_.push_back(fmt::format("{}: {} -> {}", clipped(key), around(value_text(then), 0), kNotSet));
  }

  void visit(const std::string& key, const Node& then, const Node& now) {
    if (value_text(then) == value_text(now)) return;
    const bool lists = then.kind == Node::Kind::list && now.kind == Node::Kind::list;
    if (then.kind == Node::Kind::map && now.kind == Node::Kind::map) {
      maps(key, then, now);
    } else if (lists && !(is_vector(then) && is_vector(now))) {
      elements(key, then, now);
    } else if (then.text.find('\n') != std::string::npos && now.text.find('\n') != std::string::npos) {
      for (const std::string& line : changed_lines(then.text, now.text))
        found_.push_back(fmt::format("{}, {}", clipped(key), line));
    } else {
      add(key, value_text(then), value_text(now));
    }
  }

  void maps(const std::string& key, const Node& then, const Node& now) {
    for (std::size_t i = 0; i < now.items.size(); ++i) {
      const std::string& name = now.keys[i].first;
      const Node* before = then.find(name);
      before == nullptr ? added(path(key, name), now.items[i]) : visit(path(key, name), *before, now.items[i]);
    }
    for (std::size_t i = 0; i < then.items.size(); ++i) {
      if (now.find(then.keys[i].first) == nullptr) removed(path(key, then.keys[i].first), then.items[i]);
    }
  }

  /// Compares two lists without their common beginning and end, so that the insertion of an element is one change.
  void elements(const std::string& key, const Node& then, const Node& now) {
    const auto same = [](const Node& a, const Node& b) { return value_text(a) == value_text(b); };
    std::size_t begin = 0;
    std::size_t end_then = then.items.size();
    std::size_t end_now = now.items.size();
    while (begin < std::min(end_then, end_now) && same(then.items[begin], now.items[begin])) ++begin;
    while (std::min(end_then, end_now) > begin && same(then.items[end_then - 1], now.items[end_now - 1])) --end_then, --end_now;
    for (std::size_t i = begin; i < std::max(end_then, end_now); ++i) {
      const std::string element = fmt::format("{}[{}]", key, i);
      if (i >= end_then) {
        added(element, now.items[i]);
      } else if (i >= end_now) {
        removed(element, then.items[i]);
      } else {
        visit(element, then.items[i], now.items[i]);
      }
    }
  }

  std::vector<std::string> found_;
};

std::optional<Node> tree(const std::string& text) {
  Problems ignored;
  return parse_yaml(text, "", ignored);
}

}  // namespace

std::vector<std::string> changed_settings(const std::string& then, const std::string& now, std::size_t most) {
  const std::optional<Node> a = tree(then);
  const std::optional<Node> b = tree(now);
  std::vector<std::string> changed;
  if (a && b) changed = SettingsDifference().of(*a, *b);
  if (changed.empty()) return changed_lines(then, now, most);
  if (changed.size() > most) {
    const std::size_t more = changed.size() - most;
    changed.resize(most);
    changed.push_back(fmt::format("... and {}", counted(more, "more setting")));
  }
  return changed;
}

}  // namespace gaitlab
