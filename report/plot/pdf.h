// Writer of a drawing as PDF 1.4 with one page of vectors and text.
#pragma once
#include <map>
#include <set>

#include "report/plot/canvas.h"
#include "report/plot/pdf_font.h"

namespace gaitlab::report {

/// PDF writer. The same calls produce the same picture as with Svg: one matrix converts px to pt, and all coordinates are in
/// px. The fonts of the text are embedded. The file contains no date, and its /ID is a hash of the page. Page and fonts are
/// compressed by zlib, so that another version of zlib may write other bytes for the same content.
class Pdf final : public Canvas {
 public:
  /// `title` is the document's title, in UTF-8.
  explicit Pdf(const Paper& paper, std::string_view title = {});
  void line(Point a, Point b, const Style& style) override;
  void rectangle(Point corner, double width, double height, const Style& style) override;
  void circle(Point centre, double radius, const Style& style) override;
  void polyline(std::span<const Point> points, const Style& style) override;
  void polygons(std::span<const Polygon> polygons, const Style& style) override;
  using Canvas::text;
  void text(Point at, std::string_view content, const TextStyle& style) override;
  /// Throws std::bad_alloc if there is no memory for zlib.
  [[nodiscard]] std::string finish() const override;

  /// Characters that were replaced by `?` because the font does not have them.
  [[nodiscard]] const std::set<char32_t>& missing() const { return missing_; }

 private:
  void paint(const std::string& path, const Style& style, bool round);

  Paper paper_;
  std::string title_, page_;
  std::set<char32_t> missing_;
  std::map<Face, UsedGlyphs> fonts_;
};

}  // namespace gaitlab::report
