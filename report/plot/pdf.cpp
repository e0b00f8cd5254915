#include "report/plot/pdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <utility>

#include "core/recording/trace.h"
#include "report/plot/characters.h"

namespace gaitlab::report {

namespace {

constexpr double kPoint = 25.4 / 72;           // mm, size of a pt
constexpr double kQuarter = 0.55228474983079;  // 4/3 (sqrt(2) - 1), for a quarter of a circle as a Bezier curve

std::string at(Point p) { return coordinate(p.x) + " " + coordinate(p.y); }

/// Colour `#RRGGBB` as three numbers from 0 to 1 in PDF syntax.
std::string rgb(std::string_view colour) {
  std::string text;
  for (std::size_t i = 1; i < 7; i += 2) {
    unsigned value = 0;
    std::from_chars(colour.data() + i, colour.data() + i + 2, value, 16);
    text += fmt::format("{:.3g} ", value / 255.0);
  }
  return text;
}

/// Text string in PDF syntax, in UTF-16 with a byte order mark, as hexadecimal digits.
std::string text_string(std::string_view text) {
  std::string digits = "<FEFF";
  while (!text.empty()) {
    const Character character = first_character(text);
    const auto code = static_cast<std::uint32_t>(character.length > 0 ? character.code : U'\uFFFD');
    constexpr std::uint32_t kBasic = 0x10000;
    if (code < kBasic) {
      digits += fmt::format("{:04X}", code);
    } else {
      digits += fmt::format("{:04X}{:04X}", 0xD800 + ((code - kBasic) >> 10U), 0xDC00 + ((code - kBasic) & 0x3FFU));
    }
    text.remove_prefix(std::max<std::size_t>(1, character.length));
  }
  return digits + ">";
}

}  // namespace

Pdf::Pdf(const Paper& paper, std::string_view title) : paper_(paper), title_(title) {
  const double scale = paper.mm / kPoint;
  // Converts px with y downwards to pt with y upwards.
  page_ = fmt::format("{0:.8f} 0 0 -{0:.8f} 0 {1:.4f} cm\n", scale, paper.height * scale);
  rectangle({0, 0}, paper.width, paper.height, {.fill = colour::kWhite});
}

void Pdf::paint(const std::string& path, const Style& style, bool round) {
  const bool strokes = style.stroke != "none";
  const bool fills = style.fill != "none";
  if (path.empty() || (!strokes && !fills)) return;
  page_ += "q ";
  if (fills) page_ += rgb(style.fill) + "rg ";
  if (strokes) {
    page_ += rgb(style.stroke) + "RG " + coordinate(style.width) + " w ";
    if (!style.dash.empty()) page_ += fmt::format("[{}] 0 d ", style.dash);
    if (round) page_ += "1 j ";
  }
  if (strokes && fills && style.stroke_below) {
    page_ += path + "S\n" + path + "f Q\n";
  } else {
    page_ += path + (strokes && fills ? "B" : strokes ? "S" : "f") + " Q\n";
  }
}

void Pdf::line(Point a, Point b, const Style& style) {
  if (finite(a) && finite(b)) paint(at(a) + " m " + at(b) + " l ", style, false);
}

void Pdf::rectangle(Point corner, double width, double height, const Style& style) {
  paint(at(corner) + " " + coordinate(width) + " " + coordinate(height) + " re ", style, false);
}

void Pdf::circle(Point centre, double radius, const Style& style) {
  if (!finite(centre)) return;
  const double k = kQuarter * radius;
  const auto [x, y] = centre;
  std::string path = at({x + radius, y}) + " m ";
  const auto curve = [&](Point a, Point b, Point c) { path += at(a) + " " + at(b) + " " + at(c) + " c "; };
  curve({x + radius, y + k}, {x + k, y + radius}, {x, y + radius});
  curve({x - k, y + radius}, {x - radius, y + k}, {x - radius, y});
  curve({x - radius, y - k}, {x - k, y - radius}, {x, y - radius});
  curve({x + k, y - radius}, {x + radius, y - k}, {x + radius, y});
  paint(path + "h ", style, false);
}

void Pdf::polyline(std::span<const Point> points, const Style& style) {
  std::string path;
  bool pen_down = false;
  for (const Point& point : points) {
    if (finite(point)) path += at(point) + (pen_down ? " l\n" : " m ");
    pen_down = finite(point);
  }
  paint(path, style, true);
}

void Pdf::polygons(std::span<const Polygon> polygons, const Style& style) {
  std::string path;
  for (const Polygon& polygon : polygons) {
    bool pen_down = false;
    for (const Point& point : polygon) {
      if (!finite(point)) continue;
      path += at(point) + (pen_down ? " l\n" : " m ");
      pen_down = true;
    }
    if (pen_down) path += "h ";
  }
  paint(path, style, true);
}

void Pdf::text(Point where, std::string_view content, const TextStyle& style) {
  if (!finite(where) || content.empty()) return;
  const Face face = style.bold ? Face::bold : Face::regular;
  const SetText set = set_text(content, face);
  missing_.insert(set.missing.begin(), set.missing.end());
  const double back = set.width * style.size * (style.anchor == Anchor::start ? 0 : style.anchor == Anchor::middle ? 0.5 : 1);
  const Point start = style.upwards ? Point{where.x, where.y + back} : Point{where.x - back, where.y};
  UsedGlyphs& used = fonts_[face];
  std::string glyphs;
  for (const auto& [glyph, code] : set.letters) {
    const auto entry = used.try_emplace(glyph, code).first;
    entry->second = std::min(entry->second, code);
    fmt::format_to(std::back_inserter(glyphs), "{:04X}", glyph);
  }
  // The text matrix turns letters upright, because y points downwards on the page.
  page_ += fmt::format("BT {}rg {} {} Tm /F{} {} Tf <{}> Tj ET\n", rgb(style.fill), style.upwards ? "0 -1 -1 0" : "1 0 0 -1",
                       at(start), static_cast<int>(face) + 1, coordinate(style.size), glyphs);
}

std::string Pdf::finish() const {
  const double scale = paper_.mm / kPoint;
  std::vector<std::string> objects{
      "<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>", "", pdf_stream(page_),
      fmt::format("<< /Producer (gaitlab){} >>", title_.empty() ? "" : " /Title " + text_string(title_))};
  std::string fonts;
  for (const auto& [face, used] : fonts_) {
    const std::size_t number = objects.size() + 1;
    fonts += fmt::format(" /F{} {} 0 R", static_cast<int>(face) + 1, number);
    for (std::string& object : pdf_font(face, used, number)) objects.push_back(std::move(object));
  }
  objects[2] =
      fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {} {}] /Contents 4 0 R\n/Resources << /Font <<{} >> >> >>",
                  coordinate(paper_.width * scale), coordinate(paper_.height * scale), fonts);
  std::string file = "%PDF-1.4\n%\xE2\xE3\xCF\xD3\n";  // bytes above 127 mark the file as binary
  std::string references = fmt::format("xref\n0 {}\n0000000000 65535 f \n", objects.size() + 1);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    fmt::format_to(std::back_inserter(references), "{:010} 00000 n \n", file.size());
    fmt::format_to(std::back_inserter(file), "{} 0 obj\n", i + 1);
    file += objects[i] + "\nendobj\n";
  }
  const std::size_t start = file.size();
  const std::string id = hash(page_) + hash_words(page_);
  file += references;
  fmt::format_to(std::back_inserter(file),
                 "trailer\n<< /Size {} /Root 1 0 R /Info 5 0 R /ID [<{}> <{}>] >>\nstartxref\n{}\n%%EOF\n", objects.size() + 1,
                 id, id, start);
  return file;
}

}  // namespace gaitlab::report
