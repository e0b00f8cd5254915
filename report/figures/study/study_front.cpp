#include "report/figures/study/study_front.h"

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

constexpr PlotArea kFrontArea{90, 700, 64, 450};  // px
constexpr double kFrontHeight = 560;              // px
constexpr std::size_t kMostBehind = 20000;
constexpr Style kBehind{.stroke = colour::kGrey, .fill = colour::kWhite, .width = 1};
constexpr Style kFront{.stroke = colour::kBlue, .fill = colour::kBlue, .width = 1.4};
constexpr Style kStair{.stroke = colour::kBlue, .width = 1.4};
constexpr Style kVerified{.stroke = colour::kBlack, .width = 2.2};

/// Range of an axis: that of the front with a margin of its own size. Dominated points far away would compress the front into a
/// corner.
Bounds front_bounds(const FrontFigure& f, std::size_t objective) {
  Bounds front;
  Bounds all;
  for (const FrontPoint& p : f.points) {
    all.add(p.objectives[objective]);
    if (p.state != FrontState::behind) front.add(p.objectives[objective]);
  }
  if (front.empty()) return all;
  const double room = std::max(front.hi - front.lo, 0.1 * std::abs(front.hi));
  Bounds shown;
  shown.add(std::max(all.lo, front.lo - room));
  shown.add(std::min(all.hi, front.hi + room));
  return shown;
}

Axis front_axis(const FrontFigure& f, std::size_t objective, int count) {
  return {.ticks = ticks_around(front_bounds(f, objective), count),
          .title = f.objectives[objective].title() + (f.maximize[objective] ? ", more is better" : ", less is better")};
}

/// Line of a front as a staircase: between two points, each objective has the worse of their values.
std::vector<Point> stair(std::span<const Point> front) {
  std::vector<Point> line;
  for (const Point& at : front) {
    if (!line.empty()) line.push_back({at.x, line.back().y});
    line.push_back(at);
  }
  return line;
}

void draw_front_legend(Canvas& canvas, bool verified) {
  std::vector<LegendEntry> entries{dot_entry("no other point is better in all objectives", kFront, 4.5),
                                   dot_entry("other kept points", kBehind, 3)};
  if (verified) entries.push_back(dot_entry("verified", kVerified, 8));
  draw_legend(&canvas, entries, kFrontArea.left, kSheetWidth, kFrontHeight - 47.5);
}

}  // namespace

std::string front_svg(const FrontFigure& f) {
  Svg svg(kSheetWidth, kFrontHeight, f.title);
  draw_sheet_title(svg, f.title);
  const Plot plot(svg, kFrontArea, front_axis(f, 0, 8), front_axis(f, 1, 7));
  plot.draw_axes();
  const auto place = [&](const FrontPoint& p) { return plot.at(p.objectives[0], p.objectives[1]); };
  const auto inside = [](Point at) {
    return at.x >= kFrontArea.left && at.x <= kFrontArea.right && at.y >= kFrontArea.top && at.y <= kFrontArea.bottom;
  };
  std::vector<Point> front;
  const std::size_t every = f.points.size() / kMostBehind + 1;
  for (std::size_t k = 0; k < f.points.size(); ++k) {
    const Point at = place(f.points[k]);
    if (f.points[k].state != FrontState::behind) {
      front.push_back(at);
    } else if (k % every == 0 && inside(at)) {
      svg.circle(at, 3, kBehind);
    }
  }
  if (f.objectives.size() == 2) svg.polyline(stair(front), kStair);
  bool any_verified = false;
  for (const FrontPoint& p : f.points) {
    if (p.state == FrontState::behind) continue;
    svg.circle(place(p), 4.5, kFront);
    if (p.state == FrontState::verified) svg.circle(place(p), 9, kVerified);
    any_verified = any_verified || p.state == FrontState::verified;
  }
  draw_front_legend(svg, any_verified);
  draw_sheet_note(svg, f.note, kFrontHeight - 14);
  return svg.finish();
}

std::string front_csv(const FrontFigure& f) {
  std::string text = "run,";
  for (const StudyAxis& axis : f.objectives) text += axis.name + ",";
  text += "state\n";
  for (const FrontPoint& p : f.points) {
    text += csv_cell(p.run) + ",";
    for (const double value : p.objectives) text += csv_cell(value) + ",";
    text += std::string(name_of(p.state)) + "\n";
  }
  return text;
}

}  // namespace gaitlab::report
