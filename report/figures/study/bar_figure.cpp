#include "report/figures/study/bar_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "report/figures/study/study_sheet.h"
#include "report/plot/legend.h"
#include "report/plot/plot.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kMostRows = 200;
constexpr double kBarHigh = 13, kRowGap = 12;  // px
constexpr double kRemark = 11;                 // px, size of remarks
constexpr std::array<std::string_view, 3> kBarFills{colour::kBlue, "#9CC8E8", colour::kPale};
constexpr Style kWhisker{.stroke = colour::kInk, .width = 1.3};

void draw_whisker(Canvas& canvas, double low, double high, double y) {
  canvas.line({low, y}, {high, y}, kWhisker);
  for (const double end : {low, high}) canvas.line({end, y - 3}, {end, y + 3}, kWhisker);
}

void draw_bar(Canvas& canvas, const Plot& plot, const Bar& bar, double top, std::string_view fill) {
  if (!std::isfinite(bar.value)) return;
  const auto x = [&](double value) { return plot.at(value, 0).x; };
  canvas.rectangle({std::min(x(0), x(bar.value)), top + 1}, std::abs(x(bar.value) - x(0)), kBarHigh - 2, {.fill = fill});
  if (std::isfinite(bar.low) && std::isfinite(bar.high)) draw_whisker(canvas, x(bar.low), x(bar.high), top + kBarHigh / 2);
}

Bounds bounds_of(std::span<const BarRow> rows) {
  Bounds range;
  range.add(0);
  for (const BarRow& row : rows) {
    for (const Bar& bar : row.bars) {
      for (const double value : {bar.value, bar.low, bar.high}) range.add(value);
    }
  }
  return range;
}

void draw_legend_of_bars(Canvas& canvas, const BarFigure& figure, double left, double y) {
  std::vector<LegendEntry> entries;
  for (std::size_t b = 0; b < figure.kinds.size(); ++b)
    entries.push_back(box_entry(figure.kinds[b], {.fill = kBarFills[b % kBarFills.size()]}));
  const auto whisker = [](Canvas& on, Point middle) { draw_whisker(on, middle.x - 12, middle.x + 12, middle.y); };
  entries.push_back({"95 %", whisker, 24});
  draw_legend(&canvas, entries, left, kSheetWidth, y);
}

}  // namespace

std::string bar_svg(const BarFigure& figure) {
  const auto rows = std::span(figure.rows).first(std::min(figure.rows.size(), kMostRows));
  std::vector<std::string> names;
  for (const BarRow& row : rows) names.push_back(shortened(row.name));
  const Axis left{.ticks = row_ticks(names), .lines = TickLines::none};
  const double row_high = kBarHigh * static_cast<double>(figure.kinds.size()) + kRowGap;
  const double bottom = kSheetTop + row_high * static_cast<double>(std::max<std::size_t>(rows.size(), 1));
  double remarks = 0;
  for (const BarRow& row : rows) remarks = std::max(remarks, text_width(row.remark, kRemark));
  const PlotArea area{std::max(60.0, widest_text(left.ticks, 12)) + 36, kSheetWidth - 40 - remarks, kSheetTop, bottom};
  const Bounds range = bounds_of(rows);
  Svg svg(kSheetWidth, bottom + 126, figure.title);
  draw_sheet_title(svg, figure.title);
  const Ticks across = range.lo < range.hi ? ticks_around(range, 7) : ticks_around(0, 1, 5);
  const Plot plot(svg, area, {.ticks = across, .title = figure.axis}, left, {.text = 12});
  plot.draw_axes();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double top = area.top + row_high * static_cast<double>(k) + kRowGap / 2;
    for (std::size_t b = 0; b < rows[k].bars.size(); ++b)
      draw_bar(svg, plot, rows[k].bars[b], top + kBarHigh * static_cast<double>(b), kBarFills[b % kBarFills.size()]);
  }
  plot.moment(0, kAxisLine);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double middle = area.top + row_high * (static_cast<double>(k) + 0.5);
    svg.text({area.right + 10, middle + 4}, rows[k].remark, {.size = kRemark, .fill = colour::kVermillion});
  }
  draw_legend_of_bars(svg, figure, area.left, bottom + 66);
  draw_sheet_note(svg, figure.note, bottom + 112);
  return svg.finish();
}

}  // namespace gaitlab::report
