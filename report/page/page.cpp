#include "report/page/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

std::string html_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace

std::string page(const PageData& data) {
  const std::string_view empty = page_template();
  const std::string title = html_escaped(data.name);
  const std::array<std::pair<std::string_view, std::string_view>, 3> marks{
      {{"/*TITLE*/", title}, {"/*META*/", data.meta}, {"/*DATA*/", data.data}}};
  std::string text;
  text.reserve(empty.size() + title.size() + data.meta.size() + data.data.size());
  // Inserted text is not searched for marks, because a name may contain one. The marks may be in any order.
  for (std::size_t at = 0; at < empty.size();) {
    std::size_t next = empty.size();
    const std::pair<std::string_view, std::string_view>* found = nullptr;
    for (const auto& mark : marks) {
      if (const std::size_t place = empty.find(mark.first, at); place < next) {
        next = place;
        found = &mark;
      }
    }
    text += empty.substr(at, next - at);
    at = next;
    if (found == nullptr) break;
    text += found->second;
    at += found->first.size();
  }
  return text;
}

std::string watched_page(std::string page, int run) {
  const auto replace = [&](std::string_view from, const std::string& to) {
    const std::size_t at = page.find(from);
    if (at == std::string::npos) throw std::logic_error("the page lacks " + std::string(from));
    page.replace(at, from.size(), to);
  };
  replace("img-src data: blob:", "img-src 'self' data: blob: file:");  // 'self' is a server, but not a file
  replace("<html lang=\"en\"", fmt::format("<html lang=\"en\" data-watch=\"{}\"", run));
  return page;
}

namespace {
constexpr std::string_view kStampStart = R"(<svg xmlns="http://www.w3.org/2000/svg" width=")";
}  // namespace

std::string stamp(int run, bool error) {
  return fmt::format("{}{}\" height=\"{}\"/>\n", kStampStart, std::max(run, 1), error ? 2 : 1);
}

std::string picture_of(std::string_view message) {
  constexpr std::size_t kWidest = 110, kMost = 20;  // characters, lines
  constexpr double kLine = 18, kCharacter = 7.9;    // px
  std::vector<std::string> lines;
  std::size_t widest = 0;
  for (std::size_t at = 0; at < message.size() && lines.size() < kMost;) {
    std::size_t end = std::min(message.find('\n', at), message.size());
    if (end - at > kWidest) {
      const std::size_t blank = message.rfind(' ', at + kWidest);
      end = blank != std::string_view::npos && blank > at ? blank : std::min(end, at + 4 * kWidest);
    }
    lines.emplace_back(message.substr(at, end - at));
    widest = std::max(widest, end - at);
    at = end < message.size() && (message[end] == ' ' || message[end] == '\n') ? end + 1 : end;
  }
  std::string text;
  for (std::size_t k = 0; k < lines.size(); ++k)
    text += fmt::format("<text y=\"{}\">{}</text>\n", kLine * static_cast<double>(k) + 13, xml_escaped(lines[k]));
  return fmt::format(
      "{}{}\" height=\"{}\" font-family=\"monospace\" font-size=\"13\" fill=\"#b3261e\" xml:space=\"preserve\">\n{}</svg>\n",
      kStampStart, std::ceil(kCharacter * static_cast<double>(widest)), kLine * static_cast<double>(lines.size()), text);
}

std::optional<int> stamped(std::string_view text) {
  int run = 0;
  if (!text.starts_with(kStampStart)) return {};
  text.remove_prefix(kStampStart.size());
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), run);
  const bool whole = error == std::errc() && (stamp(run, false).ends_with(text) || stamp(run, true).ends_with(text));
  return whole && run >= 1 ? std::optional(run) : std::nullopt;
}

}  // namespace gaitlab::report
