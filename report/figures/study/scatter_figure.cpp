// Each parameter against a value.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures/study/many_axes.h"
#include "report/figures/study/many_figure.h"
#include "report/figures/study/study_sheet.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kMostPanels = 24, kInRow = 3;
constexpr double kPanelWide = 186, kPanelHigh = 130;                  // px
constexpr double kPanelLeft = 84, kColumnWide = 224, kRowHigh = 196;  // px
constexpr double kDot = 2.6;                                          // px
constexpr std::string_view kUnfitDot = "#B0B0B0";

constexpr double kEdge = 0.04;  // of an axis, beyond the outermost dots

/// From a share of the axis and a value to the paper.
struct Place {
  Scale x, y;
  [[nodiscard]] Point at(double share, double value) const { return {x(share), y(value)}; }
};

class Scatter {
 public:
  explicit Scatter(const ManyFigure& figure)
      : f_(figure), panels_(std::min(figure.axes.size(), kMostPanels)), svg_(kSheetWidth, height()) {
    Bounds all;
    for (const ManyPoint& p : f_.points) {
      if (p.state != PointState::failed) all.add(p.value);
    }
    values_ = axis_marks(all, false, 5, kEdge);
  }

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
  [[nodiscard]] std::size_t rows() const { return std::max<std::size_t>(1, (panels_ + kInRow - 1) / kInRow); }
  [[nodiscard]] double height() const { return kSheetTop + kRowHigh * static_cast<double>(rows()) + 70; }

  void panel(std::size_t k, bool histogram) {
    const double left = kPanelLeft + kColumnWide * static_cast<double>(k % kInRow);
    const double top = kSheetTop + kRowHigh * static_cast<double>(k / kInRow);
    const PlotArea area{left, left + kPanelWide, top, top + kPanelHigh};
    const Spread spread(f_.axes[k], f_, k);
    // Shares of the axis with a margin, so that no dot stands on the frame; its labels are the parameter's.
    const AxisMarks across{-kEdge, 1 + kEdge, spread.labels(4)};
    draw_frame(svg_, area, across, values_, {.left_labels = k % kInRow == 0});
    const Place place{{across.lo, across.hi, area.left, area.right}, {values_.lo, values_.hi, area.bottom, area.top}};
    if (histogram) {
      cells(place, spread, k);
    } else {
      dots(place, spread, k);
    }
    svg_.text({(area.left + area.right) / 2, area.bottom + 35}, shortened(f_.axes[k].axis.title()), {.anchor = Anchor::middle});
    if (k % kInRow == 0)
      svg_.text({22, (area.top + area.bottom) / 2}, shortened(f_.value.title()), {.anchor = Anchor::middle, .upwards = true});
    if (f_.best < f_.points.size() && std::isfinite(f_.points[f_.best].value)) {
      const ManyPoint& best = f_.points[f_.best];
      svg_.circle(place.at(spread.share(best.at[k]), best.value), kDot + 3, {.stroke = colour::kBlack, .width = 1.8});
    }
  }

  /// What is not kept below what is.
  void dots(const Place& place, const Spread& spread, std::size_t k) {
    for (const bool fit : {false, true}) {
      for (const ManyPoint& p : f_.points) {
        if ((p.state == PointState::kept) != fit || p.state == PointState::failed || !std::isfinite(p.value)) continue;
        const Point at = place.at(spread.share(p.at[k]), p.value);
        if (fit) svg_.circle(at, kDot, {.fill = colour::kBlue});
        if (!fit) svg_.circle(at, kDot - 0.4, {.stroke = kUnfitDot, .width = 1});
      }
    }
  }

  /// How many points lie where.
  void cells(const Place& place, const Spread& spread, std::size_t k) {
    constexpr std::size_t kAcross = 36;
    constexpr std::size_t kUpwards = 26;
    std::vector<double> counts(kAcross * kUpwards, 0.0);
    const auto bin = [](double share, std::size_t bins) {
      return std::min(static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(bins)), bins - 1);
    };
    for (const ManyPoint& p : f_.points) {
      if (p.state == PointState::failed || !std::isfinite(p.value)) continue;
      const double height = (p.value - values_.lo) / (values_.hi - values_.lo);
      counts[bin(height, kUpwards) * kAcross + bin(spread.share(p.at[k]), kAcross)] += 1;
    }
    const double most = std::ranges::max(counts);
    for (std::size_t c = 0; c < counts.size(); ++c) {
      if (counts[c] == 0) continue;
      const auto x = static_cast<double>(c % kAcross);
      const auto y = static_cast<double>(c / kAcross);
      const double step = (values_.hi - values_.lo) / kUpwards;
      const Point low = place.at(x / kAcross, values_.lo + y * step);
      const Point high = place.at((x + 1) / kAcross, values_.lo + (y + 1) * step);
      svg_.rectangle({low.x, high.y}, high.x - low.x, low.y - high.y, {.fill = shade(std::sqrt(counts[c] / most))});
    }
  }

  void legend(bool histogram) {
    double x = kPanelLeft;
    const double y = kSheetTop + kRowHigh * static_cast<double>(rows()) + 14;
    const auto entry = [&](const char* name, double radius, const Style& style) {
      svg_.circle({x + 6, y - 4.5}, radius, style);
      svg_.text({x + 18, y}, name);
      x += 44 + text_width(name, 13);
    };
    const auto any = [&](PointState state) {
      return std::ranges::any_of(f_.points, [&](const ManyPoint& p) { return p.state == state; });
    };
    if (histogram) entry("many points (dark) to one (pale)", 5, {.fill = shade(0.8)});
    if (!histogram && any(PointState::kept)) entry("kept", kDot, {.fill = colour::kBlue});
    const char* const others = not_kept_text(f_.points);
    if (!histogram && *others != '\0') entry(others, kDot, {.stroke = kUnfitDot, .width = 1});
    if (f_.best < f_.points.size()) entry("best", kDot + 3, {.stroke = colour::kBlack, .width = 1.8});
  }

  const ManyFigure& f_;
  std::size_t panels_;
  Svg svg_;
  AxisMarks values_;
};

}  // namespace

std::string scatter_svg(const ManyFigure& figure) { return Scatter(figure).drawn(); }

}  // namespace gaitlab::report
