#include "report/figures/run/footfall.h"

#include <fmt/format.h>

#include <algorithm>

namespace gaitlab::report {

namespace {

constexpr double kRow = 24, kBar = 12;  // px
// Longest gap that is closed, px, so that a bouncing foot appears to stand and the file stays small.
constexpr double kGapSeen = 0.6;

void draw_bars(Canvas& canvas, const Plot& plot, const PlotArea& area, const Footfall& row, std::size_t number) {
  const auto place = [&](double time) { return plot.at(time, static_cast<double>(number)); };
  const auto bar = [&](double from, double to) {
    if (to > from) canvas.rectangle({from, place(0).y - kBar / 2}, to - from, kBar, {.fill = colour::kInk});
  };
  double from = area.left;
  double to = area.left;
  for (const Stance& stance : row.stances) {
    const double begin = std::clamp(place(stance.from).x, area.left, area.right);
    const double end = std::clamp(place(stance.to).x, area.left, area.right);
    if (begin - to > kGapSeen) {
      bar(from, to);
      from = begin;
    }
    to = end;
  }
  bar(from, to);
}

}  // namespace

std::vector<Stance> stances(std::span<const double> time, std::span<const double> load, double threshold) {
  std::vector<Stance> found;
  bool standing = false;
  for (std::size_t k = 0; k + 1 < std::min(time.size(), load.size()); ++k) {
    const bool loaded = std::isfinite(load[k]) && load[k] > threshold;
    if (loaded && !standing) found.push_back({time[k], time[k]});
    if (loaded) found.back().to = time[k + 1];
    standing = loaded;
  }
  return found;
}

double duty_factor(const std::vector<Stance>& stances, double from, double to) {
  double sum = 0;
  for (const Stance& stance : stances) sum += std::max(0.0, std::min(stance.to, to) - std::max(stance.from, from));
  return to > from ? sum / (to - from) : 0;
}

double footfall_height(std::size_t rows) { return kFootfallHead + kRow * static_cast<double>(rows) + kFootfallFoot; }

void draw_footfalls(Canvas& canvas, const std::vector<Footfall>& rows, const Axis& time, const PlotArea& area) {
  std::vector<std::string> names;
  std::vector<std::string> duty;
  for (const Footfall& row : rows) {
    names.push_back(row.name);
    duty.push_back(fmt::format("{:.2f}", row.duty_factor));
  }
  const double right = area.right + 8 + text_width("0.00", kPrint.text);
  canvas.text({right, area.top - 12}, "duty factor", {.anchor = Anchor::end});
  Plot plot(canvas, area, time, {.ticks = row_ticks(names), .lines = TickLines::none}, kPrint);
  plot.right_axis({.ticks = row_ticks(duty), .lines = TickLines::none});
  plot.draw_axes();
  for (std::size_t i = 0; i < rows.size(); ++i) draw_bars(canvas, plot, area, rows[i], i);
}

}  // namespace gaitlab::report
