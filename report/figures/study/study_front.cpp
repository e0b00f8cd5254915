#include "report/figures/study/study_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/settings/wording.h"
#include "report/plot/panel.h"
#include "report/plot/svg.h"

namespace gaitlab::report {

namespace {

constexpr PlotArea kFrontArea{90, 700, 64, 450};  // px
constexpr double kFrontWidth = 760, kFrontHeight = 560;
constexpr std::size_t kMostBehind = 20000;
constexpr Style kBehind{.stroke = colour::kGrey, .fill = colour::kWhite, .width = 1};
constexpr Style kFront{.stroke = colour::kBlue, .fill = colour::kBlue, .width = 1.4};
constexpr Style kStair{.stroke = colour::kBlue, .width = 1.4};
constexpr Style kVerified{.stroke = colour::kBlack, .width = 2.2};

/// Of the front, and as much again around it: what is far behind would press the front into a corner.
Bounds bounds_of(const FrontFigure& f, std::size_t objective) {
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

}  // namespace

std::string front_svg(const FrontFigure& f) {
  Svg svg(kFrontWidth, kFrontHeight);
  svg.text({kFrontArea.left, 30}, f.title, {.size = 17, .bold = true});
  const Ticks x_ticks = bounds_of(f, 0).ticks(8);
  const Ticks y_ticks = bounds_of(f, 1).ticks(7);
  Panel panel(svg, kFrontArea, x_ticks, y_ticks, {});
  panel.axis_below(f.objectives[0].title() + (f.maximize[0] ? ", more is better" : ", less is better"));
  panel.side_title(f.objectives[1].title() + (f.maximize[1] ? ", more is better" : ", less is better"), Side::left, 62);
  const auto inside = [&](const FrontPoint& p) {
    return p.objectives[0] >= x_ticks.lo && p.objectives[0] <= x_ticks.hi && p.objectives[1] >= y_ticks.lo &&
           p.objectives[1] <= y_ticks.hi;
  };
  std::vector<Point> stair;
  const std::size_t every = f.points.size() / kMostBehind + 1;
  for (std::size_t k = 0; k < f.points.size(); ++k) {
    const FrontPoint& p = f.points[k];
    if (p.state == FrontState::behind && inside(p) && k % every == 0)
      svg.circle(panel.at(p.objectives[0], p.objectives[1]), 3, kBehind);
  }
  for (const FrontPoint& p : f.points) {
    if (p.state == FrontState::behind) continue;
    const Point at = panel.at(p.objectives[0], p.objectives[1]);
    // Between two points of a front the worse value of either holds.
    if (!stair.empty() && f.objectives.size() == 2) stair.push_back({at.x, stair.back().y});
    stair.push_back(at);
  }
  if (f.objectives.size() == 2) svg.polyline(stair, kStair);
  for (const FrontPoint& p : f.points) {
    if (p.state == FrontState::behind) continue;
    const Point at = panel.at(p.objectives[0], p.objectives[1]);
    svg.circle(at, 4.5, kFront);
    if (p.state == FrontState::verified) svg.circle(at, 9, kVerified);
  }
  double x = kFrontArea.left;
  const auto entry = [&](const char* name, double radius, const Style& style) {
    svg.circle({x + 4, kFrontHeight - 52}, radius, style);
    svg.text({x + 20, kFrontHeight - 47.5}, name);
    x += 46 + text_width(name, 13);
  };
  entry("no other point is better in all objectives", 4.5, kFront);
  entry("other kept points", 3, kBehind);
  if (std::ranges::any_of(f.points, [](const FrontPoint& p) { return p.state == FrontState::verified; }))
    entry("verified", 8, kVerified);
  svg.text({20, kFrontHeight - 14}, f.note, {.size = 11, .fill = colour::kGrey});
  return svg.finish();
}

std::string front_csv(const FrontFigure& f) {
  std::string text = "run,";
  for (const StudyAxis& axis : f.objectives) text += axis.name + ",";
  text += "state\n";
  for (const FrontPoint& p : f.points) {
    text += number_text(p.run) + ",";
    for (const double value : p.objectives) text += number_text(value) + ",";
    text += std::string(name_of(p.state)) + "\n";
  }
  return text;
}

}  // namespace gaitlab::report
