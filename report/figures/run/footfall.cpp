#include "report/figures/run/footfall.h"

#include <fmt/format.h>

#include <algorithm>

namespace gaitlab::report {

namespace {

constexpr double kRow = 24, kBar = 12;  // px
constexpr double kGapSeen = 0.6;        // px: a foot that bounces within it looks as if it stood, and the file stays small

void draw_bars(Canvas& canvas, const Footfall& row, const Scale& x, double y) {
  const auto bar = [&](double from, double to) {
    if (to > from) canvas.rectangle({from, y - kBar / 2}, to - from, kBar, {.fill = colour::kInk});
  };
  double from = x.from;
  double to = x.from;
  for (const Stance& stance : row.stances) {
    const double begin = std::clamp(x(stance.from), x.from, x.to);
    const double end = std::clamp(x(stance.to), x.from, x.to);
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

void draw_footfalls(Canvas& canvas, const FootfallDiagram& diagram, const Ticks& time, const Scale& x, double top) {
  const std::vector<Footfall>& rows = diagram.rows;
  const double first = top + kFootfallHead;
  const double bottom = first + kRow * static_cast<double>(rows.size());
  if (!diagram.title.empty()) canvas.text({x.from, top + 18}, diagram.title, {.bold = true});
  if (!diagram.note.empty()) canvas.text({x.to + 8 + text_width("0.00", 13), top + 18}, diagram.note, {.anchor = Anchor::end});
  for (const double t : time.values()) canvas.line({x(t), first}, {x(t), bottom}, kGridLine);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double y = first + kRow * (static_cast<double>(i) + 0.5);
    canvas.text({x.from - 8, y + 4.5}, rows[i].name, {.size = diagram.name_size, .anchor = Anchor::end});
    draw_bars(canvas, rows[i], x, y);
    canvas.text({x.to + 8, y + 4.5}, fmt::format("{:.2f}", rows[i].duty_factor));
  }
  canvas.rectangle({x.from, first}, x.to - x.from, bottom - first, kAxisLine);
}

}  // namespace gaitlab::report
