// print_yaml(), which turns a Node into YAML text that parse_yaml() reads back.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/settings/node.h"

namespace gaitlab {
namespace {

bool is_null_text(const std::string& text) {
  return text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL";
}

/// Code point of the character of 1 to 3 bytes at the start of a UTF-8 text.
unsigned code_of(std::string_view text, std::size_t bytes) {
  constexpr unsigned kLead[] = {0x7F, 0x1F, 0xF};
  unsigned code = static_cast<unsigned char>(text[0]) & kLead[bytes - 1];
  for (std::size_t k = 1; k < bytes; ++k) code = code << 6U | (static_cast<unsigned char>(text[k]) & 0x3FU);
  return code;
}

/// Length of the character at the start of a text if YAML texts may not contain it unescaped: control characters (also U+0080
/// to U+009F), line ends of some readers (U+0085, U+2028, U+2029), the byte order mark (U+FEFF), and U+FFFE and U+FFFF.
/// Otherwise 0.
std::size_t unprintable(std::string_view text) {
  const auto byte = static_cast<unsigned char>(text[0]);
  if (byte < 0x20 || byte == 0x7F) return 1;
  if (byte == 0xC2 && text.size() > 1) return code_of(text, 2) < 0xA0 ? 2 : 0;
  if ((byte != 0xE2 && byte != 0xEF) || text.size() < 3) return 0;
  const unsigned code = code_of(text, 3);
  return code == 0x2028 || code == 0x2029 || code == 0xFEFF || code >= 0xFFFE ? 3 : 0;
}

/// True if the text has no such character, except `allowed`.
bool is_printable(std::string_view text, std::string_view allowed = "") {
  for (; !text.empty(); text.remove_prefix(1)) {
    if (unprintable(text) != 0 && allowed.find(text[0]) == std::string_view::npos) return false;
  }
  return true;
}

/// True if a reader takes the text without quotes for this scalar. More characters have a special meaning in a list or map on
/// one line.
bool plain_safe(const std::string& text, bool in_flow) {
  if (is_null_text(text) || text.front() == ' ' || text.back() == ' ' || text.back() == ':') return false;
  if (std::string("?:,[]{}#&*!|>'\"%@`").find(text.front()) != std::string::npos) return false;
  if (text.front() == '-' && (text.size() == 1 || text[1] == ' ' || text[1] == '-')) return false;
  if (text.front() == '.' && text.starts_with("...")) return false;
  if (text.find(": ") != std::string::npos || text.find(" #") != std::string::npos) return false;
  if (in_flow && text.find_first_of(",[]{}?:") != std::string::npos) return false;
  return is_printable(text);
}

std::string double_quoted(std::string_view text) {
  std::string out = "\"";
  for (std::size_t bytes = 0; !text.empty(); text.remove_prefix(std::max<std::size_t>(bytes, 1))) {
    const char c = text[0];
    bytes = unprintable(text);
    if (c == '\n' || c == '\t') {
      out += c == '\n' ? "\\n" : "\\t";
    } else if (bytes > 0) {
      const unsigned code = code_of(text, bytes);
      out += code < 0x100 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{:04x}", code);
    } else {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out + "\"";
}

std::string scalar(const std::string& text, bool quoted, bool in_flow) {
  return !quoted && plain_safe(text, in_flow) ? text : double_quoted(text);
}

/// Text of a key, quoted like a scalar in brackets, because a colon in the key must not end it.
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
  return is_printable(text, "\n");
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
