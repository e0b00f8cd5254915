// Panel kind `envelope`, which shows torque over speed and the motors' limits.
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
constexpr std::size_t kNamed = 7;       // largest number of joints that have separate lines
constexpr double kApart = 0.25;         // px, least distance between points of a path
constexpr double kPadding = 1.06;       // factor on the range of the data
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
    const RowRange rows = source.rows(time);
    for (const std::size_t j : joints) {
      JointPath path{names[j], {}, {}};
      const std::optional<JointLoad> load = source.load(j);
      if (!load) return;
      for (std::size_t row = rows.first; row < rows.last; ++row) {
        path.speed.push_back(load->speed[row]);
        path.torque.push_back(load->torque[row]);
      }
      paths_.push_back(std::move(path));
    }
    if (!source.problems.empty()) return;
    find_envelopes(run.scenario, joints);
    set_ticks();
  }

  [[nodiscard]] Margins margins() const override { return {texts_beside(left_.ticks) + 20, 12}; }
  [[nodiscard]] double head(const Edges& edges) const override { return legend_head(legend(), edges); }
  [[nodiscard]] double body(const Edges&) const override { return height_; }

  void draw(Canvas& canvas, const PlotArea& area) const override {
    const Plot plot(canvas, area, below_, left_, kPrint);
    for (const Envelope& envelope : envelopes_) {
      Polygon all;
      const auto add = [&](double speed, double torque) {
        const Point at = plot.at(speed, torque);
        all.push_back({at.x, std::clamp(at.y, area.top, area.bottom)});
      };
      for (std::size_t k = 0; k < envelope.speed.size(); ++k) add(envelope.speed[k], envelope.most[k]);
      for (std::size_t k = envelope.speed.size(); k-- > 0;) add(envelope.speed[k], envelope.least[k]);
      canvas.polygons(std::vector<Polygon>{std::move(all)}, {.fill = kAvailable});
    }
    plot.draw_axes();
    for (const Envelope& envelope : envelopes_) {
      for (const std::vector<double>* limit : {&envelope.most, &envelope.least}) plot.curve(envelope.speed, *limit, kAxisLine);
    }
    for (std::size_t k = 0; k < paths_.size(); ++k) canvas.polyline(line(plot, paths_[k]), style(k));
    draw_legend_above(canvas, legend(), area);
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
  /// `thinned` cannot be used, because the speed rises and falls.
  static std::vector<Point> line(const Plot& plot, const JointPath& path) {
    std::vector<Point> points;
    for (std::size_t row = 0; row < path.speed.size(); ++row) {
      const Point p = plot.at(path.speed[row], path.torque[row]);
      const bool last = row + 1 == path.speed.size();
      if (points.empty() || last || std::hypot(p.x - points.back().x, p.y - points.back().y) >= kApart) points.push_back(p);
    }
    return points;
  }

  void set_ticks() {
    Bounds x;
    Bounds y;
    for (const JointPath& path : paths_) {
      x.add(path.speed);
      y.add(path.torque);
    }
    for (const Envelope& envelope : envelopes_) {
      x.add(envelope.speed);
      for (const std::vector<double>* torque : {&envelope.most, &envelope.least})
        y.add(1.15 * (*torque)[torque->size() / 2]);  // torque at rest
    }
    below_ = {.ticks = ticks_within(kPadding * x.lo, kPadding * x.hi, 8), .title = "speed (rad/s)"};
    left_ = {.ticks = ticks_within(kPadding * y.lo, kPadding * y.hi, 6), .title = "torque (N m)"};
    left_.away = texts_beside(left_.ticks) + 8;
  }

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
    if (!envelopes_.empty()) entries.push_back(line_entry("available", {.stroke = kAvailable, .width = 11}, kPrintLine));
    for (std::size_t k = 0; k < paths_.size() && paths_.size() <= kNamed; ++k)
      entries.push_back(line_entry(paths_[k].name, style(k), kPrintLine));
    if (paths_.size() > kNamed) entries.push_back(line_entry(fmt::format("{} joints", paths_.size()), style(0), kPrintLine));
    return entries;
  }

  double height_;
  std::vector<JointPath> paths_;
  std::vector<Envelope> envelopes_;
  std::vector<std::string> notes_;
  Axis below_, left_;
};

}  // namespace

const PanelKind kEnvelopePanel{
    .name = "envelope",
    .about = "Torque of joints over their speed, with the largest torque that their motors have at each speed.",
    .one_run = true,
    .fields = [](PanelRecipe& panel, Fields& f) { panel.joint_fields(f); },
    .lacking = nothing_lacks,
    .make = made<EnvelopeOfPanel>};

}  // namespace gaitlab::report
