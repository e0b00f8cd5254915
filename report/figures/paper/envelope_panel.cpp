// Kind `envelope`: torque over speed, in front of what the motors have.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/scenario/sections.h"
#include "core/settings/wording.h"
#include "report/analysis/envelope.h"
#include "report/figures/paper/paper_panel.h"

namespace gaitlab::report {

namespace {

constexpr double kEnvelopeHeight = 55;  // mm
constexpr std::size_t kNamed = 7;       // joints that have a line of their own
constexpr double kApart = 0.25;         // px: a path keeps points as far apart
constexpr double kPadding = 1.06;       // of the range, beside what is drawn
constexpr std::string_view kAvailable = "#E8E8E8";

struct JointPath {
  std::string name;
  std::vector<double> speed, torque;
};

class EnvelopeOfPanel final : public PaperPanel {
 public:
  explicit EnvelopeOfPanel(const PanelSource& source) : height_(source.height(kEnvelopeHeight)) {
    const PaperRun& run = source.run();
    const std::vector<std::size_t> joints = source.joints();
    const std::vector<std::string> names = joint_names(*run.scenario.robot);
    const std::vector<double> time = row_times(run.recording);
    const Rows rows = source.rows(time);
    for (const std::size_t j : joints) {
      JointPath path{names[j], {}, {}};
      const Series speed = run.recording.joint(j, "speed");
      const Series torque = run.recording.joint(j, "torque");
      if (speed.empty() || torque.empty()) {
        source.problem({"kind"}, fmt::format("run {} has no joint.{}.{}: simulate it with trace.columns: [joint.*]",
                                             in_quotes(run.name), j, torque.empty() ? "torque" : "speed"));
        return;
      }
      for (std::size_t row = rows.first; row < rows.last; ++row) {
        path.speed.push_back(speed[row]);
        path.torque.push_back(torque[row]);
      }
      paths_.push_back(std::move(path));
    }
    if (!source.problems.empty()) return;
    find_envelopes(run.scenario, joints);
    Bounds x;
    Bounds y;
    for (const JointPath& path : paths_) {
      x.add(path.speed);
      y.add(path.torque);
    }
    for (const Envelope& envelope : envelopes_) {
      x.add(envelope.speed);
      for (const std::vector<double>* torque : {&envelope.most, &envelope.least})
        y.add(1.15 * (*torque)[torque->size() / 2]);  // at rest
    }
    x_ = ticks_within(kPadding * x.lo, kPadding * x.hi, 8);
    y_ = ticks_within(kPadding * y.lo, kPadding * y.hi, 6);
  }

  [[nodiscard]] Margins margins() const override { return {8 + label_width(y_) + 20, 12}; }
  [[nodiscard]] double head(const Edges& edges) const override {
    return draw_legend(nullptr, legend(), edges.left, edges.right, 13, kPrintLegend) + 11;
  }
  [[nodiscard]] double body(const Edges&) const override { return height_; }

  void draw(Canvas& canvas, const PlotArea& area) const override {
    const Scale x{x_.lo, x_.hi, area.left, area.right};
    const Scale y{y_.lo, y_.hi, area.bottom, area.top};
    const auto paper = [&](double speed, double torque) {
      return Point{x(speed), std::clamp(y(torque), area.top, area.bottom)};
    };
    for (const Envelope& envelope : envelopes_) {
      Polygon all;
      for (std::size_t k = 0; k < envelope.speed.size(); ++k) all.push_back(paper(envelope.speed[k], envelope.most[k]));
      for (std::size_t k = envelope.speed.size(); k-- > 0;) all.push_back(paper(envelope.speed[k], envelope.least[k]));
      canvas.polygons(std::vector<Polygon>{std::move(all)}, {.fill = kAvailable});
    }
    Panel panel(canvas, area, x_, y_, kPrint);
    for (const Envelope& envelope : envelopes_) {
      for (const std::vector<double>* limit : {&envelope.most, &envelope.least})
        panel.curve(envelope.speed, *limit, {.stroke = colour::kInk, .width = 1.2});
    }
    for (std::size_t k = 0; k < paths_.size(); ++k) {
      std::vector<Point> points;
      for (std::size_t row = 0; row < paths_[k].speed.size(); ++row) {
        const Point p = panel.at(paths_[k].speed[row], paths_[k].torque[row]);
        const bool last = row + 1 == paths_[k].speed.size();
        if (points.empty() || last || std::hypot(p.x - points.back().x, p.y - points.back().y) >= kApart) points.push_back(p);
      }
      canvas.polyline(points, style(k));
    }
    panel.axis_below("speed (rad/s)");
    panel.side_title("torque (N m)", Side::left, 8 + label_width(y_) + 8);
    draw_legend(&canvas, legend(), area.left, area.right, area.top - head({area.left, area.right}) + 13, kPrintLegend);
  }

  [[nodiscard]] Trace data() const override {
    std::vector<DataColumn> columns;
    for (const JointPath& path : paths_) {
      columns.push_back({path.name + " speed [rad/s]", path.speed});
      columns.push_back({path.name + " torque [N m]", path.torque});
    }
    for (std::size_t k = 0; k < envelopes_.size(); ++k) {
      const std::string name = envelopes_.size() > 1 ? fmt::format("envelope {}", k + 1) : "envelope";
      columns.push_back({name + " speed [rad/s]", envelopes_[k].speed});
      columns.push_back({name + " most [N m]", envelopes_[k].most});
      columns.push_back({name + " least [N m]", envelopes_[k].least});
    }
    return data_table(columns);
  }
  [[nodiscard]] std::vector<std::string> notes() const override { return notes_; }

 private:
  void find_envelopes(const Scenario& scenario, const std::vector<std::size_t>& joints) {
    Bounds drawn;
    for (const JointPath& path : paths_) drawn.add(path.speed);
    const Motors all = motors(scenario, std::max(std::abs(drawn.lo), std::abs(drawn.hi)));
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (all.of_joint.empty() || !all.joint(joints[k]).command) {
        notes_.push_back(fmt::format("{}: the actuator states no largest command: no envelope is drawn", paths_[k].name));
        continue;
      }
      const Envelope& envelope = all.joint(joints[k]);
      if (std::ranges::find(envelopes_, envelope) == envelopes_.end()) envelopes_.push_back(envelope);
    }
  }

  [[nodiscard]] Style style(std::size_t k) const {
    if (paths_.size() <= kNamed) return {.stroke = curve_style(k).stroke, .width = 1.2, .dash = curve_style(k).dash};
    return {.stroke = colour::kBlue, .width = 0.6};
  }

  [[nodiscard]] std::vector<LegendEntry> legend() const {
    std::vector<LegendEntry> entries;
    if (!envelopes_.empty()) entries.push_back({"available", {.stroke = kAvailable, .width = 11}});
    for (std::size_t k = 0; k < paths_.size() && paths_.size() <= kNamed; ++k) entries.push_back({paths_[k].name, style(k)});
    if (paths_.size() > kNamed) entries.push_back({fmt::format("{} joints", paths_.size()), style(0)});
    return entries;
  }

  double height_;
  std::vector<JointPath> paths_;
  std::vector<Envelope> envelopes_;
  std::vector<std::string> notes_;
  Ticks x_, y_;
};

}  // namespace

std::unique_ptr<PaperPanel> envelope_panel(const PanelSource& source) { return std::make_unique<EnvelopeOfPanel>(source); }

}  // namespace gaitlab::report
