// Figure of parallel coordinates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "report/figures/study/many_axes.h"
#include "report/figures/study/many_figure.h"
#include "report/figures/study/study_sheet.h"
#include "report/plot/legend.h"
#include "report/plot/plot.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kMostAxes = 16;
constexpr double kParallelHeight = 600;               // px
constexpr PlotArea kParallelPlot{70, 670, 124, 470};  // px
constexpr std::string_view kUnfit = "#CFCFCF";
constexpr double kTip = 4;  // px, half the width of an arrow for a value beyond the axis
constexpr Bins kLevelsOfAxis{0, 1, 32};

class Parallel {
 public:
  explicit Parallel(const ManyFigure& figure)
      : f_(figure),
        svg_(kSheetWidth, kParallelHeight, figure.title),
        axes_(std::min(figure.axes.size(), kMostAxes)),
        range_(colour_range(figure)),
        all_(value_range(figure)) {
    const int count = axes_ > 8 ? 4 : 6;
    for (std::size_t k = 0; k < axes_; ++k) ticks_.push_back(parameter_ticks(f_, k, count));
    ticks_.push_back(ticks_over(all_, false, count));
  }

  std::string drawn() {
    draw_sheet_title(svg_, f_.title);
    const bool histogram = f_.points.size() * axes_ > kMostMarks;
    if (histogram) {
      stretches();
    } else {
      lines();
    }
    for (std::size_t k = 0; k < axes_; ++k) axis(k);
    value_axis();
    for (std::size_t k = 0; k <= axes_; ++k) name(k);
    legend();
    std::string note = f_.note;
    if (f_.axes.size() > axes_) note = fmt::format("the first {} of {} parameters; {}", axes_, f_.axes.size(), note);
    if (histogram) note = "width by the number of points, colour by the mean of the kept points; " + note;
    draw_sheet_note(svg_, note, kParallelHeight - 14);
    return svg_.finish();
  }

 private:
  [[nodiscard]] double across(std::size_t k) const {
    return kParallelPlot.left +
           (kParallelPlot.right - kParallelPlot.left) * static_cast<double>(k) / static_cast<double>(axes_);
  }
  [[nodiscard]] static double up(double share) {
    return kParallelPlot.bottom - share * (kParallelPlot.bottom - kParallelPlot.top);
  }
  /// Position of a point on an axis, from 0 to 1.
  [[nodiscard]] double share(const ManyPoint& p, std::size_t k) const {
    const double at = k < axes_ ? place_on(f_.axes[k], p.at[k]) : p.value;
    return (at - ticks_[k].lo) / (ticks_[k].hi - ticks_[k].lo);
  }

  void line(const ManyPoint& p, const Style& style) {
    std::vector<Point> points;
    const bool valued = p.state != PointState::failed && std::isfinite(p.value);
    for (std::size_t k = 0; k < axes_ + (valued ? 1U : 0U); ++k) points.push_back({across(k), up(share(p, k))});
    const bool beyond = valued && all_.beyond(p.value);
    if (beyond) points.back().y = up(p.value > all_.hi ? 1 : 0);
    svg_.polyline(points, style);
    if (!beyond) return;
    const bool above = p.value > all_.hi;
    draw_arrow(svg_, {points.back().x, points.back().y + (above ? -2 * kTip : 2 * kTip)}, above, {.fill = style.stroke}, kTip);
  }

  /// Draws points that are not kept first, then the others from the palest to the darkest, and the best one last.
  void lines() {
    std::vector<std::size_t> order(f_.points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto rank = [&](std::size_t k) {
      const ManyPoint& p = f_.points[k];
      const bool fit = p.state == PointState::kept && std::isfinite(p.value);
      return fit ? std::pair{1, p.value} : std::pair{0, 0.0};
    };
    std::ranges::stable_sort(order, {}, rank);
    constexpr double kFewLines = 40;  // more lines are thinner, so that they cover about the same area
    const double thin = std::sqrt(kFewLines / std::max(kFewLines, static_cast<double>(f_.points.size())));
    for (const std::size_t k : order) {
      const ManyPoint& p = f_.points[k];
      const bool fit = rank(k).first == 1;
      const std::string colour = fit ? shade(range_.share(p.value)) : std::string(kUnfit);
      line(p, {.stroke = colour, .width = std::max(0.4, (fit ? 1.5 : 0.7) * thin)});
    }
    best();
  }

  void best() {
    if (!f_.marks_best()) return;
    line(f_.points[f_.best], {.stroke = colour::kWhite, .width = 5});
    line(f_.points[f_.best], {.stroke = colour::kBlack, .width = 2.4});
  }

  /// Points whose lines have the same two levels on neighbouring axes.
  struct Stretch {
    std::size_t points = 0, fit = 0;
    double sum = 0;
  };
  using Stretches = std::map<std::pair<std::size_t, std::size_t>, Stretch>;

  [[nodiscard]] Stretches stretches_behind(std::size_t k) const {
    Stretches found;
    for (const ManyPoint& p : f_.points) {
      const bool valued = p.state != PointState::failed && std::isfinite(p.value);
      if (k + 1 == axes_ && (!valued || all_.beyond(p.value))) continue;
      Stretch& one = found[{kLevelsOfAxis.of(share(p, k)), kLevelsOfAxis.of(share(p, k + 1))}];
      ++one.points;
      if (p.state != PointState::kept || !valued) continue;
      ++one.fit;
      one.sum += p.value;
    }
    return found;
  }

  /// Draws a histogram of the lines between two axes, with a band for each pair of levels.
  void stretches() {
    for (std::size_t k = 0; k < axes_; ++k) {
      const Stretches found = stretches_behind(k);
      std::size_t most = 1;
      for (const auto& [ends, one] : found) most = std::max(most, one.points);
      for (const bool fit : {false, true}) {
        for (const auto& [ends, one] : found) {
          if ((one.fit > 0) != fit) continue;
          const double wide = 0.4 + 5 * std::sqrt(static_cast<double>(one.points) / static_cast<double>(most));
          const std::string colour = fit ? shade(range_.share(one.sum / static_cast<double>(one.fit))) : std::string(kUnfit);
          const double from = up(kLevelsOfAxis.at(ends.first, 0.5));
          svg_.line({across(k), from}, {across(k + 1), up(kLevelsOfAxis.at(ends.second, 0.5))},
                    {.stroke = colour, .width = wide});
        }
      }
    }
    best();
  }

  void axis(std::size_t k) {
    const double x = across(k);
    svg_.line({x, kParallelPlot.top}, {x, kParallelPlot.bottom}, kAxisLine);
    for (const Tick& tick : ticks_[k].marks) {
      const double y = up((tick.at - ticks_[k].lo) / (ticks_[k].hi - ticks_[k].lo));
      svg_.line({x - 3, y}, {x + 3, y}, kAxisLine);
      // A white background prevents lines from crossing the text.
      svg_.rectangle({x + 5, y - 6}, text_width(tick.text, 11) + 2, 12, {.fill = colour::kWhite});
      svg_.text({x + 6, y + 4}, tick.text, {.size = 11});
    }
  }

  /// Draws the axis of the value with its colours, or in grey if no point is kept.
  void value_axis() {
    constexpr int kSteps = 96;
    constexpr double kStripWide = 14;  // px
    std::vector<std::string> colours;
    for (int k = 0; k < kSteps; ++k) {
      const double value = all_.lo + (k + 0.5) / kSteps * (all_.hi - all_.lo);
      const bool fit = value >= range_.lo && value <= range_.hi;
      colours.push_back(fit ? shade(range_.share(value)) : std::string(kUnfit));
    }
    if (range_.empty()) colours.clear();
    const double x = across(axes_);
    draw_colours(svg_, {x, x + kStripWide, kParallelPlot.top, kParallelPlot.bottom}, colours, {ticks_.back()});
  }

  // Draws the name of an axis. Names are in two alternating rows and extend inwards at the outer axes, so that long names do
  // not overlap.
  void name(std::size_t k) {
    const double x = across(k);
    const bool last = k == axes_;
    const double y = kParallelPlot.top - (k % 2 == 0 ? 14 : 36);
    const Anchor anchor = k == 0 ? Anchor::start : last ? Anchor::end : Anchor::middle;
    const double from = k == 0 ? x - 50 : last ? x + 60 : x;
    svg_.line({x, kParallelPlot.top}, {x, y + 4}, {.stroke = colour::kGrey, .width = 0.7});
    svg_.text({from, y}, shortened(last ? f_.value.title() : f_.axes[k].axis.title()),
              {.size = axes_ > 6 ? 11.0 : 13.0, .anchor = anchor, .bold = last});
  }

  void legend() {
    std::vector<LegendEntry> entries;
    const auto any = [&](bool fit) {
      return std::ranges::any_of(f_.points, [&](const ManyPoint& p) { return (p.state == PointState::kept) == fit; });
    };
    const std::string middle = shade(0.6);
    if (any(true)) entries.push_back(line_entry("kept, by its value", {.stroke = middle, .width = 1.5}));
    if (any(false)) entries.push_back(line_entry("not kept or failed", {.stroke = kUnfit, .width = 1.2}));
    const auto beyond = [&](const ManyPoint& p) { return p.state != PointState::failed && all_.beyond(p.value); };
    if (f_.points.size() * axes_ <= kMostMarks && std::ranges::any_of(f_.points, beyond)) {
      entries.push_back({"beyond the axis", [](Canvas& canvas, Point at) {
                           draw_arrow(canvas, {at.x, at.y - kTip}, true, {.fill = kUnfit}, kTip);
                         }});
    }
    if (f_.marks_best()) entries.push_back(line_entry("best", {.stroke = colour::kBlack, .width = 2.4}));
    draw_legend(&svg_, entries, kParallelPlot.left, kSheetWidth, kParallelPlot.bottom + 42);
  }

  const ManyFigure& f_;
  Svg svg_;
  std::size_t axes_;
  Bounds range_, all_;        ///< range of the values that have a colour, and range of the axis of values
  std::vector<Ticks> ticks_;  ///< ticks of the parameters, then of the value
};

}  // namespace

std::string parallel_svg(const ManyFigure& figure) { return Parallel(figure).drawn(); }

std::string many_csv(const ManyFigure& figure) {
  std::string text;
  for (const ManyAxis& axis : figure.axes) text += axis.axis.name + ",";
  text += figure.value.name + ",state,best\n";
  for (std::size_t k = 0; k < figure.points.size(); ++k) {
    const ManyPoint& p = figure.points[k];
    for (std::size_t a = 0; a < p.at.size(); ++a) {
      const std::vector<std::string>& words = figure.axes[a].words;
      const bool known = p.at[a] >= 0 && p.at[a] < static_cast<double>(words.size());
      text += (words.empty() ? csv_cell(p.at[a]) : known ? words[static_cast<std::size_t>(p.at[a])] : "") + ",";
    }
    text += csv_cell(p.value) + "," + name_of(p.state) + "," + (k == figure.best ? "1" : "0") + "\n";
  }
  return text;
}

}  // namespace gaitlab::report
