// Figure of a value over each parameter.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures/study/many_axes.h"
#include "report/figures/study/many_figure.h"
#include "report/figures/study/study_sheet.h"
#include "report/plot/legend.h"
#include "report/plot/plot.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kMostPanels = 24;
constexpr double kPanelHigh = 130, kRowHigh = 196;                           // px
constexpr double kPanelLeft = 84, kPanelsWide = 672, kBetweenScatters = 38;  // px
constexpr double kDot = 2.6;                                                 // px
constexpr std::string_view kUnfitDot = "#B0B0B0";
constexpr Style kBeyondDot{.stroke = kUnfitDot, .fill = colour::kWhite, .width = 1};

constexpr double kEdge = 0.04;  // share of an axis beyond the outermost dots

/// Panels per row: three, or another number that leaves no panel alone in a row.
std::size_t panels_in_row(std::size_t panels) {
  if (panels == 4) return 2;
  return panels % 3 == 1 && panels % 4 != 1 ? 4 : 3;
}

class Scatter {
 public:
  explicit Scatter(const ManyFigure& figure)
      : f_(figure),
        panels_(std::min(figure.axes.size(), kMostPanels)),
        in_row_(panels_in_row(panels_)),
        range_(value_range(figure)),
        svg_(kSheetWidth, height(), figure.title),
        values_(ticks_over(range_, false, 5, kEdge)) {}

  std::string drawn() {
    draw_sheet_title(svg_, f_.title);
    const bool histogram = f_.points.size() * panels_ > kMostMarks;
    for (std::size_t k = 0; k < panels_; ++k) panel(k, histogram);
    legend(histogram);
    std::string note = f_.note;
    if (f_.axes.size() > panels_) note = fmt::format("the first {} of {} parameters; {}", panels_, f_.axes.size(), note);
    draw_sheet_note(svg_, note, height() - 14);
    return svg_.finish();
  }

 private:
  [[nodiscard]] std::size_t rows() const { return std::max<std::size_t>(1, (panels_ + in_row_ - 1) / in_row_); }
  [[nodiscard]] double height() const { return kSheetTop + kRowHigh * static_cast<double>(rows()) + 70; }

  void panel(std::size_t k, bool histogram) {
    const double column = kPanelsWide / static_cast<double>(in_row_);
    const double left = kPanelLeft + column * static_cast<double>(k % in_row_);
    const std::size_t row = k / in_row_;
    const double top = kSheetTop + kRowHigh * static_cast<double>(row);
    const bool first = k % in_row_ == 0;
    const Ticks across = parameter_ticks(f_, k, 4, kEdge);
    const Plot plot(svg_, {left, left + column - kBetweenScatters, top, top + kPanelHigh},
                    {.ticks = across, .title = shortened(f_.axes[k].axis.title())},
                    {.ticks = values_, .title = first ? shortened(f_.value.title()) : "", .texts = first});
    plot.draw_axes();
    if (histogram) {
      cells(plot, across, k);
    } else {
      dots(plot, k);
    }
    if (f_.marks_best() && std::isfinite(f_.points[f_.best].value))
      svg_.circle(place(plot, f_.points[f_.best], k), kDot + 3, {.stroke = colour::kBlack, .width = 1.8});
  }

  [[nodiscard]] Point place(const Plot& plot, const ManyPoint& p, std::size_t k) const {
    return plot.at(place_on(f_.axes[k], p.at[k]), p.value);
  }

  /// Draws the dots, first those of points that are not kept.
  void dots(const Plot& plot, std::size_t k) {
    for (const bool fit : {false, true}) {
      for (const ManyPoint& p : f_.points) {
        if ((p.state == PointState::kept) != fit || p.state == PointState::failed || !std::isfinite(p.value)) continue;
        Point at = place(plot, p, k);
        if (range_.beyond(p.value)) {
          const bool above = p.value > range_.hi;
          at.y = plot.at(0, above ? values_.hi : values_.lo).y;
          draw_arrow(svg_, at, above, kBeyondDot, kDot);
        } else {
          svg_.circle(at, fit ? kDot : kDot - 0.4, fit ? Style{.fill = colour::kBlue} : Style{.stroke = kUnfitDot});
        }
      }
    }
  }

  /// Draws a histogram of the points.
  void cells(const Plot& plot, const Ticks& across, std::size_t k) {
    const Bins x{across.lo, across.hi, 36};
    const Bins y{values_.lo, values_.hi, 26};
    std::vector<double> counts(x.count * y.count, 0.0);
    for (const ManyPoint& p : f_.points) {
      if (p.state == PointState::failed || !std::isfinite(p.value)) continue;
      counts[y.of(p.value) * x.count + x.of(place_on(f_.axes[k], p.at[k]))] += 1;
    }
    const double most = std::ranges::max(counts);
    for (std::size_t c = 0; c < counts.size(); ++c) {
      if (counts[c] == 0) continue;
      const Point low = plot.at(x.at(c % x.count, 0), y.at(c / x.count, 0));
      const Point high = plot.at(x.at(c % x.count, 1), y.at(c / x.count, 1));
      svg_.rectangle({low.x, high.y}, high.x - low.x, low.y - high.y, {.fill = shade(std::sqrt(counts[c] / most))});
    }
  }

  void legend(bool histogram) {
    std::vector<LegendEntry> entries;
    const auto any = [&](PointState state) {
      return std::ranges::any_of(f_.points, [&](const ManyPoint& p) { return p.state == state; });
    };
    const std::string dark = shade(0.8);
    const char* const others = not_kept_text(f_.points);
    if (histogram) {
      entries.push_back(dot_entry("many points (dark) to one (pale)", {.fill = dark}, 5));
    } else {
      if (any(PointState::kept)) entries.push_back(dot_entry("kept", {.fill = colour::kBlue}, kDot));
      if (*others != '\0') entries.push_back(dot_entry(others, {.stroke = kUnfitDot, .width = 1}, kDot));
      const auto beyond = [&](const ManyPoint& p) { return p.state != PointState::failed && range_.beyond(p.value); };
      if (std::ranges::any_of(f_.points, beyond)) {
        entries.push_back({"beyond the axis", [](Canvas& canvas, Point at) {
                             draw_arrow(canvas, {at.x, at.y - kDot}, true, kBeyondDot, kDot);
                           }});
      }
    }
    if (f_.marks_best()) entries.push_back(dot_entry("best", {.stroke = colour::kBlack, .width = 1.8}, kDot + 3));
    draw_legend(&svg_, entries, kPanelLeft, kSheetWidth, kSheetTop + kRowHigh * static_cast<double>(rows()) + 14);
  }

  const ManyFigure& f_;
  std::size_t panels_, in_row_;
  Bounds range_;  ///< range of the values that are shown
  Svg svg_;
  Ticks values_;
};

}  // namespace

std::string scatter_svg(const ManyFigure& figure) { return Scatter(figure).drawn(); }

}  // namespace gaitlab::report
