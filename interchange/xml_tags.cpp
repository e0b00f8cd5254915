#include "interchange/xml_tags.h"

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

namespace gaitlab::interchange {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// Offset behind the next `mark` from `at` on; the end of the text if there is none.
std::size_t past(std::string_view text, std::string_view mark, std::size_t at) {
  const std::size_t found = text.find(mark, at);
  return found == std::string_view::npos ? text.size() : found + mark.size();
}

std::size_t first_not(std::string_view text, std::string_view of, std::size_t at) {
  return std::min(text.find_first_not_of(of, at), text.size());
}

/// Reads the attributes of the opening tag at `tag.begin`, whose name ends at `at`, and its end. Returns false for `<a/>`.
bool read_attributes(std::string_view text, std::size_t at, XmlTag& tag) {
  while (true) {
    at = first_not(text, kBlanks, at);
    if (at == text.size() || text[at] == '>') break;
    if (text[at] == '/') {
      ++at;
      if (at == text.size() || text[at] != '>') continue;
      tag.end = at + 1;
      return false;
    }
    const std::size_t name = at;
    at = std::min(text.find_first_of(" \t\r\n=/>", at), text.size());
    const std::string_view key = text.substr(name, at - name);
    at = first_not(text, kBlanks, at);
    if (at == text.size() || text[at] != '=') {
      if (key.empty()) ++at;
      continue;
    }
    at = first_not(text, kBlanks, at + 1);
    if (at == text.size() || (text[at] != '"' && text[at] != '\'')) continue;
    const std::size_t value = at + 1;
    const std::size_t close = std::min(text.find(text[at], value), text.size());
    tag.attributes.push_back({key, text.substr(value, close - value), value});
    at = std::min(close + 1, text.size());
  }
  tag.end = std::min(at + 1, text.size());
  return true;
}

}  // namespace

const XmlTag::Attribute* XmlTag::attribute(std::string_view wanted) const {
  const auto at = std::ranges::find(attributes, wanted, &Attribute::name);
  return at == attributes.end() ? nullptr : &*at;
}

std::vector<XmlTag> xml_tags(std::string_view text) {
  std::vector<XmlTag> tags;
  std::size_t open = kNoTag;  // innermost element without its closing tag
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::string_view from = text.substr(at);
    if (from.starts_with("<![CDATA[")) {
      at = past(text, "]]>", at);
    } else if (from.starts_with("<!") || from.starts_with("<?")) {
      at = past(text, ">", at);
    } else if (from.starts_with("</")) {
      const std::size_t end = past(text, ">", at);
      const std::size_t name_end = std::min(text.find_first_of(" \t\r\n>", at), text.size());
      if (open != kNoTag && tags[open].name == text.substr(at + 2, name_end - at - 2)) {
        tags[open].close_begin = at;
        tags[open].close_end = end;
        open = tags[open].parent;
      }
      at = end;
    } else {
      const std::size_t name_end = std::min(text.find_first_of(" \t\r\n/>", at + 1), text.size());
      XmlTag tag{.name = text.substr(at + 1, name_end - at - 1), .begin = at, .parent = open};
      const bool opens = read_attributes(text, name_end, tag);
      tag.close_begin = tag.close_end = tag.end;
      at = tag.end;
      tags.push_back(std::move(tag));
      if (opens) open = tags.size() - 1;
    }
  }
  return tags;
}

std::string decoded(std::string text) {
  constexpr std::pair<std::string_view, char> kNames[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  for (std::size_t at = text.find('&'); at != std::string::npos; at = text.find('&', at + 1)) {
    const auto* const named =
        std::ranges::find_if(kNames, [&](const auto& one) { return text.compare(at, one.first.size(), one.first) == 0; });
    if (named != std::end(kNames)) text.replace(at, named->first.size(), 1, named->second);
    if (named != std::end(kNames) || text.compare(at, 2, "&#") != 0) continue;
    const bool hexadecimal = text.compare(at + 2, 1, "x") == 0;
    int number = 0;
    const char* const digits = text.data() + at + (hexadecimal ? 3 : 2);
    const char* const end = text.data() + text.size();
    const auto [after, error] = std::from_chars(digits, end, number, hexadecimal ? 16 : 10);
    if (error == std::errc() && after < end && *after == ';' && number > 0 && number < 128)
      text.replace(at, static_cast<std::size_t>(after + 1 - (text.data() + at)), 1, static_cast<char>(number));
  }
  return text;
}

}  // namespace gaitlab::interchange
