#include "report/figures/study/study_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/figures/study/study_sheet.h"
#include "report/plot/legend.h"
#include "report/plot/plot.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr double kSheetHeight = 560;         // px
constexpr PlotArea kMap{96, 620, 64, 440};   // px; a colour bar is at the right
constexpr PlotArea kLine{96, 730, 64, 440};  // px
constexpr double kStudyMargin = 0.03;        // share of an axis beyond the outermost marks
constexpr std::string_view kBand = "#C6DDF0";
constexpr Style kBeyond{.stroke = colour::kBlue, .fill = colour::kWhite, .width = 1.4};  // a point beyond the axis
constexpr Style kPaleHatch{.stroke = colour::kWhite, .width = 0.8};

double on_axis(const StudyAxis& axis, double value) { return axis.log ? log10_of(value) : value; }

/// Draws lines at 45 degrees within a rectangle.
void hatch(Canvas& canvas, Point corner, double width, double height, const Style& style = kHatchLine) {
  constexpr double kApart = 7;  // px, distance of lines
  const auto lines = static_cast<std::size_t>(std::max(0.0, std::ceil((width + height) / kApart) - 1));
  for (std::size_t k = 1; k <= lines; ++k) {
    const double offset = kApart * static_cast<double>(k);
    const double x0 = std::max(0.0, offset - height);
    const double x1 = std::min(offset, width);
    canvas.line({corner.x + x0, corner.y + offset - x0}, {corner.x + x1, corner.y + offset - x1}, style);
  }
}

/// Edges of cells: half way between neighbouring values, and at the same distance beyond the outermost values.
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
  /// Lower and upper edge of the cell that contains a value.
  [[nodiscard]] std::pair<double, double> cell(double value) const {
    const auto above = std::upper_bound(between.begin() + 1, between.end() - 1, value);
    return {*(above - 1), *above};
  }
  std::vector<double> between;
};

/// Mean of several points: of the kept points or, if there are none, of the others.
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

/// Cells of a figure over its parameters. In a line figure they are intervals.
class Cells {
 public:
  explicit Cells(const StudyFigure& figure) : f_(figure) {
    Bounds x;
    Bounds y;
    for (const StudyPoint& p : figure.points) {
      x.add(on_axis(figure.x, p.x));
      y.add(on_axis(figure.y, p.y));
    }
    x_ = {x.lo, x.hi, figure.map ? 120U : 600U};
    y_ = figure.map ? Bins{y.lo, y.hi, 90} : Bins{};
  }
  [[nodiscard]] std::size_t size() const { return x_.count * y_.count; }
  [[nodiscard]] std::size_t number(const StudyPoint& p) const {
    return y_.of(on_axis(f_.y, p.y)) * x_.count + x_.of(on_axis(f_.x, p.x));
  }
  /// Centre of a cell in the units of the parameters.
  [[nodiscard]] Point centre(std::size_t number) const {
    const double x = x_.at(number % x_.count, 0.5);
    const double y = f_.map ? y_.at(number / x_.count, 0.5) : 0;
    return {f_.x.log ? power_of_ten(x) : x, f_.map && f_.y.log ? power_of_ten(y) : y};
  }

 private:
  const StudyFigure& f_;
  Bins x_, y_;
};

/// Figure in which cells replace too many points. Each cell has the mean of its points.
StudyFigure histogram(const StudyFigure& figure) {
  const Cells cells(figure);
  std::vector<Pooled> pooled(cells.size());
  for (const StudyPoint& p : figure.points) pooled[cells.number(p)].add(p);
  const std::size_t best = figure.best < figure.points.size() ? cells.number(figure.points[figure.best]) : cells.size();
  StudyFigure made = figure;
  made.points.clear();
  made.grid = true;
  std::size_t best_point = std::string::npos;
  for (std::size_t k = 0; k < pooled.size(); ++k) {
    if (pooled[k].empty()) continue;
    if (k == best) best_point = made.points.size();
    made.points.push_back(pooled[k].at(cells.centre(k).x, cells.centre(k).y));
  }
  made.best = std::min(best_point, made.points.size());
  made.note = fmt::format("each {} shows the mean of its kept points; {}", figure.map ? "cell" : "mark", figure.note);
  return made;
}

class Drawing {
 public:
  explicit Drawing(StudyFigure figure)
      : f_(std::move(figure)), area_(f_.map ? kMap : kLine), svg_(kSheetWidth, kSheetHeight, f_.title) {
    Bounds kept;
    for (const StudyPoint& p : f_.points) {
      x_.add(on_axis(f_.x, p.x));
      if (f_.map) y_.add(on_axis(f_.y, p.y));
      if (p.state == PointState::failed) continue;
      const std::array<double, 3> values{p.value, f_.map ? p.value : p.low, f_.map ? p.value : p.high};
      all_.add(values);
      if (p.state == PointState::kept) kept.add(values);
    }
    // The colours of a map are scaled to the kept points. Points that exploit the simulation would make all others pale.
    values_ = !f_.map ? shown_range(kept, all_) : kept.lo < kept.hi ? kept : all_;
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
  /// Position of a point on the axes of the parameters.
  [[nodiscard]] double x_of(const StudyPoint& p) const { return on_axis(f_.x, p.x); }
  [[nodiscard]] double y_of(const StudyPoint& p) const { return on_axis(f_.y, p.y); }

  void line() {
    const Plot plot(svg_, area_, {.ticks = ticks_over(x_, f_.x.log, 8, kStudyMargin), .title = shortened(f_.x.title())},
                    {.ticks = ticks_over(values_, false, 7, kStudyMargin), .title = shortened(f_.value.title())});
    plot.draw_axes();
    std::vector<StudyPoint> points = f_.points;
    std::ranges::stable_sort(points, {}, &StudyPoint::x);
    curve(plot, points);
    for (const StudyPoint& p : points) {
      if (p.state == PointState::failed) {
        draw_cross(svg_, {plot.at(x_of(p), 0).x, area_.bottom - 8}, kMark);
      } else if (values_.beyond(p.value)) {
        const bool above = p.value > values_.hi;
        draw_arrow(svg_, {plot.at(x_of(p), 0).x, above ? area_.top : area_.bottom}, above, kBeyond);
      } else {
        dot(plot.at(x_of(p), p.value), p.state == PointState::kept ? colour::kBlue : colour::kWhite);
      }
    }
    if (f_.marks_best()) draw_ring(svg_, plot.at(x_of(f_.points[f_.best]), f_.points[f_.best].value));
  }

  /// Draws the values as a curve, with a band from the least to the largest value. `points` are by rising x.
  void curve(const Plot& plot, const std::vector<StudyPoint>& points) {
    Polygon band;
    std::vector<Point> lower;
    std::vector<double> x;
    std::vector<double> middle;
    const auto within = [&](double value) { return std::clamp(value, values_.lo, values_.hi); };
    for (const StudyPoint& p : points) {
      if (p.state == PointState::failed || !std::isfinite(p.value)) continue;
      band.push_back(plot.at(x_of(p), within(p.high)));
      lower.push_back(plot.at(x_of(p), within(p.low)));
      x.push_back(x_of(p));
      middle.push_back(p.value);
    }
    band.insert(band.end(), lower.rbegin(), lower.rend());
    if (band.size() > 2) svg_.polygons({&band, 1}, {.fill = kBand});
    plot.curve(x, middle, {.stroke = colour::kBlue, .width = 1.8});
  }

  void dot(Point at, std::string_view fill) { svg_.circle(at, kMark, {.stroke = colour::kBlue, .fill = fill, .width = 1.4}); }

  /// Axis of a map, which ends at the outermost cells if there are any. The only row or column is labelled with its value.
  [[nodiscard]] Axis map_axis(const StudyAxis& axis, const Bounds& range, const Edges1& edges) const {
    Axis made{.title = shortened(axis.title()), .lines = TickLines::outside};
    made.ticks = f_.grid ? ticks_over({edges.between.front(), edges.between.back()}, axis.log, 8)
                         : ticks_over(range, axis.log, 8, kStudyMargin);
    if (f_.grid && range.lo == range.hi) made.ticks.marks = ticks_over(range, axis.log, 8).marks;
    return made;
  }

  void map() {
    std::vector<double> xs;
    std::vector<double> ys;
    for (const StudyPoint& p : f_.points) {
      xs.push_back(x_of(p));
      ys.push_back(y_of(p));
    }
    const Edges1 across(xs);
    const Edges1 upwards(ys);
    const Plot plot(svg_, area_, map_axis(f_.x, x_, across), map_axis(f_.y, y_, upwards));
    for (const StudyPoint& p : f_.points) {
      if (f_.grid) {
        const auto [left, right] = across.cell(x_of(p));
        const auto [low, high] = upwards.cell(y_of(p));
        cell(p, plot.at(left, high), plot.at(right, low));
      } else {
        mark(p, plot.at(x_of(p), y_of(p)));
      }
    }
    plot.draw_axes();
    const std::string unit = f_.value.unit.empty() ? "" : " (" + f_.value.unit + ")";
    draw_shades(svg_, area_, values_, all_, shortened(f_.value.name) + unit);
    if (!f_.marks_best()) return;
    const StudyPoint& best = f_.points[f_.best];
    const auto [left, right] = across.cell(x_of(best));
    const auto [low, high] = upwards.cell(y_of(best));
    draw_ring(svg_, f_.grid ? plot.at((left + right) / 2, (low + high) / 2) : plot.at(x_of(best), y_of(best)));
  }

  void cell(const StudyPoint& p, Point corner, Point other) {
    const double width = other.x - corner.x;
    const double height = other.y - corner.y;
    const bool known = p.state != PointState::failed && std::isfinite(p.value);
    const std::string fill = known ? shade(values_.share(p.value)) : std::string(colour::kWhite);
    svg_.rectangle(corner, width, height, {.fill = fill});
    constexpr double kDark = 0.5;
    const bool dark = known && values_.share(p.value) > kDark;
    if (not_kept(p.state)) hatch(svg_, corner, width, height, dark ? kPaleHatch : kHatchLine);
    if (p.state == PointState::failed)
      draw_cross(svg_, {corner.x + width / 2, corner.y + height / 2}, std::min({kMark, width / 3, height / 3}));
  }

  static void slashed(Canvas& canvas, Point at, std::string_view fill) {
    canvas.circle(at, kMark, {.stroke = colour::kGrey, .fill = fill, .width = 1});
    canvas.line({at.x - kMark, at.y + kMark}, {at.x + kMark, at.y - kMark}, kHatchLine);
  }

  void mark(const StudyPoint& p, Point at) {
    if (p.state == PointState::failed) return draw_cross(svg_, at, kMark - 1);
    const std::string fill = std::isfinite(p.value) ? shade(values_.share(p.value)) : std::string(colour::kWhite);
    if (not_kept(p.state)) {
      slashed(svg_, at, fill);
    } else {
      svg_.circle(at, kMark, {.stroke = colour::kInk, .fill = fill, .width = 1});
    }
  }

  [[nodiscard]] LegendEntry not_kept_entry(const char* text) const {
    if (!f_.map) return dot_entry(text, {.stroke = colour::kBlue, .fill = colour::kWhite, .width = 1.4}, kMark);
    if (!f_.grid) return {text, [](Canvas& canvas, Point at) { slashed(canvas, at, shade(0.3)); }};
    const auto hatched = [](Canvas& canvas, Point at) {
      canvas.rectangle({at.x - 8, at.y - 8}, 16, 16, {.stroke = colour::kInk, .width = 0.8});
      hatch(canvas, {at.x - 8, at.y - 8}, 16, 16);
    };
    return {text, hatched, 16};
  }

  void legend() {
    std::vector<LegendEntry> entries;
    const auto any = [&](PointState state) {
      return std::ranges::find(f_.points, state, &StudyPoint::state) != f_.points.end();
    };
    if (any(PointState::kept) && !f_.map)
      entries.push_back(dot_entry("kept", {.stroke = colour::kBlue, .fill = colour::kBlue, .width = 1.4}, kMark));
    if (const char* const text = not_kept_text(f_.points); *text != '\0') entries.push_back(not_kept_entry(text));
    if (any(PointState::failed)) entries.push_back({"failed", [](Canvas& canvas, Point at) { draw_cross(canvas, at, kMark); }});
    const auto beyond = [&](const StudyPoint& p) { return p.state != PointState::failed && values_.beyond(p.value); };
    if (!f_.map && std::ranges::any_of(f_.points, beyond)) {
      entries.push_back({"beyond the axis", [](Canvas& canvas, Point at) {
                           draw_arrow(canvas, {at.x, at.y - kMark}, true, kBeyond);
                         }});
    }
    if (f_.marks_best()) entries.push_back(dot_entry("best", kBestMark, kMark + 3));
    if (!f_.map && std::ranges::any_of(f_.points, [](const StudyPoint& p) { return p.low < p.high; }))
      entries.push_back(box_entry("least to largest of the replicates", {.fill = kBand}));
    draw_legend(&svg_, entries, area_.left, kSheetWidth, kSheetHeight - 47.5);
  }

  StudyFigure f_;
  PlotArea area_;
  Svg svg_;
  Bounds x_, y_;
  Bounds values_, all_;  ///< range of the values that are shown, and range of all values
};

}  // namespace

std::string study_svg(const StudyFigure& figure) {
  return figure.points.size() > kMostMarks ? Drawing(histogram(figure)).drawn() : Drawing(figure).drawn();
}

std::string study_csv(const StudyFigure& figure) {
  std::string text =
      figure.x.name + "," + (figure.map ? figure.y.name + "," : "") + figure.value.name + ",least,largest,state,best\n";
  for (std::size_t k = 0; k < figure.points.size(); ++k) {
    const StudyPoint& p = figure.points[k];
    text += csv_cell(p.x) + "," + (figure.map ? csv_cell(p.y) + "," : "") + csv_cell(p.value) + "," + csv_cell(p.low) + "," +
            csv_cell(p.high) + "," + name_of(p.state) + "," + (k == figure.best ? "1" : "0") + "\n";
  }
  return text;
}

}  // namespace gaitlab::report
