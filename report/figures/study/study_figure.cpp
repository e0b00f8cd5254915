#include "report/figures/study/study_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/functions.h"
#include "core/settings/wording.h"
#include "report/figures/study/study_sheet.h"
#include "report/plot/panel.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr double kSheetHeight = 560;         // px
constexpr PlotArea kPlot{96, 620, 64, 440};  // px
constexpr double kStudyMargin = 0.03;        // of an axis, beyond the outermost marks
constexpr std::string_view kBand = "#C6DDF0";
constexpr Style kPaleHatch{.stroke = colour::kWhite, .width = 0.8};

double on_axis(const StudyAxis& axis, double value) { return axis.log ? log10_of(value) : value; }

/// Lines at 45 degrees within a rectangle.
void hatch(Canvas& canvas, Point corner, double width, double height, const Style& style = kHatchLine) {
  constexpr double kApart = 7;  // px
  for (double offset = kApart; offset < width + height; offset += kApart) {
    const double x0 = std::max(0.0, offset - height);
    const double x1 = std::min(offset, width);
    canvas.line({corner.x + x0, corner.y + offset - x0}, {corner.x + x1, corner.y + offset - x1}, style);
  }
}

/// Half way between neighbours, and as far beyond the outermost.
struct Edges1 {
  explicit Edges1(std::vector<double> values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    const std::size_t n = values.size();
    for (std::size_t k = 0; k + 1 < n; ++k) between.push_back(0.5 * (values[k] + values[k + 1]));
    const double first = n > 1 ? values[0] - between.front() : -0.5;
    const double last = n > 1 ? values[n - 1] - between.back() : 0.5;
    between.insert(between.begin(), values.empty() ? -0.5 : values[0] + first);
    between.push_back(values.empty() ? 0.5 : values[n - 1] + last);
  }
  /// The cell that holds a value: its two edges.
  [[nodiscard]] std::pair<double, double> cell(double value) const {
    const auto above = std::upper_bound(between.begin() + 1, between.end() - 1, value);
    return {*(above - 1), *above};
  }
  std::vector<double> between;
};

/// The mean of several points: of the kept ones, or else of the others.
class Pooled {
 public:
  void add(const StudyPoint& p) {
    if (count_ > 0 && p.state > of_.state) return;
    if (count_ == 0 || p.state < of_.state) {
      of_ = p;
      sum_ = 0;
      count_ = 0;
    }
    if (count_ > 0 && !std::isfinite(p.value)) return;
    sum_ += p.value;
    ++count_;
    of_.low = std::min(of_.low, p.low);
    of_.high = std::max(of_.high, p.high);
  }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] StudyPoint at(double x, double y) const {
    StudyPoint p = of_;
    p.x = x;
    p.y = y;
    p.value = sum_ / count_;
    return p;
  }

 private:
  StudyPoint of_;
  double sum_ = 0, count_ = 0;
};

/// Of a figure with too many points to draw: cells (of a line stretches), each the mean of what lies in it.
StudyFigure histogram(const StudyFigure& figure) {
  const std::size_t across = figure.map ? 120 : 600;
  const std::size_t upwards = figure.map ? 90 : 1;
  Bounds x;
  Bounds y;
  for (const StudyPoint& p : figure.points) {
    x.add(on_axis(figure.x, p.x));
    y.add(figure.map ? on_axis(figure.y, p.y) : 0);
  }
  const auto bin = [](const Bounds& range, double value, std::size_t bins) {
    const double share = range.hi > range.lo ? (value - range.lo) / (range.hi - range.lo) : 0;
    return std::min(static_cast<std::size_t>(std::max(share, 0.0) * static_cast<double>(bins)), bins - 1);
  };
  const auto cell_of = [&](const StudyPoint& p) {
    const std::size_t row = figure.map ? bin(y, on_axis(figure.y, p.y), upwards) : 0;
    return row * across + bin(x, on_axis(figure.x, p.x), across);
  };
  std::vector<Pooled> cells(across * upwards);
  for (const StudyPoint& p : figure.points) cells[cell_of(p)].add(p);
  StudyFigure made = figure;
  made.points.clear();
  made.grid = true;
  const std::size_t best = figure.best < figure.points.size() ? cell_of(figure.points[figure.best]) : cells.size();
  const auto centre = [](const StudyAxis& axis, const Bounds& range, std::size_t k, std::size_t bins) {
    const double at = range.lo + (static_cast<double>(k) + 0.5) / static_cast<double>(bins) * (range.hi - range.lo);
    return axis.log ? power_of_ten(at) : at;
  };
  made.best = cells.size();
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (cells[k].empty()) continue;
    if (k == best) made.best = made.points.size();
    made.points.push_back(
        cells[k].at(centre(figure.x, x, k % across, across), figure.map ? centre(figure.y, y, k / across, upwards) : 0));
  }
  made.note = fmt::format("each {} the mean of the kept of its points; {}", figure.map ? "cell" : "mark", figure.note);
  if (best == cells.size()) made.best = made.points.size();
  return made;
}

class Drawing {
 public:
  explicit Drawing(StudyFigure figure) : f_(std::move(figure)), svg_(kSheetWidth, kSheetHeight) {
    for (std::size_t k = 0; k < f_.points.size(); ++k) {
      marks_.push_back(k);
      const StudyPoint& p = f_.points[k];
      x_.add(on_axis(f_.x, p.x));
      if (f_.map) y_.add(on_axis(f_.y, p.y));
      if (p.state == PointState::failed || (f_.map && p.state != PointState::kept)) continue;
      values_.add(p.value);
      if (!f_.map) values_.add(p.low);
      if (!f_.map) values_.add(p.high);
    }
    // The colours of a map are for kept points: what exploits the simulation would leave all others pale.
    if (values_.lo < values_.hi || !f_.map) return;
    for (const StudyPoint& p : f_.points) {
      if (p.state != PointState::failed) values_.add(p.value);
    }
  }

  std::string drawn() {
    draw_sheet_title(svg_, f_.title);
    if (f_.map) {
      map();
    } else {
      line();
    }
    legend();
    draw_sheet_note(svg_, f_.note, kSheetHeight - 14);
    return svg_.finish();
  }

 private:
  void line() {
    const AxisMarks across = axis_marks(x_, f_.x.log, 8, kStudyMargin);
    const AxisMarks upwards = axis_marks(values_, false, 7, kStudyMargin);
    draw_frame(svg_, kPlot, across, upwards);
    titles(f_.x.title(), f_.value.title());
    const Scale x_of{across.lo, across.hi, kPlot.left, kPlot.right};
    const Scale y_of{upwards.lo, upwards.hi, kPlot.bottom, kPlot.top};
    const auto place = [&](double x, double value) { return Point{x_of(x), y_of(value)}; };
    std::vector<std::size_t> order = marks_;
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return f_.points[k].x; });
    std::vector<Point> upper;
    std::vector<Point> lower;
    std::vector<Point> middle;
    for (const std::size_t k : order) {
      const StudyPoint& p = f_.points[k];
      if (p.state == PointState::failed || !std::isfinite(p.value)) continue;
      const double x = on_axis(f_.x, p.x);
      upper.push_back(place(x, p.high));
      lower.push_back(place(x, p.low));
      middle.push_back(place(x, p.value));
    }
    Polygon band = upper;
    band.insert(band.end(), lower.rbegin(), lower.rend());
    if (band.size() > 2) svg_.polygons({&band, 1}, {.fill = kBand});
    svg_.polyline(middle, {.stroke = colour::kBlue, .width = 1.8});
    for (const std::size_t k : order) {
      const StudyPoint& p = f_.points[k];
      const double x = on_axis(f_.x, p.x);
      if (p.state == PointState::failed) {
        draw_cross(svg_, {place(x, 0).x, kPlot.bottom - 8}, kMark);
      } else {
        dot(place(x, p.value), p.state == PointState::kept ? colour::kBlue : colour::kWhite);
      }
    }
    if (f_.best < f_.points.size()) draw_ring(svg_, place(on_axis(f_.x, f_.points[f_.best].x), f_.points[f_.best].value));
  }

  void titles(const std::string& below, const std::string& side) {
    svg_.text({(kPlot.left + kPlot.right) / 2, kPlot.bottom + 38}, shortened(below), {.anchor = Anchor::middle});
    svg_.text({kPlot.left - 62, (kPlot.top + kPlot.bottom) / 2}, shortened(side), {.anchor = Anchor::middle, .upwards = true});
  }

  void dot(Point at, std::string_view fill) { svg_.circle(at, kMark, {.stroke = colour::kBlue, .fill = fill, .width = 1.4}); }

  void map() {
    std::vector<double> xs;
    std::vector<double> ys;
    for (const StudyPoint& p : f_.points) {
      xs.push_back(on_axis(f_.x, p.x));
      ys.push_back(on_axis(f_.y, p.y));
    }
    const Edges1 across(xs);
    const Edges1 upwards(ys);
    const auto edges = [](const Edges1& of) { return Bounds{of.between.front(), of.between.back()}; };
    AxisMarks x_marks = axis_marks(f_.grid ? edges(across) : x_, f_.x.log, 8, f_.grid ? 0 : kStudyMargin);
    AxisMarks y_marks = axis_marks(f_.grid ? edges(upwards) : y_, f_.y.log, 8, f_.grid ? 0 : kStudyMargin);
    // Of one row or column its value.
    if (f_.grid && x_.lo == x_.hi) x_marks.labels = axis_marks(x_, f_.x.log, 8).labels;
    if (f_.grid && y_.lo == y_.hi) y_marks.labels = axis_marks(y_, f_.y.log, 8).labels;
    const Scale x_of{x_marks.lo, x_marks.hi, kPlot.left, kPlot.right};
    const Scale y_of{y_marks.lo, y_marks.hi, kPlot.bottom, kPlot.top};
    for (const std::size_t k : marks_) {
      const StudyPoint& p = f_.points[k];
      const double x = on_axis(f_.x, p.x);
      const double y = on_axis(f_.y, p.y);
      if (f_.grid) {
        const auto [left, right] = across.cell(x);
        const auto [low, high] = upwards.cell(y);
        const Point corner = Point{x_of(left), y_of(high)};
        const Point other = Point{x_of(right), y_of(low)};
        cell(p, corner, other.x - corner.x, other.y - corner.y, k == f_.best);
      } else {
        mark(p, Point{x_of(x), y_of(y)}, k == f_.best);
      }
    }
    draw_frame(svg_, kPlot, x_marks, y_marks, {.grid = false});
    titles(f_.x.title(), f_.y.title());
    draw_shades(svg_, kPlot, values_.lo, values_.hi, shortened(f_.value.name) + unit_text());
    if (f_.best < f_.points.size()) draw_ring(svg_, best_at_);
  }

  [[nodiscard]] std::string unit_text() const { return f_.value.unit.empty() ? "" : " (" + f_.value.unit + ")"; }

  [[nodiscard]] double level(double value) const {
    return values_.hi > values_.lo ? (value - values_.lo) / (values_.hi - values_.lo) : 0.5;
  }

  void cell(const StudyPoint& p, Point corner, double width, double height, bool best) {
    const bool known = p.state != PointState::failed && std::isfinite(p.value);
    const std::string fill = known ? shade(level(p.value)) : std::string(colour::kWhite);
    svg_.rectangle(corner, width, height, {.fill = fill});
    constexpr double kDark = 0.5;
    const bool dark = known && level(p.value) > kDark;
    if (not_kept(p.state)) hatch(svg_, corner, width, height, dark ? kPaleHatch : kHatchLine);
    if (p.state == PointState::failed)
      draw_cross(svg_, {corner.x + width / 2, corner.y + height / 2}, std::min({kMark, width / 3, height / 3}));
    if (best) best_at_ = {corner.x + width / 2, corner.y + height / 2};
  }

  void slashed(Point at, std::string_view fill) {
    svg_.circle(at, kMark, {.stroke = colour::kGrey, .fill = fill, .width = 1});
    svg_.line({at.x - kMark, at.y + kMark}, {at.x + kMark, at.y - kMark}, kHatchLine);
  }

  void mark(const StudyPoint& p, Point at, bool best) {
    if (p.state == PointState::failed) return draw_cross(svg_, at, kMark - 1);
    const std::string fill = std::isfinite(p.value) ? shade(level(p.value)) : std::string(colour::kWhite);
    if (not_kept(p.state)) {
      slashed(at, fill);
    } else {
      svg_.circle(at, kMark, {.stroke = colour::kInk, .fill = fill, .width = 1});
    }
    if (best) best_at_ = at;
  }

  void legend() {
    const double y = kSheetHeight - 52;
    double x = kPlot.left;
    const auto entry = [&](const char* name, auto draw) {
      draw(Point{x, y});
      svg_.text({x + 14, y + 4.5}, name);
      x += 40 + text_width(name, 13);
    };
    const auto any = [&](PointState state) {
      return std::ranges::any_of(f_.points, [&](const StudyPoint& p) { return p.state == state; });
    };
    if (any(PointState::kept) && !f_.map) entry("kept", [&](Point at) { dot(at, colour::kBlue); });
    if (const char* const text = not_kept_text(f_.points); *text != '\0') {
      entry(text, [&](Point at) {
        if (!f_.map) return dot(at, colour::kWhite);
        if (!f_.grid) return slashed(at, shade(0.3));
        svg_.rectangle({at.x - 8, at.y - 8}, 16, 16, {.stroke = colour::kInk, .width = 0.8});
        hatch(svg_, {at.x - 8, at.y - 8}, 16, 16);
      });
    }
    if (any(PointState::failed)) entry("failed", [&](Point at) { draw_cross(svg_, at, kMark); });
    if (f_.best < f_.points.size()) entry("best", [&](Point at) { svg_.circle(at, kMark + 3, kBestMark); });
    if (!f_.map && std::ranges::any_of(f_.points, [](const StudyPoint& p) { return p.low < p.high; }))
      entry("least to largest of the replicates", [&](Point at) {
        svg_.rectangle({at.x - 8, at.y - 6}, 16, 12, {.fill = kBand});
      });
  }

  StudyFigure f_;
  Svg svg_;
  std::vector<std::size_t> marks_;
  Bounds x_, y_, values_;
  Point best_at_;
};

std::string cell_text(double value) { return std::isfinite(value) ? number_text(value) : ""; }

}  // namespace

std::string study_svg(const StudyFigure& figure) {
  return figure.points.size() > kMostMarks ? Drawing(histogram(figure)).drawn() : Drawing(figure).drawn();
}

std::string study_csv(const StudyFigure& figure) {
  std::string text =
      figure.x.name + "," + (figure.map ? figure.y.name + "," : "") + figure.value.name + ",least,largest,state,best\n";
  for (std::size_t k = 0; k < figure.points.size(); ++k) {
    const StudyPoint& p = figure.points[k];
    text += cell_text(p.x) + "," + (figure.map ? cell_text(p.y) + "," : "") + cell_text(p.value) + "," + cell_text(p.low) +
            "," + cell_text(p.high) + "," + name_of(p.state) + "," + (k == figure.best ? "1" : "0") + "\n";
  }
  return text;
}

}  // namespace gaitlab::report
