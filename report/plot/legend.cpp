#include "report/plot/legend.h"

#include <algorithm>
#include <utility>

namespace gaitlab::report {

namespace {

constexpr double kNameSize = 13;   // px
constexpr double kToMiddle = 4.5;  // px, from the baseline up to the middle of a name

double entry_width(const LegendEntry& entry, const LegendLook& look) {
  return entry.wide + look.before + look.width(entry.name, kNameSize) + look.behind;
}

}  // namespace

LegendEntry line_entry(std::string name, const Style& style, double wide) {
  const auto draw = [style, wide](Canvas& canvas, Point middle) {
    canvas.line({middle.x - wide / 2, middle.y}, {middle.x + wide / 2, middle.y}, style);
  };
  return {std::move(name), draw, wide};
}

LegendEntry dot_entry(std::string name, const Style& style, double radius) {
  return {std::move(name), [style, radius](Canvas& canvas, Point middle) { canvas.circle(middle, radius, style); }};
}

LegendEntry box_entry(std::string name, const Style& style) {
  return {std::move(name), [style](Canvas& canvas, Point middle) {
            canvas.rectangle({middle.x - 6, middle.y - 6}, 12, 12, style);
          }};
}

double draw_legend(Canvas* canvas, std::span<const LegendEntry> entries, double left, double right, double y,
                   const LegendLook& look) {
  double x = left;
  for (const LegendEntry& entry : entries) {
    const double needed = entry_width(entry, look);
    if (x > left && x + needed > right) {
      x = left;
      y += kLegendLine;
    }
    if (canvas != nullptr) {
      entry.draw(*canvas, {x + entry.wide / 2, y - kToMiddle});
      canvas->text({x + entry.wide + look.before, y}, entry.name);
    }
    x += needed;
  }
  return y;
}

}  // namespace gaitlab::report
