#include "report/figures/run/views.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "report/plot/plot.h"

namespace gaitlab::report {

namespace {

constexpr double kViewMost = 150;  // px, height of the tallest robot
constexpr double kViewGap = 40;    // px, between the ground of a view and the highest point of the next view

struct RoleLook {
  Role role;
  std::string_view fill, far, name;  // `far` is half way to white
};
constexpr std::array<RoleLook, 4> kLooks = {RoleLook{Role::active, colour::kSky, "#CCE8F7", "active block"},
                                            RoleLook{Role::link, colour::kGrey, "#E0E0E0", "link"},
                                            RoleLook{Role::passive, colour::kOrange, "#F8E2B3", "passive block"},
                                            RoleLook{Role::other, colour::kPale, "#F4F4F4", "body"}};

const RoleLook& look(Role role) {
  return *std::find_if(kLooks.begin(), kLooks.end(), [role](const RoleLook& look) { return look.role == role; });
}

struct Extent {
  Bounds x, z;
};

Extent extent(const View& view) {
  Extent extent;
  for (const Outline& outline : view.outlines) {
    for (const Polygon& polygon : outline.polygons) {
      for (const Point& point : polygon) {
        extent.x.add(point.x);
        extent.z.add(point.y);
      }
    }
  }
  return extent;
}

// Part of a polygon on one side of a vertical line, where sign * (x - at) >= 0.
Polygon beside(const Polygon& polygon, double at, double sign) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i];
    const Point b = polygon[(i + 1) % polygon.size()];
    const bool a_in = sign * (a.x - at) >= 0;
    if (a_in) kept.push_back(a);
    if (a_in != (sign * (b.x - at) >= 0)) kept.push_back({at, a.y + (b.y - a.y) * (at - a.x) / (b.x - a.x)});
  }
  return kept;
}

class Views {
 public:
  Views(const ViewsInput& input, const Edges& edges) : input_(input), left_(edges.left), right_(edges.right) {
    Bounds x;
    for (const View& view : input.views) {
      const Extent seen = extent(view);
      x.add(seen.x.lo);
      x.add(seen.x.hi);
      floors_.push_back(input.ground || seen.z.empty() ? 0 : seen.z.lo);
      if (seen.z.empty()) continue;
      above_ = std::max(above_, seen.z.hi - floors_.back());
      below_ = std::max(below_, floors_.back() - seen.z.lo);
    }
    if (x.empty()) x = {-0.5, 0.5};
    const double width = std::max(1.06 * (x.hi - x.lo), 1e-3);
    per_metre_ = (right_ - left_) / width;
    if (above_ + below_ > 0) per_metre_ = std::min(per_metre_, kViewMost / (above_ + below_));
    const double half = 0.5 * (right_ - left_) / per_metre_;
    ticks_ = ticks_within(0.5 * (x.lo + x.hi) - half, 0.5 * (x.lo + x.hi) + half, 8);
    x_ = {ticks_.lo, ticks_.hi, left_, right_};
  }

  [[nodiscard]] double height() const { return kHead + pitch() * static_cast<double>(input_.views.size()) + kFoot; }

  void draw(Canvas& canvas, double top) const {
    const double bottom = top + height() - kFoot;
    Plot(canvas, {left_, right_, top + kHead, bottom}, {.ticks = ticks_, .title = input_.axis}, {},
         {.text = 13, .frame = false})
        .draw_axes();
    std::vector<Point> centres;
    for (std::size_t i = 0; i < input_.views.size(); ++i) {
      const double floor = top + kHead + pitch() * static_cast<double>(i + 1) - kViewGap / 2 - below_ * per_metre_;
      const Scale z{floors_[i], floors_[i] + 1, floor, floor - per_metre_};
      draw_view(canvas, input_.views[i], z);
      if (input_.views[i].com) centres.push_back({x_(*input_.views[i].com), floor + below_ * per_metre_ + 8});
    }
    for (const Point& m : centres)
      canvas.polygons(std::vector<Polygon>{{m, {m.x - 5, m.y + 8}, {m.x + 5, m.y + 8}}}, {.fill = colour::kInk});
  }

 private:
  static constexpr double kHead = 20, kFoot = 48;  // px

  [[nodiscard]] double pitch() const { return std::max(30.0, (above_ + below_) * per_metre_) + kViewGap; }

  void draw_view(Canvas& canvas, const View& view, const Scale& z) const {
    const auto paper = [&](Point p) { return Point{x_(p.x), z(p.y)}; };
    if (input_.ground) {
      canvas.rectangle({left_, z(0)}, right_ - left_, 5, {.fill = colour::kPale});
      canvas.line({left_, z(0)}, {right_, z(0)}, kAxisLine);
    }
    for (const Polygon& solid : input_.solids) {
      Polygon seen = beside(beside(solid, ticks_.lo, 1), ticks_.hi, -1);
      if (seen.size() < 3) continue;
      std::transform(seen.begin(), seen.end(), seen.begin(), paper);
      canvas.polygons(std::vector<Polygon>{std::move(seen)}, {.stroke = colour::kGrey, .fill = colour::kPale, .width = 1});
    }
    for (const Outline& outline : view.outlines) {
      std::vector<Polygon> polygons = outline.polygons;
      for (Polygon& polygon : polygons) std::transform(polygon.begin(), polygon.end(), polygon.begin(), paper);
      canvas.polygons(polygons, {.stroke = outline.far ? colour::kGrey : colour::kInk,
                                 .fill = outline.far ? look(outline.role).far : look(outline.role).fill,
                                 .width = 1.8,
                                 .stroke_below = true});
    }
    for (const Point& contact : view.contacts)
      canvas.circle(paper(contact), 2.6, {.stroke = colour::kWhite, .fill = colour::kVermillion, .width = 0.8});
    if (view.joint) arrow(canvas, paper(*view.joint));
    canvas.text({left_ - 10, z(z.lo) + 4}, fmt::format("{:.6g} s", view.time), {.anchor = Anchor::end, .bold = true});
  }

  static void arrow(Canvas& canvas, Point tip) {
    canvas.line({tip.x, tip.y - 40}, {tip.x, tip.y - 10}, {.stroke = colour::kBlack, .width = 2});
    canvas.polygons(std::vector<Polygon>{{tip, {tip.x - 5, tip.y - 11}, {tip.x + 5, tip.y - 11}}}, {.fill = colour::kBlack});
  }

  const ViewsInput& input_;
  double left_, right_;
  std::vector<double> floors_ = {};  // m, height of the base line of each view
  double above_ = 0, below_ = 0;     // m, extent above and below the base line
  double per_metre_ = 1;
  Ticks ticks_;
  Scale x_;
};

}  // namespace

std::string_view body_colour(Role role) { return look(role).fill; }

std::vector<LegendEntry> views_legend(const std::vector<View>& views) {
  const auto any = [&](const auto& test) { return std::ranges::any_of(views, test); };
  std::vector<LegendEntry> all;
  for (const RoleLook& role : kLooks) {
    const auto shown = [&](const View& view) {
      return std::ranges::find(view.outlines, role.role, &Outline::role) != view.outlines.end();
    };
    if (any(shown)) all.push_back(box_entry(std::string(role.name), {.stroke = colour::kInk, .fill = role.fill}));
  }
  if (any([](const View& view) { return std::ranges::any_of(view.outlines, &Outline::far); }))
    all.push_back(box_entry("far side", {.stroke = colour::kGrey, .fill = "#F4F4F4"}));
  if (any([](const View& view) { return !view.contacts.empty(); }))
    all.push_back(dot_entry("contact", {.fill = colour::kVermillion}, 3));
  if (any([](const View& view) { return view.com.has_value(); })) {
    all.push_back({"centre of mass", [](Canvas& canvas, Point m) {
                     canvas.polygons(std::vector<Polygon>{{{m.x, m.y - 4}, {m.x - 5, m.y + 4}, {m.x + 5, m.y + 4}}},
                                     {.fill = colour::kInk});
                   }});
  }
  return all;
}

double views_height(const ViewsInput& input, const Edges& edges) { return Views(input, edges).height(); }

void draw_views(Canvas& canvas, const ViewsInput& input, const Edges& edges, double top) {
  Views(input, edges).draw(canvas, top);
}

}  // namespace gaitlab::report
