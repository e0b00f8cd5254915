// print_yaml(), which prints a Node as YAML text that parse_yaml() reads back.
#include <fmt/format.h>

#include <algorithm>

#include "core/settings/node.h"

namespace gaitlab {
namespace {

bool is_null_text(const std::string& text) {
  return text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL";
}

/// True if a reader takes the text without quotes for this scalar. In a list or map on one line, more characters have a
/// meaning.
bool plain_safe(const std::string& text, bool in_flow) {
  if (is_null_text(text) || text.front() == ' ' || text.back() == ' ' || text.back() == ':') return false;
  if (std::string("?:,[]{}#&*!|>'\"%@`").find(text.front()) != std::string::npos) return false;
  if (text.front() == '-' && (text.size() == 1 || text[1] == ' ' || text[1] == '-')) return false;
  if (text.front() == '.' && text.starts_with("...")) return false;
  if (text.find(": ") != std::string::npos || text.find(" #") != std::string::npos) return false;
  if (in_flow && text.find_first_of(",[]{}?:") != std::string::npos) return false;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) return false;
  }
  return true;
}

std::string double_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (byte < 0x20 || byte == 0x7F) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string scalar(const std::string& text, bool quoted, bool in_flow) {
  return !quoted && plain_safe(text, in_flow) ? text : double_quoted(text);
}

/// Text of a key, quoted like a scalar in brackets, because a colon must not end it early.
std::string key_text(const std::string& key) { return scalar(key, false, true); }

std::string flow(const Node& node) {
  std::string out;
  switch (node.kind) {
    case Node::Kind::null:
      return "null";
    case Node::Kind::scalar:
      return scalar(node.text, node.quoted, true);
    case Node::Kind::list:
      for (const Node& item : node.items) out += (out.empty() ? "" : ", ") + flow(item);
      return "[" + out + "]";
    case Node::Kind::map:
      for (std::size_t i = 0; i < node.items.size(); ++i) {
        out += (i > 0 ? ", " : "") + key_text(node.keys[i].first) + ": " + flow(node.items[i]);
      }
      return "{" + out + "}";
  }
  return out;
}

bool is_block(const Node& node) {
  return (node.kind == Node::Kind::list || node.kind == Node::Kind::map) && !node.flow && !node.items.empty();
}

/// True if a block after `|` can contain the lines unchanged; a first line that begins with a space cannot.
bool fits_block(const Node& node) {
  const std::string& text = node.text;
  if (node.kind != Node::Kind::scalar || !node.quoted || text.find('\n') == std::string::npos) return false;
  if (text.front() == ' ' || text.front() == '\n' || text.ends_with("\n\n")) return false;
  if (text.find(" \n") != std::string::npos || text.back() == ' ') return false;
  return std::all_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return c == '\n' || (byte >= 0x20 && byte != 0x7F);
  });
}

/// The lines of a block, to be printed below its key.
std::string block(const std::string& text, int indent) {
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  std::string out = text.ends_with('\n') ? "|\n" : "|-\n";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (end > at) out += margin + text.substr(at, end - at);
    out += '\n';
    at = end + 1;
  }
  return out;
}

std::string one_line(const Node& node) {
  return node.kind == Node::Kind::scalar ? scalar(node.text, node.quoted, false) : flow(node);
}

}  // namespace

std::string print_yaml(const Node& node, int indent) {
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  if (!is_block(node)) return margin + one_line(node) + "\n";
  std::string out;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const Node& item = node.items[i];
    if (node.kind == Node::Kind::list) {
      // The text of the item. A dash replaces the indentation of the first line.
      out += margin + "- " + print_yaml(item, indent + 2).substr(margin.size() + 2);
    } else if (fits_block(item)) {
      out += margin + key_text(node.keys[i].first) + ": " + block(item.text, indent + 2);
    } else if (is_block(item)) {
      out += margin + key_text(node.keys[i].first) + ":\n" + print_yaml(item, indent + 2);
    } else {
      out += margin + key_text(node.keys[i].first) + ": " + one_line(item) + "\n";
    }
  }
  return out;
}

}  // namespace gaitlab
