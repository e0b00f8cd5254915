#include "report/plot/pdf.h"

#include <fmt/format.h>

#include <charconv>
#include <iterator>

#include "core/recording/trace.h"
#include "report/plot/deflate.h"

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

/// String in PDF syntax: brackets and backslashes are escaped, bytes beyond ASCII are octal.
std::string literal(std::string_view bytes) {
  std::string text = "(";
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '(' || c == ')' || c == '\\') {
      text += '\\';
      text += c;
    } else if (byte < 0x20 || byte > 0x7E) {
      text += fmt::format("\\{:03o}", byte);
    } else {
      text += c;
    }
  }
  return text + ")";
}

std::string font_object(Font font) {
  const char* const names[] = {"Helvetica /Encoding /WinAnsiEncoding", "Helvetica-Bold /Encoding /WinAnsiEncoding", "Symbol"};
  return fmt::format("<< /Type /Font /Subtype /Type1 /BaseFont /{} >>", names[static_cast<std::size_t>(font)]);
}

}  // namespace

Pdf::Pdf(const Paper& paper) : paper_(paper) {
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
  const SetText set = set_in_helvetica(content, style.bold);
  missing_.insert(set.missing.begin(), set.missing.end());
  const double back = set.width * style.size * (style.anchor == Anchor::start ? 0 : style.anchor == Anchor::middle ? 0.5 : 1);
  const Point start = style.upwards ? Point{where.x, where.y + back} : Point{where.x - back, where.y};
  // The text matrix turns letters upright, because y points downwards on the page.
  page_ += fmt::format("BT {}rg {} {} Tm", rgb(style.fill), style.upwards ? "0 -1 -1 0" : "1 0 0 -1", at(start));
  for (const TextRun& run : set.runs) {
    fonts_.insert(run.font);
    page_ += fmt::format(" /F{} {} Tf {} Tj", static_cast<int>(run.font) + 1, coordinate(style.size), literal(run.bytes));
  }
  page_ += " ET\n";
}

std::string Pdf::finish() const {
  const std::string packed = deflated(page_, kMostDeflated);
  const double scale = paper_.mm / kPoint;
  std::vector<std::string> objects{
      "<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>", "",
      fmt::format("<< /Length {} /Filter /FlateDecode >>\nstream\n", packed.size()) + packed + "\nendstream",
      "<< /Producer (gaitlab) >>"};
  std::string fonts;
  for (const Font font : fonts_) {
    objects.push_back(font_object(font));
    fonts += fmt::format(" /F{} {} 0 R", static_cast<int>(font) + 1, objects.size());
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
