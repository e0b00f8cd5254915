// Writer of a drawing as PDF 1.4 with one page of vectors and text.
#pragma once
#include <set>

#include "report/plot/canvas.h"
#include "report/plot/helvetica.h"

namespace gaitlab::report {

/// PDF writer. The same calls produce the same picture as with Svg: one matrix converts px to pt, and all coordinates are in
/// px. Text is in Helvetica and Symbol, which are not embedded. The file contains no date, and its /ID is a hash of the page.
/// The page is compressed by zlib, so that another version of zlib may write other bytes for the same content.
class Pdf final : public Canvas {
 public:
  explicit Pdf(const Paper& paper);
  void line(Point a, Point b, const Style& style) override;
  void rectangle(Point corner, double width, double height, const Style& style) override;
  void circle(Point centre, double radius, const Style& style) override;
  void polyline(std::span<const Point> points, const Style& style) override;
  void polygons(std::span<const Polygon> polygons, const Style& style) override;
  using Canvas::text;
  void text(Point at, std::string_view content, const TextStyle& style) override;
  /// Throws RunError if there is no memory for zlib.
  [[nodiscard]] std::string finish() const override;

  /// Characters that were replaced by `?` because the fonts do not have them.
  [[nodiscard]] const std::set<char32_t>& missing() const { return missing_; }

 private:
  void paint(const std::string& path, const Style& style, bool round);

  Paper paper_;
  std::string page_;
  std::set<char32_t> missing_;
  std::set<Font> fonts_;
};

}  // namespace gaitlab::report
