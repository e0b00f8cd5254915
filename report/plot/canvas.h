// Interface for drawing: shapes and text, independent of the file format.
#pragma once
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab::report {

/// A point. In a drawing it is in px with y downwards; in a side view it is in m, and y is the world's z.
struct Point {
  double x = 0, y = 0;
};
using Polygon = std::vector<Point>;  ///< closed: the last point is connected to the first

inline bool finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

/// Colours of Okabe and Ito, which people with any kind of colour vision can distinguish, and greys.
namespace colour {
inline constexpr std::string_view kBlue = "#0072B2", kVermillion = "#D55E00", kGreen = "#009E73", kOrange = "#E69F00",
                                  kSky = "#56B4E9", kPurple = "#CC79A7", kYellow = "#F0E442", kBlack = "#000000",
                                  kInk = "#333333", kGrey = "#999999", kPale = "#DDDDDD", kWhite = "#FFFFFF";
}  // namespace colour

struct Style {
  std::string_view stroke = "none", fill = "none";  ///< `#RRGGBB`
  double width = 1;                                 ///< px, width of the stroke
  std::string_view dash = {};                       ///< lengths of dashes and gaps, px, as SVG's stroke-dasharray: `8 3`
  bool stroke_below = false;  ///< true: the fill covers the inner half of the stroke, so that overlapping polygons show only
                              ///< their common outline
};

enum class Anchor { start, middle, end };

struct TextStyle {
  double size = 13;  ///< px
  Anchor anchor = Anchor::start;
  std::string_view fill = colour::kInk;
  bool bold = false;
  bool upwards = false;  ///< true: turned by a quarter, to be read from the right
};

/// Size of a sheet in px, and the size of a px in print.
struct Paper {
  double width = 0, height = 0;  ///< px
  double mm = 25.4 / 96;         ///< mm, size of a px
};

/// Interface for drawing a file. Points that are not finite are left out, and a polyline is broken there. Files contain no
/// dates and no random ids: the same calls produce the same bytes.
class Canvas {
 public:
  virtual ~Canvas() = default;
  virtual void line(Point a, Point b, const Style& style) = 0;
  virtual void rectangle(Point corner, double width, double height, const Style& style) = 0;
  virtual void circle(Point centre, double radius, const Style& style) = 0;
  virtual void polyline(std::span<const Point> points, const Style& style) = 0;
  /// Draws all polygons as one path. If polygons of the same orientation overlap, their union is filled.
  virtual void polygons(std::span<const Polygon> polygons, const Style& style) = 0;
  /// Draws a text whose baseline starts, is centred or ends at `at`. Invalid UTF-8 and control characters are replaced.
  virtual void text(Point at, std::string_view content, const TextStyle& style) = 0;
  void text(Point at, std::string_view content) { text(at, content, TextStyle()); }
  /// Content of the complete file.
  [[nodiscard]] virtual std::string finish() const = 0;
};

/// A coordinate as text for a file, with at most two decimals, no trailing zeros and no "-0".
std::string coordinate(double value);

/// Approximate width of `text` in a sans-serif font of `size` px, for layouts.
double text_width(std::string_view text, double size);

/// Largest font size in px, from `most` down to `least`, for which a bold text is at most `room` px wide.
double fitting_size(std::string_view text, double most, double least, double room);

/// Colour `#RRGGBB` at a share from 0 to 1 of a ramp between equally spaced colours (two or more).
using Rgb = std::array<int, 3>;
std::string ramp(std::span<const Rgb> colours, double share);

}  // namespace gaitlab::report
