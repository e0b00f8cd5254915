// Writer of a drawing as SVG.
#pragma once
#include "report/plot/canvas.h"

namespace gaitlab::report {

/// SVG writer with a white background. Coordinates are in px with at most two decimals. The file is a valid XML document. Its
/// title is the name of the picture for programs that read it aloud; without a title it has no role.
class Svg final : public Canvas {
 public:
  /// Drawing for the screen, whose size is in px, with any sans-serif font.
  Svg(double width, double height, std::string_view title = {});
  /// Drawing for print, whose size is in mm, with Helvetica or a font of the same widths.
  explicit Svg(const Paper& paper, std::string_view title = {});
  void line(Point a, Point b, const Style& style) override;
  void rectangle(Point corner, double width, double height, const Style& style) override;
  void circle(Point centre, double radius, const Style& style) override;
  void polyline(std::span<const Point> points, const Style& style) override;
  void polygons(std::span<const Polygon> polygons, const Style& style) override;
  using Canvas::text;
  void text(Point at, std::string_view content, const TextStyle& style) override;
  [[nodiscard]] std::string finish() const override;

 private:
  std::string head_, body_;
};

/// `text` for XML content and attributes, with reserved characters replaced.
std::string xml_escaped(std::string_view text);

}  // namespace gaitlab::report
