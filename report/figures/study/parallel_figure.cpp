// Parallel coordinates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/settings/wording.h"
#include "report/figures/study/many_axes.h"
#include "report/figures/study/many_figure.h"
#include "report/figures/study/study_sheet.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr std::size_t kMostAxes = 16;
constexpr double kParallelHeight = 600;               // px
constexpr PlotArea kParallelPlot{70, 670, 124, 470};  // px
constexpr std::string_view kUnfit = "#CFCFCF";
constexpr std::size_t kBinsOfAxis = 32;  // of each axis of a histogram

class Parallel {
 public:
  explicit Parallel(const ManyFigure& figure) : f_(figure), svg_(kSheetWidth, kParallelHeight), range_(value_range(figure)) {
    axes_ = std::min(f_.axes.size(), kMostAxes);
    for (std::size_t k = 0; k < axes_; ++k) spreads_.emplace_back(f_.axes[k], f_, k);
    for (const ManyPoint& p : f_.points) {
      if (p.state != PointState::failed) all_.add(p.value);
    }
    spreads_.emplace_back(all_);
  }

  std::string drawn() {
    draw_sheet_title(svg_, f_.title);
    const bool histogram = f_.points.size() * axes_ > kMostMarks;
    if (histogram) {
      stretches();
    } else {
      lines();
    }
    for (std::size_t k = 0; k <= axes_; ++k) axis(k);
    strip();
    legend();
    std::string note = f_.note;
    if (f_.axes.size() > axes_) note = fmt::format("the first {} of {} parameters; {}", axes_, f_.axes.size(), note);
    if (histogram) note = "width by the number of points, colour by the mean of the kept ones; " + note;
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
  [[nodiscard]] double value(const ManyPoint& p, std::size_t k) const { return k < axes_ ? p.at[k] : p.value; }
  [[nodiscard]] double level(double value) const {
    return range_.hi > range_.lo ? (value - range_.lo) / (range_.hi - range_.lo) : 0.5;
  }

  void line(const ManyPoint& p, const Style& style) {
    std::vector<Point> points;
    const bool valued = p.state != PointState::failed && std::isfinite(p.value);
    for (std::size_t k = 0; k < axes_ + (valued ? 1U : 0U); ++k)
      points.push_back({across(k), up(spreads_[k].share(value(p, k)))});
    svg_.polyline(points, style);
  }

  /// The unfit below, then from the palest to the darkest, the best above all.
  void lines() {
    std::vector<std::size_t> order(f_.points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto rank = [&](std::size_t k) {
      const ManyPoint& p = f_.points[k];
      const bool fit = p.state == PointState::kept && std::isfinite(p.value);
      return fit ? std::pair{1, p.value} : std::pair{0, 0.0};
    };
    std::ranges::stable_sort(order, {}, rank);
    const bool many = f_.points.size() > 200;
    for (const std::size_t k : order) {
      const ManyPoint& p = f_.points[k];
      const bool fit = rank(k).first == 1;
      const std::string colour = fit ? shade(level(p.value)) : std::string(kUnfit);
      line(p, {.stroke = colour, .width = fit ? (many ? 1.0 : 1.5) : 0.7});
    }
    best();
  }

  void best() {
    if (f_.best >= f_.points.size()) return;
    line(f_.points[f_.best], {.stroke = colour::kWhite, .width = 5});
    line(f_.points[f_.best], {.stroke = colour::kBlack, .width = 2.4});
  }

  /// Between two axes, from level to level.
  void stretches() {
    struct Stretch {
      std::size_t points = 0, fit = 0;
      double sum = 0;
    };
    const auto level_of = [&](const ManyPoint& p, std::size_t k) {
      const double share = std::clamp(spreads_[k].share(value(p, k)), 0.0, 1.0);
      return std::min(static_cast<std::size_t>(share * kBinsOfAxis), kBinsOfAxis - 1);
    };
    for (std::size_t k = 0; k < axes_; ++k) {
      std::map<std::pair<std::size_t, std::size_t>, Stretch> found;
      std::size_t most = 1;
      for (const ManyPoint& p : f_.points) {
        const bool valued = p.state != PointState::failed && std::isfinite(p.value);
        if (k + 1 == axes_ && !valued) continue;
        Stretch& one = found[{level_of(p, k), level_of(p, k + 1)}];
        most = std::max(most, ++one.points);
        if (p.state != PointState::kept || !valued) continue;
        ++one.fit;
        one.sum += p.value;
      }
      for (const bool fit : {false, true}) {
        for (const auto& [ends, one] : found) {
          if ((one.fit > 0) != fit) continue;
          const double wide = 0.4 + 5 * std::sqrt(static_cast<double>(one.points) / static_cast<double>(most));
          const std::string colour = fit ? shade(level(one.sum / static_cast<double>(one.fit))) : std::string(kUnfit);
          const auto middle = [](std::size_t at) { return up((static_cast<double>(at) + 0.5) / kBinsOfAxis); };
          svg_.line({across(k), middle(ends.first)}, {across(k + 1), middle(ends.second)}, {.stroke = colour, .width = wide});
        }
      }
    }
    best();
  }

  /// Colours stand beside the axis of the value: grey where no point is kept.
  void strip() {
    constexpr int kSteps = 96;
    constexpr double kStripWide = 14;
    const double height = (kParallelPlot.bottom - kParallelPlot.top) / kSteps;
    if (range_.empty()) return;
    for (int k = 0; k < kSteps; ++k) {
      const double share = (k + 0.5) / kSteps;
      const double value = all_.lo + share * (all_.hi - all_.lo);
      const bool fit = value >= range_.lo && value <= range_.hi;
      svg_.rectangle({across(axes_), up(share) - height / 2}, kStripWide, height + 0.4,
                     {.fill = fit ? shade(level(value)) : std::string(kUnfit)});
    }
    svg_.rectangle({across(axes_), kParallelPlot.top}, kStripWide, kParallelPlot.bottom - kParallelPlot.top, kAxisLine);
  }

  void axis(std::size_t k) {
    const double x = across(k);
    svg_.line({x, kParallelPlot.top}, {x, kParallelPlot.bottom}, kAxisLine);
    const bool last = k == axes_;
    const int count = axes_ > 8 ? 4 : 6;
    for (const auto& [place, label] : spreads_[k].labels(count)) {
      const double from = last ? x + 14 : x;
      svg_.line({last ? from : x - 3, up(place)}, {from + 3, up(place)}, kAxisLine);
      // White below, so that lines do not run through it.
      const double wide = text_width(label, 11);
      if (!last) svg_.rectangle({x + 5, up(place) - 6}, wide + 2, 12, {.fill = colour::kWhite});
      svg_.text({from + 6, up(place) + 4}, label, {.size = 11});
    }
    const std::string name = last ? f_.value.title() : f_.axes[k].axis.name;
    // In two rows by turns, and from the outer axes inwards, so that long names do not meet.
    const double y = kParallelPlot.top - (k % 2 == 0 ? 14 : 36);
    const Anchor anchor = k == 0 ? Anchor::start : last ? Anchor::end : Anchor::middle;
    const double from = k == 0 ? x - 50 : last ? x + 60 : x;
    svg_.line({x, kParallelPlot.top}, {x, y + 4}, {.stroke = colour::kGrey, .width = 0.7});
    svg_.text({from, y}, shortened(name), {.size = axes_ > 6 ? 11.0 : 13.0, .anchor = anchor, .bold = last});
  }

  void legend() {
    double x = kParallelPlot.left;
    const double y = kParallelPlot.bottom + 42;
    const auto entry = [&](const char* name, const Style& style) {
      svg_.line({x, y - 4.5}, {x + 26, y - 4.5}, style);
      svg_.text({x + 32, y}, name);
      x += 60 + text_width(name, 13);
    };
    const auto any = [&](bool fit) {
      return std::ranges::any_of(f_.points, [&](const ManyPoint& p) { return (p.state == PointState::kept) == fit; });
    };
    const std::string middle = shade(0.6);
    if (any(true)) entry("kept, by its value", {.stroke = middle, .width = 1.5});
    if (any(false)) entry("not kept or failed", {.stroke = kUnfit, .width = 1.2});
    if (f_.best < f_.points.size()) entry("best", {.stroke = colour::kBlack, .width = 2.4});
  }

  const ManyFigure& f_;
  Svg svg_;
  Bounds range_, all_;  ///< of the values: that colours span, and whole
  std::size_t axes_ = 0;
  std::vector<Spread> spreads_;  ///< of the parameters, then of the value
};

}  // namespace

std::string parallel_svg(const ManyFigure& figure) { return Parallel(figure).drawn(); }

std::string many_csv(const ManyFigure& figure) {
  const auto cell = [](double value) { return std::isfinite(value) ? number_text(value) : ""; };
  std::string text;
  for (const ManyAxis& axis : figure.axes) text += axis.axis.name + ",";
  text += figure.value.name + ",state,best\n";
  for (std::size_t k = 0; k < figure.points.size(); ++k) {
    const ManyPoint& p = figure.points[k];
    for (std::size_t a = 0; a < p.at.size(); ++a) {
      const std::vector<std::string>& words = figure.axes[a].words;
      const bool known = p.at[a] >= 0 && p.at[a] < static_cast<double>(words.size());
      text += (words.empty() ? cell(p.at[a]) : known ? words[static_cast<std::size_t>(p.at[a])] : "") + ",";
    }
    text += cell(p.value) + "," + name_of(p.state) + "," + (k == figure.best ? "1" : "0") + "\n";
  }
  return text;
}

}  // namespace gaitlab::report
