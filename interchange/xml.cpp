#include "interchange/xml.h"

#include <algorithm>

namespace gaitlab::interchange {

namespace {

constexpr std::size_t kMostLevels =
    40;  // largest number of indented levels: otherwise indentation would dominate a long chain of nested bodies

std::string escaped(const std::string& value) {
  std::string out;
  for (const char c : value) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&apos;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

void print(const Xml& element, std::size_t level, std::string& out) {
  const std::string indent(4 * std::min(level, kMostLevels), ' ');
  if (element.name.empty()) {
    out += indent + "<!--" + element.words + "-->\n";
    return;
  }
  out += indent + "<" + element.name;
  for (const auto& [name, value] : element.attributes) out += " " + name + "=\"" + escaped(value) + "\"";
  if (element.children.empty()) {
    out += "/>\n";
    return;
  }
  out += ">\n";
  for (const Xml& child : element.children) print(child, level + 1, out);
  out += indent + "</" + element.name + ">\n";
}

}  // namespace

const std::string* Xml::attribute(const std::string& wanted) const {
  const auto at = std::ranges::find(attributes, wanted, &std::pair<std::string, std::string>::first);
  return at == attributes.end() ? nullptr : &at->second;
}

Xml& add(Xml& parent, std::string name) { return parent.children.emplace_back(Xml{std::move(name), {}, {}, {}}); }

void comment(Xml& parent, std::string words) {
  for (std::size_t at = words.find("--"); at != std::string::npos; at = words.find("--")) words.erase(at, 1);
  parent.children.emplace_back(Xml{{}, " " + words + " ", {}, {}});
}

void set(Xml& element, const std::string& name, std::string value) {
  const auto at = std::ranges::find(element.attributes, name, &std::pair<std::string, std::string>::first);
  if (at == element.attributes.end()) {
    element.attributes.emplace_back(name, std::move(value));
  } else {
    at->second = std::move(value);
  }
}

std::string print(const Xml& root) {
  std::string out;
  print(root, 0, out);
  return out;
}

}  // namespace gaitlab::interchange
