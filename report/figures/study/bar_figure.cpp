#include "report/figures/study/bar_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/figures/study/study_sheet.h"
#include "report/plot/panel.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kMostRows = 200;
constexpr double kBarHigh = 13, kRowGap = 12;  // px
constexpr std::array<std::string_view, 3> kBarFills{colour::kBlue, "#9CC8E8", colour::kPale};
constexpr Style kWhisker{.stroke = colour::kInk, .width = 1.3};

void draw_bar(Canvas& canvas, const Bar& bar, const Scale& x, double top, std::string_view fill) {
  if (!std::isfinite(bar.value)) return;
  const double from = x(0);
  const double to = x(bar.value);
  canvas.rectangle({std::min(from, to), top + 1}, std::abs(to - from), kBarHigh - 2, {.fill = fill});
  if (!std::isfinite(bar.low) || !std::isfinite(bar.high)) return;
  const double middle = top + kBarHigh / 2;
  const double low = x(bar.low);
  const double high = x(bar.high);
  canvas.line({low, middle}, {high, middle}, kWhisker);
  for (const double end : {low, high}) canvas.line({end, middle - 3}, {end, middle + 3}, kWhisker);
}

}  // namespace

std::string bar_svg(const BarFigure& figure) {
  const std::size_t rows = std::min(figure.rows.size(), kMostRows);
  Bounds range;
  range.add(0);
  double names = 60;
  for (std::size_t k = 0; k < rows; ++k) {
    names = std::max(names, text_width(shortened(figure.rows[k].name), 12));
    for (const Bar& bar : figure.rows[k].bars) {
      for (const double value : {bar.value, bar.low, bar.high}) range.add(value);
    }
  }
  const double row_high = kBarHigh * static_cast<double>(figure.kinds.size()) + kRowGap;
  const double bottom = kSheetTop + row_high * static_cast<double>(std::max<std::size_t>(rows, 1));
  Svg svg(kSheetWidth, bottom + 126);
  const PlotArea area{names + 36, kSheetWidth - 40, kSheetTop, bottom};
  draw_sheet_title(svg, figure.title);
  const Ticks ticks = range.lo < range.hi ? range.ticks(7) : ticks_around(0, 1, 5);
  AxisMarks marks{ticks.lo, ticks.hi, {}};
  for (const double value : ticks.values()) marks.labels.emplace_back(value, with_minus(ticks.label(value)));
  draw_frame(svg, area, marks, {});
  const Scale x_of{ticks.lo, ticks.hi, area.left, area.right};
  svg.text({(area.left + area.right) / 2, area.bottom + 38}, figure.axis, {.anchor = Anchor::middle});
  for (std::size_t k = 0; k < rows; ++k) {
    const double top = area.top + row_high * static_cast<double>(k) + kRowGap / 2;
    svg.text({area.left - 10, top + (row_high - kRowGap) / 2 + 4}, shortened(figure.rows[k].name),
             {.size = 12, .anchor = Anchor::end});
    for (std::size_t b = 0; b < figure.rows[k].bars.size(); ++b)
      draw_bar(svg, figure.rows[k].bars[b], x_of, top + kBarHigh * static_cast<double>(b), kBarFills[b % kBarFills.size()]);
  }
  svg.line({x_of(0), area.top}, {x_of(0), area.bottom}, kAxisLine);
  double x = area.left;
  const double y = bottom + 66;
  for (std::size_t b = 0; b < figure.kinds.size(); ++b) {
    svg.rectangle({x, y - 10}, 18, 11, {.fill = kBarFills[b % kBarFills.size()]});
    svg.text({x + 24, y}, figure.kinds[b]);
    x += 48 + text_width(figure.kinds[b], 13);
  }
  svg.line({x, y - 4.5}, {x + 24, y - 4.5}, kWhisker);
  for (const double end : {x, x + 24}) svg.line({end, y - 8}, {end, y - 1}, kWhisker);
  svg.text({x + 30, y}, "95 %");
  draw_sheet_note(svg, figure.note, bottom + 112);
  return svg.finish();
}

}  // namespace gaitlab::report
