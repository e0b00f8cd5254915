// Parser based on yaml-cpp 0.7. The node API of that library accepts too much (duplicate keys, aliases, tags, further
// documents). The tree is therefore built from parse events, which still distinguish these cases.
#include "core/settings/node.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <unordered_map>

#include "core/files/atomic_file.h"
#include "core/settings/number_syntax.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"
#include "core/settings/yaml_faults.h"

namespace gaitlab {
namespace {

constexpr std::size_t kMaxDepth = 32;

/// Exception that leaves the parser after a problem that makes the remaining text unreadable.
struct Stop {};

/// Place of the first tab in the indentation of a line, up to and including line `last` (from 0).
std::optional<SourceLocation> indenting_tab(const std::string& text, const std::string& file, int last) {
  std::size_t begin = 0;
  for (int line = 0; line <= last && begin < text.size(); ++line) {
    const std::size_t first = text.find_first_not_of(' ', begin);
    if (first != std::string::npos && text[first] == '\t')
      return SourceLocation{file, line + 1, static_cast<int>(first - begin) + 1};
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;
    begin = end + 1;
  }
  return {};
}

class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, const std::string& file, Problems& problems)
      : text_(std::make_shared<const std::string>(text)), file_(file), problems_(problems) {}

  /// The finished root, for use only after a whole document.
  Node take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (documents_++ > 0) stop(at(mark), "found a second YAML document; expected one per file");
  }
  void OnDocumentEnd() override {
    if (root_.kind != Node::Kind::map) stop({file_, 1, 1}, "found " + found(root_) + "; expected a map (KEY: VALUE lines)");
  }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { add({Node::Kind::null, at(mark)}); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    stop(at(mark), "found an alias (*name); write the value itself");
  }
  void OnAnchor(const YAML::Mark& mark, const std::string& name) override {
    problems_.add(at(mark), "found the anchor '&" + clipped(name) + "'; anchors and aliases are not supported");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, const std::string& value) override {
    Node node{Node::Kind::scalar, at(mark)};
    node.text = value;
    node.quoted = tag == "!";
    node.source = text_;
    node.position = static_cast<std::size_t>(std::max(0, mark.pos));
    // A quoted scalar has the tag "!" implicitly. An explicit tag starts with '!' in the text.
    const bool explicit_tag = tag != "?" && (tag != "!" || character(mark) == '!');
    check_tag(mark, explicit_tag, tag);
    if (node.quoted && !explicit_tag && !is_closed(*text_, node.position))  // yaml-cpp accepts a quote that is not closed
      stop(node.place, fmt::format("not valid YAML: the {0} opened here is not closed; expected {0}", character(mark)));
    add(std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                       YAML::EmitterStyle::value style) override {
    open(Node::Kind::list, mark, tag, style);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, YAML::EmitterStyle::value style) override {
    open(Node::Kind::map, mark, tag, style);
  }
  void OnMapEnd() override { close(); }

 private:
  /// A list or map that is not complete yet.
  struct Open {
    Node node;
    bool has_key = false, duplicate = false;
    /// Index of the keys so far, because linear searches would take quadratic time.
    std::unordered_map<std::string, std::size_t> index = {};
  };

  [[nodiscard]] SourceLocation at(const YAML::Mark& mark) const { return {file_, mark.line + 1, mark.column + 1}; }
  [[nodiscard]] char character(const YAML::Mark& mark) const {
    const auto position = static_cast<std::size_t>(mark.pos);
    return mark.pos >= 0 && position < text_->size() ? (*text_)[position] : '\0';
  }

  [[noreturn]] void stop(SourceLocation place, std::string what) {
    problems_.add(std::move(place), std::move(what));
    throw Stop();
  }

  void check_tag(const YAML::Mark& mark, bool explicit_tag, const std::string& tag) {
    if (explicit_tag) problems_.add(at(mark), "found the tag '" + clipped(tag) + "'; explicit tags are not supported");
  }

  void open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::EmitterStyle::value style) {
    if (stack_.size() >= kMaxDepth) stop(at(mark), fmt::format("nested deeper than {} levels", kMaxDepth));
    if (expects_key()) refuse_key(at(mark), kind == Node::Kind::list ? "a list" : "a map");
    check_tag(mark, tag != "?" && !tag.empty(), tag);
    Node node{kind, at(mark)};
    node.flow = style == YAML::EmitterStyle::Flow;
    stack_.push_back({std::move(node)});
  }

  void close() {
    Node node = std::move(stack_.back().node);
    stack_.pop_back();
    add(std::move(node));
  }

  [[nodiscard]] bool expects_key() const {
    return !stack_.empty() && stack_.back().node.kind == Node::Kind::map && !stack_.back().has_key;
  }

  [[noreturn]] void refuse_key(SourceLocation place, const std::string& kind) {
    stop(std::move(place), "found " + kind + " as a key; expected a name");
  }

  void add(Node node) {
    constexpr std::size_t kMost = std::size_t{1} << 19;  // as in 1 MB of the shortest values
    if (++nodes_ > kMost) stop(std::move(node.place), fmt::format("more than {} values", kMost));
    if (stack_.empty()) {
      root_ = std::move(node);
    } else if (expects_key()) {
      add_key(node);
    } else {
      add_item(std::move(node));
    }
  }

  void add_key(const Node& key) {
    if (key.kind != Node::Kind::scalar) refuse_key(key.place, "nothing");
    Open& top = stack_.back();
    const auto [first, fresh] = top.index.emplace(key.text, top.node.keys.size());
    top.has_key = true;
    top.duplicate = !fresh;
    if (fresh) {
      top.node.keys.emplace_back(key.text, key.place);
    } else {
      Problem& problem = problems_.add(key.place, "duplicate key " + in_quotes(key.text));
      problem.notes.emplace_back(top.node.keys[first->second].second, "it is given here first");
    }
  }

  /// Adds a node to the innermost list or map. The value of a duplicate key is dropped, and reading continues to find other
  /// problems.
  void add_item(Node node) {
    Open& top = stack_.back();
    const bool in_map = top.node.kind == Node::Kind::map;
    // yaml-cpp gives an absent value the place of the text that follows.
    const bool absent = node.kind == Node::Kind::null && in_map && !top.duplicate;
    if (absent && node.place.line != top.node.keys.back().second.line) node.place = top.node.keys.back().second;
    if (!top.duplicate) top.node.items.push_back(std::move(node));
    top.has_key = top.duplicate = false;
  }

  std::shared_ptr<const std::string> text_;
  const std::string& file_;
  Problems& problems_;
  std::vector<Open> stack_;
  Node root_;
  int documents_ = 0;
  std::size_t nodes_ = 0;
};

std::string in_words(const YAML::Exception& e, const std::string& text) {
  const auto position = std::min(static_cast<std::size_t>(e.mark.pos), text.size());
  const auto column = std::min(static_cast<std::size_t>(e.mark.column), position);
  const std::size_t begin = position - column;
  return yaml_fault_in_words(e.msg, text.substr(begin, text.find_first_of("\r\n", begin) - begin), column);
}

/// If the last problem reports a list or map as a key, replaces it by a problem at the unclosed bracket before it.
void explain_last(const std::string& text, const std::string& file, Problems& problems) {
  const Problem& last = problems.list().back();
  Problem fault = yaml_fault(text, file, last.place.line);
  const bool before = fault.place.line > 0 && fault.place.line <= last.place.line;
  if (last.text.find("as a key") == std::string::npos || !before || fault.text.find("not closed") == std::string::npos) return;
  fault.text.insert(0, "not valid YAML: ");
  problems.replace(problems.size() - 1, std::move(fault));
}

std::optional<Node> build(const std::string& text, const std::string& file, Problems& problems) {
  TreeBuilder builder(text, file, problems);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) throw InputError({file}, "the file is empty; expected a map (KEY: VALUE lines)");
    // This is a second call instead of a loop, because for stray text yaml-cpp reports an endless number of documents.
    parser.HandleNextDocument(builder);
    return builder.take();
  } catch (const Stop&) {
    explain_last(text, file, problems);
    return {};
  } catch (const YAML::Exception& e) {
    if (const std::optional<SourceLocation> tab = indenting_tab(text, file, e.mark.line); tab && !e.mark.is_null()) {
      problems.add(*tab, "found a tab in the indentation; YAML is indented with blanks");
      return {};
    }
    const bool placed = !e.mark.is_null();
    const char at = placed && e.mark.pos >= 0 && static_cast<std::size_t>(e.mark.pos) < text.size()
                        ? text[static_cast<std::size_t>(e.mark.pos)]
                        : '\0';
    if (Problem fault = yaml_fault(text, file, e.mark.line + 1); placed && !fault.text.empty()) {
      problems.add(std::move(fault.place), "not valid YAML: " + fault.text);
      return {};
    }
    problems.add(placed ? SourceLocation{file, e.mark.line + 1, e.mark.column + 1} : SourceLocation{file},
                 "not valid YAML: " + (placed ? in_words(e, text) : e.msg) +
                     (at == '*' || at == '?' ? "; a pattern goes in quotes: \"*/active\"" : ""));
    return {};
  }
}

}  // namespace

const Node* Node::find(const std::string& key) const {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].first == key) return &items[i];
  }
  return nullptr;
}

std::optional<Node> parse_yaml(const std::string& text, const std::string& file, Problems& problems) {
  try {
    if (text.size() > kMostJson) throw InputError({file}, "the text is larger than 16 MB");  // records contain logs
    check_text(text, file);
    // Removed, because yaml-cpp would count the byte order mark in its positions.
    return build(text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text, file, problems);
  } catch (const InputError& e) {
    add_all(e, problems);
  } catch (const std::exception& e) {
    problems.add({file}, std::string("not valid YAML: ") + e.what());
  }
  return {};
}

Node parse_yaml(const std::string& text, const std::string& file) {
  Problems problems;
  std::optional<Node> node = parse_yaml(text, file, problems);
  problems.raise();
  return std::move(*node);
}

Node read_yaml(const std::string& path, const SourceLocation& asked_at) { return parse_yaml(read_text(path, asked_at), path); }

std::string found(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      return "empty";
    case Node::Kind::list:
      return "a list";
    case Node::Kind::map:
      return "a map";
    case Node::Kind::scalar:
      break;
  }
  if (node.quoted) return "\"" + clipped(node.text) + "\" in quotes";
  return looks_like_a_number(node.text) ? clipped(node.text) : in_quotes(node.text);
}

}  // namespace gaitlab
