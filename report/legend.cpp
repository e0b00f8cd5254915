#include "report/legend.h"

namespace gaitlab::report {

double draw_legend(Canvas* canvas, std::span<const LegendEntry> entries, double left, double right, double y,
                   double (*width)(std::string_view, double)) {
  constexpr double kSample = 38, kName = 46, kGap = 24;  // px: length of a line, start of its name, behind the name
  double x = left;
  for (const LegendEntry& entry : entries) {
    const double needed = kName + width(entry.name, 13) + kGap;
    if (x > left && x + needed > right) {
      x = left;
      y += kLegendLine;
    }
    if (canvas != nullptr) {
      canvas->line({x, y - 4.5}, {x + kSample, y - 4.5}, entry.style);
      canvas->text({x + kName, y}, entry.name);
    }
    x += needed;
  }
  return y;
}

}  // namespace gaitlab::report
