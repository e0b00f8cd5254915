#include "report/plot/legend.h"

namespace gaitlab::report {

double draw_legend(Canvas* canvas, std::span<const LegendEntry> entries, double left, double right, double y,
                   const LegendLook& look) {
  double x = left;
  for (const LegendEntry& entry : entries) {
    const double needed = look.name + look.width(entry.name, 13) + look.gap;
    if (x > left && x + needed > right) {
      x = left;
      y += kLegendLine;
    }
    if (canvas != nullptr) {
      canvas->line({x, y - 4.5}, {x + look.sample, y - 4.5}, entry.style);
      canvas->text({x + look.name, y}, entry.name);
    }
    x += needed;
  }
  return y;
}

}  // namespace gaitlab::report
