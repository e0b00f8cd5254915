// A small SVG writer: shapes and text in, a file's text out.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab::report {

/// In a drawing: px, y down. In a side view: m, y stands for the world's z, up.
struct Point {
  double x = 0, y = 0;
};
using Polygon = std::vector<Point>;  ///< closed: the last point is joined to the first

/// Colours of Okabe and Ito, told apart with every kind of colour vision, and greys.
namespace colour {
inline constexpr std::string_view kBlue = "#0072B2", kVermillion = "#D55E00", kGreen = "#009E73", kOrange = "#E69F00",
                                  kSky = "#56B4E9", kPurple = "#CC79A7", kYellow = "#F0E442", kBlack = "#000000",
                                  kInk = "#333333", kGrey = "#999999", kPale = "#DDDDDD", kWhite = "#FFFFFF";
}  // namespace colour

struct Style {
  std::string_view stroke = "none", fill = "none";
  double width = 1;            ///< of the stroke, px
  std::string_view dash = {};  ///< SVG stroke-dasharray
  bool stroke_below = false;   ///< fill over stroke, so that overlapping polygons show their common outline only
};

enum class Anchor { start, middle, end };

struct TextStyle {
  double size = 13;  ///< px
  Anchor anchor = Anchor::start;
  std::string_view fill = colour::kInk;
  bool bold = false;
  bool upwards = false;  ///< turned a quarter, to be read from the right
};

/// Collects shapes on a white ground; coordinates in px with at most two decimals. Points that are not finite are left out, and
/// a polyline is broken there. No clock, no random ids: the same calls, the same bytes.
class Svg {
 public:
  Svg(double width, double height);
  void line(Point a, Point b, const Style& style);
  void rectangle(Point corner, double width, double height, const Style& style);
  void circle(Point centre, double radius, const Style& style);
  void polyline(std::span<const Point> points, const Style& style);
  /// One path; where polygons of the same sense overlap, their union is filled.
  void polygons(std::span<const Polygon> polygons, const Style& style);
  /// Baseline at `at`; `content` is any text, invalid UTF-8 and control characters are replaced.
  void text(Point at, std::string_view content, const TextStyle& style = {});
  /// The whole file, a valid XML document.
  [[nodiscard]] std::string finish() const;

 private:
  double width_, height_;
  std::string body_;
};

/// `text` for XML content and attributes.
std::string xml_escaped(std::string_view text);

/// A rough width of `text` in a sans-serif font of `size` px, for layouts.
double text_width(std::string_view text, double size);

}  // namespace gaitlab::report
