#include "report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gaitlab::report {

namespace {

// At most two decimals, no trailing zeros, no "-0".
std::string number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

bool finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::string pair(Point p) { return number(p.x) + "," + number(p.y); }

std::string attributes(const Style& style) {
  std::string text = fmt::format(" fill=\"{}\"", style.fill);
  if (style.stroke == "none") return text;
  text += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", style.stroke, number(style.width));
  if (!style.dash.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", style.dash);
  if (style.stroke_below) text += " paint-order=\"stroke\"";
  return text;
}

// Length of the UTF-8 sequence that starts `text`; 0 if it is none or XML forbids the character.
std::size_t character(std::string_view text) {
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = at(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  const std::size_t length = first >= 0xF0 && first <= 0xF4  ? 4
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xC2 && first < 0xE0 ? 2
                                                             : 0;
  if (length == 0 || length > text.size()) return 0;
  unsigned code = first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((at(i) & 0xC0U) != 0x80U) return 0;
    code = code << 6 | (at(i) & 0x3FU);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool forbidden = (code >= 0xD800 && code < 0xE000) || code == 0xFFFE || code == 0xFFFF || code > 0x10FFFF;
  return overlong || forbidden ? 0 : length;
}

// For a character that cannot stand in XML: white space stays white space.
std::string_view replacement(char c) { return c == '\t' || c == '\n' || c == '\r' ? " " : "\xEF\xBF\xBD"; }

// For the ASCII character that starts `text`.
std::string_view entity(std::string_view text) {
  switch (text.front()) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return text.substr(0, 1);
  }
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  while (!text.empty()) {
    const std::size_t length = character(text);
    escaped += length == 0 ? replacement(text.front()) : length == 1 ? entity(text) : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return escaped;
}

double text_width(std::string_view text, double size) {
  const auto starts =
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  return 0.56 * size * static_cast<double>(starts);
}

Svg::Svg(double width, double height) : width_(width), height_(height) {
  rectangle({0, 0}, width, height, {.fill = colour::kWhite});
}

void Svg::line(Point a, Point b, const Style& style) {
  if (!finite(a) || !finite(b)) return;
  fmt::format_to(std::back_inserter(body_), "<path d=\"M{}L{}\"{}/>\n", pair(a), pair(b), attributes(style));
}

void Svg::rectangle(Point corner, double width, double height, const Style& style) {
  fmt::format_to(std::back_inserter(body_), "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>\n", number(corner.x),
                 number(corner.y), number(width), number(height), attributes(style));
}

void Svg::circle(Point centre, double radius, const Style& style) {
  if (!finite(centre)) return;
  fmt::format_to(std::back_inserter(body_), "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n", number(centre.x), number(centre.y),
                 number(radius), attributes(style));
}

void Svg::polyline(std::span<const Point> points, const Style& style) {
  std::string path;
  bool pen_down = false;
  for (const Point& point : points) {
    if (finite(point)) path += (pen_down ? " " : "M") + pair(point);
    pen_down = finite(point);
  }
  if (path.empty()) return;
  fmt::format_to(std::back_inserter(body_), "<path d=\"{}\"{} stroke-linejoin=\"round\"/>\n", path, attributes(style));
}

void Svg::polygons(std::span<const Polygon> polygons, const Style& style) {
  std::string path;
  for (const Polygon& polygon : polygons) {
    bool pen_down = false;
    for (const Point& point : polygon) {
      if (!finite(point)) continue;
      path += (pen_down ? " " : "M") + pair(point);
      pen_down = true;
    }
    if (pen_down) path += 'Z';
  }
  if (path.empty()) return;
  fmt::format_to(std::back_inserter(body_), "<path d=\"{}\"{} stroke-linejoin=\"round\"/>\n", path, attributes(style));
}

void Svg::text(Point at, std::string_view content, const TextStyle& style) {
  if (!finite(at)) return;
  std::string extra;
  if (style.anchor != Anchor::start)
    extra += style.anchor == Anchor::middle ? " text-anchor=\"middle\"" : " text-anchor=\"end\"";
  if (style.bold) extra += " font-weight=\"bold\"";
  if (style.upwards) extra += fmt::format(" transform=\"rotate(-90 {} {})\"", number(at.x), number(at.y));
  fmt::format_to(std::back_inserter(body_), "<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"{}>{}</text>\n", number(at.x),
                 number(at.y), number(style.size), style.fill, extra, xml_escaped(content));
}

std::string Svg::finish() const {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\">\n"
      "{2}</svg>\n",
      number(width_), number(height_), body_);
}

}  // namespace gaitlab::report
