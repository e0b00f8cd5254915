#include "report/plot/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "report/plot/characters.h"

namespace gaitlab::report {

namespace {

std::string pair(Point p) { return coordinate(p.x) + "," + coordinate(p.y); }

std::string attributes(const Style& style) {
  std::string text = fmt::format(" fill=\"{}\"", style.fill);
  if (style.stroke == "none") return text;
  text += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", style.stroke, coordinate(style.width));
  if (!style.dash.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", style.dash);
  if (style.stroke_below) text += " paint-order=\"stroke\"";
  return text;
}

// Replacement of a character that XML does not allow. White space becomes a blank.
std::string_view replacement(char c) { return c == '\t' || c == '\n' || c == '\r' ? " " : "\xEF\xBF\xBD"; }

// Entity for the ASCII character at the start of `text`.
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
    const std::size_t length = first_character(text).length;
    escaped += length == 0 ? replacement(text.front()) : length == 1 ? entity(text) : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return escaped;
}

namespace {

// Start of a file for a drawing of this size in px. `size` is the displayed size in any unit.
std::string head(double width, double height, const std::string& size, const char* font, std::string_view title) {
  const std::string name = title.empty() ? "" : "<title>" + xml_escaped(title) + "</title>\n";
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
             "<svg xmlns=\"http://www.w3.org/2000/svg\" {} viewBox=\"0 0 {} {}\"{} font-family=\"{}\">\n",
             size, coordinate(width), coordinate(height), title.empty() ? "" : " role=\"img\"", font) +
         name;
}

}  // namespace

Svg::Svg(double width, double height, std::string_view title)
    : head_(head(width, height, fmt::format("width=\"{}\" height=\"{}\"", coordinate(width), coordinate(height)), "sans-serif",
                 title)) {
  rectangle({0, 0}, width, height, {.fill = colour::kWhite});
}

Svg::Svg(const Paper& paper, std::string_view title)
    : head_(head(paper.width, paper.height,
                 fmt::format("width=\"{}mm\" height=\"{}mm\"", coordinate(paper.width * paper.mm),
                             coordinate(paper.height * paper.mm)),
                 "Helvetica, Arial, 'Liberation Sans', sans-serif", title)) {
  rectangle({0, 0}, paper.width, paper.height, {.fill = colour::kWhite});
}

void Svg::line(Point a, Point b, const Style& style) {
  if (!finite(a) || !finite(b)) return;
  fmt::format_to(std::back_inserter(body_), "<path d=\"M{}L{}\"{}/>\n", pair(a), pair(b), attributes(style));
}

void Svg::rectangle(Point corner, double width, double height, const Style& style) {
  fmt::format_to(std::back_inserter(body_), "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>\n", coordinate(corner.x),
                 coordinate(corner.y), coordinate(width), coordinate(height), attributes(style));
}

void Svg::circle(Point centre, double radius, const Style& style) {
  if (!finite(centre)) return;
  fmt::format_to(std::back_inserter(body_), "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n", coordinate(centre.x),
                 coordinate(centre.y), coordinate(radius), attributes(style));
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
  if (style.upwards) extra += fmt::format(" transform=\"rotate(-90 {} {})\"", coordinate(at.x), coordinate(at.y));
  fmt::format_to(std::back_inserter(body_), "<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"{}>{}</text>\n",
                 coordinate(at.x), coordinate(at.y), coordinate(style.size), style.fill, extra, xml_escaped(content));
}

std::string Svg::finish() const { return head_ + body_ + "</svg>\n"; }

}  // namespace gaitlab::report
